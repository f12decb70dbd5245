#pragma once
// Crowds that come to rest, and sleeping bodies that a crowd wakes.
#include <vector>

#include "physics/contact_quality.h"
#include "simulate/contact/exact_bodies.h"
#include "simulate/crowd/crowd.h"
#include "solver/contact_problem.h"

namespace carom {

class ExactGroup;
class FlightChanges;
class ModeChanges;

class CrowdSleep {
 public:
  CrowdSleep(ExactBodies& bodies, ModeChanges& modes, ExactGroup& group, FlightChanges& flights,
             const ContactQuality& quality)
      : bodies_(bodies), modes_(modes), group_(group), flights_(flights), quality_(quality) {}

  /// Puts a crowd whose step is solved to rest, if it is slow and forces hold it. Returns whether they do.
  bool falls_asleep(Crowd& crowd);
  /// Wakes sleeping bodies on which a member would press in the step. Returns whether there are some.
  bool wake_pressed(const Crowd& crowd);

 private:
  struct Holding {
    std::vector<ContactConstraint> pairs;
    std::vector<RowName> names;  // of the pairs
    bool balanced = false;
  };

  bool is_slow(Crowd& crowd) const;
  Holding solve_rest(const Crowd& crowd) const;
  bool wake_beneath(const Holding& holding);

  ExactBodies& bodies_;
  ModeChanges& modes_;
  ExactGroup& group_;
  FlightChanges& flights_;
  const ContactQuality& quality_;
};

}  // namespace carom
