// A path of acceleration A is off its chord over a time h by at most A h^2 / 8. Half of a quarter of a pixel, at the
// path's distance from the eye, gives h. Of points that are nearer to one another than the other half, one is left out:
// the steps of bodies in contact are shorter than a pixel.
#include "overlay/trails.h"

#include "std.h"

namespace carom {
namespace {

constexpr double error = 0.125;       // pixels, of a chord, and between points that are one
constexpr double least_width = 1.5;   // pixels
constexpr double most_points = 1000;  // of a piece

struct TrailPoint {
  double time;  // s
  Vec3 position;
};

class TrailMaker {
 public:
  TrailMaker(const Moment& moment, const Trails& trails, vector<Stroke>& strokes)
      : moment_(moment), trails_(trails), strokes_(strokes), now_(moment.state.time) {}

  void add(Entity body) {
    radius_ = trails_.width ? *trails_.width / 2 : moment_.scene.world.radius[body] / 4;
    for (const TrackPiece& piece : moment_.history.tracks()->of(body)) {
      const double from = max(piece.from, now_ - trails_.seconds), until = min(piece.until, now_);
      if (from < until) add(body, piece, from, until);
    }
    finish(body);
  }

 private:
  /// The number of chords of a piece.
  double chords(const TrackPiece& piece, double from, double until) const {
    double bend = piece.acceleration(from).norm(), pixel = moment_.pixel_at(piece.position(from));
    for (const double time : {(from + until) / 2, until}) {
      bend = max(bend, piece.acceleration(time).norm());
      pixel = min(pixel, moment_.pixel_at(piece.position(time)));
    }
    return clamp(ceil((until - from) * sqrt(bend / (8 * error * pixel))), 1.0, most_points);
  }

  void add(Entity body, const TrackPiece& piece, double from, double until) {
    const TrailPoint first{from, piece.position(from)};
    // A path that goes on where the last piece has ended is one line. Bodies that merge jump.
    const bool joined = has_last_ && last_.time == from &&
                        (first.position - last_.position).norm() <= 2 * error * moment_.pixel_at(first.position);
    if (!joined) {
      finish(body);
      kept_ = last_ = first;
      has_last_ = true;
    }

    const double count = chords(piece, from, until);
    for (double i = 1; i <= count; ++i) {
      const double time = i < count ? from + i / count * (until - from) : until;
      last_ = {time, piece.position(time)};
      if ((last_.position - kept_.position).norm() > error * moment_.pixel_at(last_.position)) stroke(body);
    }
  }

  /// Ends the line at its last point.
  void finish(Entity body) {
    if (has_last_ && last_.position != kept_.position) stroke(body);
    has_last_ = false;
  }

  void stroke(Entity body) {
    const double middle = (kept_.time + last_.time) / 2, span = last_.time - kept_.time;
    const Vec3 mean_velocity = (last_.position - kept_.position) / span;
    Stroke stroke;
    stroke.from = kept_.position;
    stroke.to = last_.position;
    stroke.from_radius = stroke.to_radius = radius_;
    stroke.least_width = least_width;
    stroke.color = moment_.colors.of(body, middle, mean_velocity, moment_.state, moment_.history);
    stroke.from_opacity = opacity(kept_.time);
    stroke.to_opacity = opacity(last_.time);
    strokes_.push_back(stroke);
    kept_ = last_;
  }

  double opacity(double time) const { return clamp(1 - (now_ - time) / trails_.seconds, 0.0, 1.0); }

  const Moment& moment_;
  const Trails& trails_;
  vector<Stroke>& strokes_;
  double now_;             // s
  double radius_ = 0;      // m
  bool has_last_ = false;  // whether the two points below are of a line
  TrailPoint kept_{}, last_{};
};

}  // namespace

void add_trails(const Moment& moment, vector<Stroke>& strokes) {
  const Tracks* tracks = moment.history.tracks();
  if (tracks == nullptr) return;
  TrailMaker maker(moment, *moment.scene.overlay.trails, strokes);
  for (const Entity body : tracks->bodies()) maker.add(body);
}

}  // namespace carom
