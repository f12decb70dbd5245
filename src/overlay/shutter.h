#pragma once
// Motion blur: the instants of which a picture is the mean.

#include "physics/state.h"
#include "render/eye.h"

namespace carom {

struct Scene;

/// At most so many instants make a picture. Beyond so many pixels of motion, steps of the blur may be seen.
inline constexpr int most_exposures = 32;

/// The number of instants for a shutter that opens at `state` and is open for `open` (s), so that no body in the
/// picture moves more than a pixel from one to the next. `opening`, `closing`: the camera then.
int exposures_of(const Scene& scene, const State& state, double open, const Eye& opening, const Eye& closing);

/// The instants of the pictures of one stream. The shutter is open during the last part of the interval before a
/// picture's time, which is the last instant.
class Shutter {
 public:
  /// `open`: s, in a film at its own speed; 0: a picture is of its own time alone.
  explicit Shutter(double open = 0) : open_(open) {}

  bool is_used() const { return open_ > 0; }

  /// Sets the time (s) of the next picture. The shutter opens no earlier than at the time of the picture before. Where
  /// the film has a part `pace` of its speed, it is open for that part of the time, as a camera that takes more
  /// pictures a second with the same shutter. Another call with the same time changes nothing.
  void aim(double picture, double pace = 1);
  double length() const { return picture_ - from_; }  // s, of being open for this picture
  double next() const;                                // s, of the next instant before the picture's; infinity: none
  /// Whether the instant next() is that of opening, at which nothing is drawn.
  bool opens() const { return !opened_; }
  /// Opens: `count` instants until the picture's time.
  void open_for(int count);
  /// Passes the instant next().
  void pass() { ++done_; }

 private:
  double open_;
  double picture_ = 0, from_ = 0;  // s, the times of the picture and of opening
  int count_ = 0, done_ = 0;
  bool opened_ = true;
};

}  // namespace carom
