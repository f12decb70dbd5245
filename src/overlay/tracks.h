#pragma once
// The recent paths of bodies, as pieces of polynomials.

#include "numerics/compensated.h"
#include "numerics/vec3.h"
#include "physics/path_piece.h"
#include "std.h"

namespace carom {

/// x + v s + a s^2/2 + j s^3/6, with s the time since `start`, from `from` until `until`. Or x and a polynomial's
/// displacement.
struct TrackPiece {
  double from = 0;  // s
  double until = infinity;
  DoubleDouble start{0, 0};  // s
  Vec3 x = Vec3::Zero();     // m, at start
  Vec3 v = Vec3::Zero();     // m/s, at start
  Vec3 a = Vec3::Zero();     // m/s^2, at start
  Vec3 jerk = Vec3::Zero();  // m/s^3
  shared_ptr<const PolynomialPath> curve{};

  double since(double time) const { return (time - start.hi) - start.lo; }  // s
  Vec3 position(double time) const {
    const double s = since(time);
    return curve ? Vec3(x + curve->displacement_at(s)) : Vec3(x + s * (v + s * (a / 2 + s / 6 * jerk)));
  }
  Vec3 velocity(double time) const {
    const double s = since(time);
    return curve ? Vec3(v + curve->change_at(s)) : Vec3(v + s * (a + s / 2 * jerk));
  }
  Vec3 acceleration(double time) const {
    return curve ? curve->acceleration(since(time)) : Vec3(a + since(time) * jerk);
  }
};

class Tracks {
 public:
  /// The paths of `on` (empty: of all bodies) during the last `seconds`.
  Tracks(Entity bodies, const vector<Entity>& on, double seconds);

  const vector<Entity>& bodies() const { return bodies_; }  // those with tracks, ascending
  span<const TrackPiece> of(Entity body) const { return pieces_[body]; }

  /// Adds pieces of recorded paths, in order. A body that becomes part of another has no further path.
  void add(span<const PathPiece> pieces);
  /// Adds a piece of a body's path, which begins where its last one ends, or later.
  void add(Entity body, const TrackPiece& piece);
  /// Removes the last `count` pieces of a body, which were added and whose predecessor ended by itself.
  void remove(Entity body, size_t count) { pieces_[body].resize(pieces_[body].size() - count); }
  bool has(Entity body) const { return wanted_[body]; }

 private:
  void end(Entity body, double time);
  void forget(Entity body, double before);

  double seconds_;
  vector<Entity> bodies_;
  vector<bool> wanted_;                // by body
  vector<vector<TrackPiece>> pieces_;  // by body, in order of time
};

}  // namespace carom
