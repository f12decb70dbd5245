#pragma once
// A step of a crowd, as changes of its drifts: impacts, the kick by forces, and the impulses of contacts.
//
// Impacts use the velocities of the instant, not those of the drift: with the latter elastic balls lose energy, and
// resting bodies strike their floor in each step.

#include "physics/contact_quality.h"
#include "simulate/contact/exact_bodies.h"
#include "simulate/crowd/crowd.h"
#include "simulate/crowd/crowd_solver.h"
#include "std.h"

namespace carom {

class CrowdSteps {
 public:
  /// `threads` must outlive the steps.
  CrowdSteps(ExactBodies& bodies, const ContactQuality& quality, CrowdThreads& threads);

  /// Solves the step of a crowd whose gaps are measured, and shortens it where that is necessary. False: a body has
  /// become too fast for the list. Drifts then have the impacts alone.
  bool solve(Crowd& crowd);
  /// Gives things that swing the velocities that take them to their places at the step's end.
  void drift_things(Crowd& crowd) const;
  /// Finds the forces of rows in the solved step, the accelerations of members, and which of them are pressed.
  void finish(Crowd& crowd);
  /// What contact lends of member k's kinetic energy when its drift is so old (s), and gives back as its force falls
  /// (J). The velocity of then is ahead by a kick of the present force. In equal steps of h without other forces, where
  /// contacts do no work on drifts, the kinetic energy and m (h a / 2)^2 / 2 together lose m (h / 2)^2 (a' - a)^2 as
  /// the acceleration a becomes a', and never gain. Accelerations that forces give count as none.
  double lent(const Crowd& crowd, size_t k, double age) const;
  /// Books what contacts have taken (J), and what of it is lent. Errors may make the rest negative.
  void take(Crowd& crowd, double energy, double lent) const;

 private:
  double return_of_step(const Crowd& crowd) const;
  bool may_return(const Crowd& crowd) const;
  bool aim(Crowd& crowd);
  void bend(Crowd& crowd);
  void unbend(Crowd& crowd);
  bool strike(Crowd& crowd);
  /// Impacts of a part of the rows in one round.
  struct Strikes {
    vector<Collision> met;
    double lost = 0;  // J
    double work = 0;  // J, of things that move
    RowName struck;   // a row with a sleeping body, at which they end
  };
  void strike(Crowd& crowd, size_t part, double within, Strikes& strikes);
  void book(const Strikes& strikes) const;
  bool presses_on_sleepers(const Crowd& crowd) const;
  void strike(Crowd& crowd, size_t group, size_t lane, Strikes& strikes);
  void restart_if_short(Crowd& crowd) const;
  double push(Crowd& crowd, size_t group, size_t lane, double impulse, vector<Four>& drifts);
  double kinetic_energy(const Crowd& crowd) const;
  double approach(const Crowd& crowd, size_t group, size_t lane) const;
  void kick(Crowd& crowd);
  double speed_in_contact(const Crowd& crowd);
  CrowdSolver::Goal goal(const Crowd& crowd) const;
  bool balance(Crowd& crowd);
  void shorten(Crowd& crowd, double length);
  double longest(const Crowd& crowd) const;
  void start_warm(Crowd& crowd);
  static bool give_up_returns(Crowd& crowd);
  bool keep_apart(Crowd& crowd, double rounding);
  double safe_length(const Crowd& crowd);
  bool solve_exactly(Crowd& crowd) const;
  vector<RowPlace> closing_rows(const Crowd& crowd, double rounding);
  void absorb_approaches(Crowd& crowd);
  void find_forces(Crowd& crowd, size_t part) const;

  ExactBodies& bodies_;
  const ContactQuality& quality_;
  const CrowdKernels& kernels_ = widest_crowd_kernels();
  CrowdThreads& threads_;
  const bool shells_;  // there are any
  CrowdSolver solver_;
  vector<uint8_t> may_strike_;  // by group
  vector<Four> now_;            // velocities of the instant, by number
  vector<Four> before_;         // those of the drift before the kick
  vector<Four> free_;           // and after it, without contacts
  vector<double> bends_;        // m, by row: what its gap has less of because its thing bends, at most 0
  vector<double> bases_;        // m, by row: the same of its base
};

}  // namespace carom
