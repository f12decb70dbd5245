#pragma once
// The extremes of quantities along the bodies' paths. They are taken from each flight when it ends: at both ends, and
// where its polynomial turns. Outputs and samples have no effect on them.
#include <span>
#include <vector>

#include "physics/extremes.h"
#include "simulate/exact_bodies.h"

namespace carom {

class PathExtremes {
 public:
  /// Watches options.watch. `bodies` must outlive this object.
  explicit PathExtremes(const ExactBodies& bodies);

  bool any() const { return !found_.empty(); }
  /// Call this before body i gets another flight at the present instant.
  void note(Entity i);
  /// The extremes from time 0 to `time` (s), by options.watch. Flights that last are taken up to there.
  std::vector<Extremes> up_to(double time) const;

 private:
  void take(Entity i, const Instant& until, std::vector<Extremes>& found) const;

  const ExactBodies& bodies_;
  std::vector<Extremes> found_;  // by options.watch
  std::vector<Instant> seen_;    // by body: until when its path has been taken
};

}  // namespace carom
