#pragma once
// The Drawing of an instant: the camera, and what a picture shows besides the bodies.

#include "overlay/arrows.h"
#include "overlay/body_colors.h"
#include "overlay/history.h"
#include "overlay/marks.h"
#include "physics/world_now.h"
#include "render/drawing.h"
#include "scene/film_clock.h"
#include "scene/output.h"
#include "std.h"

namespace carom {

/// A flash lasts so long (s) in a film.
inline constexpr double flash_length = 0.1;

class DrawingMaker {
 public:
  /// For pictures of this size, of a film with this clock.
  /// `scene` and `history` must outlive this object.
  DrawingMaker(const Scene& scene, const History& history, Size size, const FilmClock& clock = {});

  /// `state`: at the time that `history` has reached. `camera`: that of its picture.
  Drawing at(const State& state, const Camera& camera);
  /// What is written onto that picture.
  Marks marks(const State& state, const Camera& camera);

 private:
  vector<float> glow(double time) const;

  const Scene& scene_;
  WorldNow world_;
  const History& history_;
  Size size_;
  FilmClock clock_;
  BodyColors colors_;
  vector<ArrowScale> arrows_;
  MarkScales scales_;
  bool strokes_;  // whether there may be any
};

}  // namespace carom
