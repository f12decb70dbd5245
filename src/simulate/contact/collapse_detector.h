#pragma once
// The end of bouncing in lasting contact: inelastic collapse, and slow impacts in quick succession of bodies that are
// pressed together.
//
// Inelastic collapse (McNamara & Young, Phys. Fluids A 4 (1992) 496): a body between others that close in on it strikes
// them in turn, ever sooner. What is left of the gaps vanishes in no time. The detector sums 1 - e over a body's
// impacts, where an e above 1 counts against the others. The sum ends when the body has moved away by a billionth of
// its length. Far from the origin the limit is the rounding of positions. Repeated bounces on the same thing count
// once. Impacts in turn that end multiply the speeds by sqrt(e) each, by the determinant of their map. At the sum that
// counts as a collapse, exp(-8) of the speeds is left. Impacts that continue beyond it are a collapse, or practically
// over.
#include "simulate/contact/exact_bodies.h"

namespace carom {

class CollapseDetector {
 public:
  explicit CollapseDetector(const ExactBodies& bodies)
      : bodies_(bodies), burst_(bodies.body.size()), collapse_(bodies.body.size()) {}

  /// Counts an impact of a on b at `approach` (m/s). Returns whether it ends in contact, so that nothing is left of the
  /// approach. `press`: the acceleration that drives the two together (m/s^2). `length`: the diameter of the smaller
  /// one, or a's radius on a fixed thing (m). `alone`: on a flat surface, not among bodies. An inelastic collapse ends
  /// bouncing at any speed. Where the two are pressed together a slow impact also ends it in two cases. It is one of
  /// very many within the time of a hop at that speed, or it meets bodies in lasting contact. `again`: the two have met
  /// at this instant before, and only the last case ends their impact.
  bool count_impact(Entity a, Entity b, double e, double approach, double press, double length, bool alone,
                    bool again = false);
  /// Counts an impact of body i in turn with the impact that caused it. lost: its 1 - e.
  void count_in_turn(Entity i, double lost);

  /// Whether a collapse of body i's impacts has ended in contact at this instant.
  bool ended_now(Entity i) const { return collapse_[i].ended == bodies_.now; }
  /// Whether bodies take part in body i's slow impacts, not flat fixed surfaces alone.
  bool among_bodies(Entity i) const { return burst_[i].bodies; }

  void keep(auto& archive) { archive(burst_, collapse_); }

 private:
  /// Slow impacts of a body in quick succession.
  struct Burst {
    double start = 0;  // s
    int impacts = 0;
    // Bodies take part, not flat fixed surfaces alone.
    bool bodies = false;

    void keep(auto& archive) { archive(start, impacts, bodies); }
  };
  /// Impacts of a body at one place.
  struct Collapse {
    Instant start;
    double lost = 0;  // the sum of 1 - e, at least 0, without repeated impacts on the same thing
    // The last collapse that ended in contact.
    Instant ended{never, 0};
  };

  bool in_burst(Entity i, double window, int many);
  bool collapses(Entity i, Entity other, double e, double approach, double length);

  const ExactBodies& bodies_;
  LazyArray<Burst> burst_;
  LazyArray<Collapse> collapse_;
};

}  // namespace carom
