#pragma once
// What is drawn of a run, of all its folders, by a record of the motion.

#include "run/stages.h"
#include "std.h"

namespace carom {

class RecordQueue;

using MakeMotion = function<unique_ptr<Simulator>()>;

class Drawings {
 public:
  /// All must outlive this object. `scene`: one of those that share the motion. `stop_check` is called often, and may
  /// throw.
  Drawings(Stages& stages, const Scene& scene, const function<void()>& stop_check)
      : stages_(stages), scene_(scene), stop_check_(stop_check) {}

  /// The cameras that frame the motion.
  vector<MovingCamera*> framing_cameras();
  /// The charts beside films, which need the motion, too.
  vector<FilmChart*> charts();
  /// Does what pictures need beforehand. Its time counts as theirs.
  void prepare(const function<void()>& work);
  /// Draws the motion whose record comes through the queue.
  void follow(RecordQueue& queue);
  /// Draws by recorded motions. `surveyed`: cameras and charts have been given the motion.
  void draw(const MakeMotion& motion, bool surveyed);
  /// Ends the outputs that are drawn.
  void end(const Tally& tally);

 private:
  void draw_all(const MakeMotion& motion);
  vector<Stages::Standing> drawn();

  Stages& stages_;
  const Scene& scene_;
  const function<void()>& stop_check_;
};

}  // namespace carom
