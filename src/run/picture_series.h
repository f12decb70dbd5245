#pragma once
// The pictures of one stream: draws each from one instant, or from several for motion blur, and writes text onto it.

#include "export/picture_streams.h"
#include "overlay/drawing_maker.h"
#include "overlay/history.h"
#include "overlay/inscription.h"
#include "overlay/light_mean.h"
#include "overlay/shutter.h"
#include "physics/tally.h"
#include "render/moving_camera.h"
#include "render/renderer.h"
#include "run/film_chart.h"
#include "std.h"

namespace carom {

class PictureSeries {
 public:
  /// `run`: the name of the run's folder. `scene` and `history` must outlive this object.
  PictureSeries(const Scene& scene, const PictureStream& stream, const History& history, string run);

  MovingCamera& camera() { return camera_; }
  /// The chart beside the pictures, which must have been given the motion before the first of them. Null: there is
  /// none.
  FilmChart* chart() { return chart_.get(); }

  /// Sets the time (s) of the next picture, also repeatedly. None: there is no further one.
  void aim(optional<double> picture);
  /// The next time (s) before that of the picture at which a state is needed. Infinity: none.
  double next_instant() const { return shutter_.next(); }
  /// Takes the state of that time.
  void expose(const State& state);
  /// The picture of the aimed time, which is that of the state. Valid until the next call. Throws RenderError.
  const Image& picture(const State& state, const Tally& tally);
  /// Whether the last picture equals the one before.
  bool is_repeated() const { return repeated_; }

 private:
  const Image& draw(const State& state);
  const Image& light(const State& state);
  const Image& with_text(const Image& image, const State& state, const Tally& tally);

  const Scene& scene_;
  PictureStream stream_;
  const History& history_;
  string run_;
  MovingCamera camera_;
  unique_ptr<FilmChart> chart_;  // null: there is none
  Shutter shutter_;
  // Made for the first picture. A scene without pictures needs no renderer and reads no mesh.
  unique_ptr<Renderer> renderer_;
  optional<DrawingMaker> maker_;
  optional<Inscription> inscription_;
  LightMean mean_;
  int exposed_ = 0;  // instants of the picture in the making
  Image image_;      // with text
  CaptionValues values_;
  Marks marks_;
  // The drawings of the renderer that the last picture shows, and whether it is of one alone.
  uint64_t shown_ = 0;
  bool alone_ = false, repeated_ = false;
};

}  // namespace carom
