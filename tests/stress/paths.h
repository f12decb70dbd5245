#pragma once
// The bodies' paths between two states, rebuilt from these: a dense search for overlaps, without the program's own
// times of impact.

#include "std.h"
#include "stress/scene.h"
#include "stress/watch.h"

namespace carom::stress {

class Paths {
 public:
  Paths(const RandomScene& scene, const vector<double>& times, const Watched& seen, const vector<Collision>& records,
        double in_contact);

  /// Every overlap beyond the allowed one, as text (the first of each pair).
  vector<string> overlaps() const;

  /// m: possible error of the gap of two things, from the size of its terms.
  double rounding(Entity a, Entity b) const;
  /// m: the overlap that they may have: rounding, and in islands of bodies in lasting contact a little more.
  double allowed(Entity a, Entity b) const;

 private:
  struct Path {
    Vec3 x, v, a;  // at the beginning
    bool known;    // it is a parabola: the body has no record on the way, and the ends fit; or a drift in a crowd
  };
  vector<Path> between(size_t k) const;
  bool drifts(Entity i, double from, double until) const;
  double deepest(const World& world, Entity a, const Path& pa, Entity b, const Path& pb, double length) const;

  const RandomScene& scene_;
  const vector<double>& times_;
  const Watched& seen_;
  const double in_contact_;
  vector<double> extent_;            // m, by entity
  vector<vector<double>> recorded_;  // s, by body: when it collided, ascending
};

}  // namespace carom::stress
