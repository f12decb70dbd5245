#pragma once
// The time of a motion and of the film that shows it: at an even speed, or slower around one collision.

#include "std.h"

namespace carom {

/// A collision around which a film slows down.
struct Slowdown {
  double time = 0;   // s, of the collision
  int halvings = 1;  // at the slowest, the film has 1 / 2^halvings of its speed
  friend bool operator==(const Slowdown&, const Slowdown&) = default;
};

/// The halvings for bodies that meet with this relative speed (m/s) in a film of this speed. `radius`: m, of the
/// smaller one.
int halvings_for(double relative_speed, double radius, double film_speed);

/// The most seconds by which a film is longer than without a slowdown.
double most_delay();

/// Both ways in closed form. Both are monotone and continuously differentiable.
class FilmClock {
 public:
  FilmClock() = default;
  /// speed: seconds of motion a second of film, apart from the slowdown. from: s of motion, at the film's start.
  FilmClock(double speed, double from, const optional<Slowdown>& slow = {});

  double speed() const { return speed_; }
  bool slows() const { return slow_.has_value(); }
  double slowest() const { return slowest_; }  // the least pace
  /// The time (s of motion) that the film shows when it would show `plain` without the slowdown. The film's start, and
  /// what it shows before the slowdown begins, are the same, bit for bit.
  double shown(double plain) const;
  /// The other way.
  double plain(double shown) const;
  /// The film's time (s) at a time of the motion (s).
  double film(double shown) const { return (plain(shown) - from_) / speed_; }
  /// How fast the film is at a time of the motion (s), as a part of its speed: 1 / 2^halvings to 1.
  double pace(double shown) const;
  /// The film's speed at a time of the motion, such as "1/8 speed", in halvings of its own speed. Empty: it is not
  /// slow.
  string text(double shown) const;

 private:
  double way(double v) const;   // s of motion from the collision, at v without the slowdown
  double back(double u) const;  // the other way

  double speed_ = 1, from_ = 0;
  optional<Slowdown> slow_;
  // All in s of motion. middle_: of the collision without the slowdown. unit_: what a film at full speed shows in the
  // time in which it halves its speed.
  double middle_ = 0, unit_ = 0;
  // Half of the slowdown, without it and with it.
  double half_ = 0, shown_half_ = 0;
  double slowest_ = 1;  // 2^-halvings
};

}  // namespace carom
