#pragma once
// Where bouncing ends in lasting contact: inelastic collapse, and slow impacts under load that come one upon the other.
//
// Inelastic collapse (McNamara & Young, Phys. Fluids A 4 (1992) 496): a body between others that close in on it strikes
// them in turn, ever sooner, and what is left of the gaps is gone in no time. The detector sums 1 - e of a body's
// impacts, where e above 1 makes up for others, until it has come away by a billionth of its length, or by what
// positions far off are rounded by. Bouncing on one and the same thing counts once. Impacts in turn that come to an end
// multiply the speeds by sqrt(e) each, as the determinant of what they do says. At the sum at which a collapse is found
// they have left exp(-8) of them: those that go on are a collapse, or as good as over.
#include "simulate/exact_bodies.h"

namespace carom {

class CollapseDetector {
 public:
  explicit CollapseDetector(const ExactBodies& bodies)
      : bodies_(bodies), burst_(bodies.body.size()), collapse_(bodies.body.size()) {}

  /// Counts an impact of a on b at `approach` (m/s). Gives whether it ends in contact: nothing is left of the approach.
  /// press: m/s^2, drives the two together; length: m, the diameter of the smaller one; alone: on a flat surface, not
  /// among bodies. An inelastic collapse ends bouncing at any speed. Under load it also ends when an impact is slow and
  /// one of very many within the time of a hop at that speed, or is slow and meets bodies in lasting contact.
  bool count_impact(Entity a, Entity b, double e, double approach, double press, double length, bool alone);
  /// Counts an impact of body i in turn with the one that caused it; lost: its 1 - e.
  void count_in_turn(Entity i, double lost);

  /// Whether a collapse of body i's impacts has ended in contact at this instant.
  bool ended_now(Entity i) const { return collapse_[i].ended == bodies_.now; }
  /// Whether body i's slow impacts are among bodies, not with flat fixed surfaces alone.
  bool among_bodies(Entity i) const { return burst_[i].bodies; }

 private:
  /// A body's slow impacts that came one upon the other.
  struct Burst {
    double start = 0;  // s
    int impacts = 0;
    bool bodies = false;  // with bodies among them, not with flat fixed surfaces alone
  };
  /// A body's impacts at one place.
  struct Collapse {
    Instant start;
    int impacts = 0;          // with e < 1, and not twice running with the same thing
    double lost = 0;          // the sum of 1 - e, at least 0
    Instant ended{never, 0};  // the last that ended in contact for that
  };

  bool in_burst(Entity i, double window, int many);
  bool collapses(Entity i, Entity other, double e, double approach, double length);

  const ExactBodies& bodies_;
  LazyArray<Burst> burst_;
  LazyArray<Collapse> collapse_;
};

}  // namespace carom
