#pragma once
// The extremes and means of quantities along the bodies' paths. They are taken from each flight when it ends: where its
// polynomial turns, and where the next flight does not continue it, or as its integral. Outputs and samples have no
// effect on them.

#include "physics/extremes.h"
#include "simulate/path/paths.h"
#include "std.h"

namespace carom {

/// A point of a body's path.
struct PathPoint {
  Vec3 x = Vec3::Zero(), v = Vec3::Zero();    // m, and m/s by the scene's method
  Vec3 way = Vec3::Zero(), a = Vec3::Zero();  // m/s, m/s^2: the changes of x and of v

  void keep(auto& archive) { archive(x, v, way, a); }
};

class PathExtremes {
 public:
  /// Watches options.watch. `bodies` must outlive this object.
  explicit PathExtremes(const BodyPaths& bodies);

  bool any() const { return !found_.empty(); }
  /// Call this before body i gets another flight at the present instant.
  void note(Entity i);
  /// The extremes from time 0 to `time` (s), by options.watch. Flights that last are taken up to there.
  vector<Extremes> up_to(double time) const;

  void keep(auto& archive) { archive.sized(found_, seen_); }

 private:
  /// What has been taken of a body's path.
  struct Seen {
    bool any = false;
    Instant until;
    PathPoint end;                // there, not taken yet
    double place = 0, speed = 0;  // m and m/s: bounds of the errors so far

    void keep(auto& archive) { archive(any, until, end, place, speed); }
  };

  Seen take(Entity i, const Instant& until, vector<Extremes>& found) const;
  void offer(size_t k, Entity i, const PathPoint& at, double time, const Seen& errors, Extremes& found) const;
  static double rounding_of(Quantity quantity, const PathPoint& at, double mass, const Seen& errors);
  void add_errors(Entity i, const Flight& f, const PathPoint& from, const PathPoint& to, Seen& seen) const;

  const BodyPaths& bodies_;
  vector<Extremes> found_;  // by options.watch
  vector<Seen> seen_;       // by body
};

}  // namespace carom
