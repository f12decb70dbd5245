#pragma once
// Crowds that come to rest, and sleeping bodies that a crowd wakes.

#include "physics/contact_quality.h"
#include "simulate/contact/exact_bodies.h"
#include "simulate/crowd/crowd.h"
#include "simulate/crowd/crowd_solver.h"
#include "solver/contact_problem.h"
#include "std.h"

namespace carom {

class ExactGroup;
class FlightChanges;
class ModeChanges;

class CrowdSleep {
 public:
  /// `threads` must outlive this object.
  CrowdSleep(ExactBodies& bodies, ModeChanges& modes, ExactGroup& group, FlightChanges& flights,
             const ContactQuality& quality, CrowdThreads& threads)
      : bodies_(bodies), modes_(modes), group_(group), flights_(flights), quality_(quality), solver_(threads) {}

  /// Puts members to rest that are slow, and that forces hold. Returns whether there are some. Gaps must be measured.
  bool falls_asleep(Crowd& crowd);
  /// Wakes the sleeping bodies on which the step would press.
  void wake_pressed(Crowd& crowd);

 private:
  struct Holding {
    vector<uint32_t> members;  // their numbers in the crowd
    vector<uint32_t> number;   // by member of the crowd: its place in `members`
    vector<ContactConstraint> pairs;
    vector<RowPlace> rows;  // of the pairs
    vector<RowName> names;
  };

  vector<uint8_t> slow_members(Crowd& crowd) const;
  bool has_settled(Crowd& crowd) const;
  Holding touching(const Crowd& crowd, span<const uint8_t> rests) const;
  bool solve_rest(const Crowd& crowd, Holding& holding);
  double unsure_direction(const Crowd& crowd, const Holding& holding) const;
  bool hold_by_sweeps(const Crowd& crowd, Holding& holding, const ContactProblem& problem);
  void apply_at_rest(const Crowd& crowd);
  void put_to_rest(Crowd& crowd, const Holding& holding);
  bool wake_beneath(const Holding& holding);

  ExactBodies& bodies_;
  ModeChanges& modes_;
  ExactGroup& group_;
  FlightChanges& flights_;
  const ContactQuality& quality_;
  const CrowdKernels& kernels_ = widest_crowd_kernels();
  CrowdSolver solver_;
};

}  // namespace carom
