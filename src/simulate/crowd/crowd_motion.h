#pragma once
// Crowds: islands with contacts that change too often to be followed one by one. All bodies of an island take one
// synchronous step, without events inside it:
//
// 1. The list of pairs that may press, if bodies have gone too far since the last one. Bodies of other kinds that could
//    meet a member join.
// 2. Impacts, with the velocities of this instant: pairs that would close their gap in the step, and are faster than
//    slow contact, strike one at a time.
// 3. A kick by forces for the time since the middle of the last step.
// 4. Impulses that keep all pairs apart until the step's end (crowd_solver.h).
// 5. A straight drift at the new velocities.
//
// Drifts are straight, and bodies are convex and do not turn. The half space at a pair's closest points therefore
// contains the other body for the whole step, and no pair overlaps at any instant. The step is a leapfrog: it has order
// 2 but for impacts, which are early by up to a step. Contacts keep a gap of up to the shell.

#include "physics/contact_force.h"
#include "simulate/crowd/crowd_list.h"
#include "simulate/crowd/crowd_sleep.h"
#include "simulate/crowd/crowd_steps.h"
#include "std.h"

namespace carom {

class CrowdMotion {
 public:
  CrowdMotion(ExactBodies& bodies, ModeChanges& modes, ExactGroup& group, FlightChanges& flights);

  /// Takes the next step of member i's island. Islands and free bodies that a member may meet soon unite with it.
  /// False: one of them has taut strings, or contacts have not changed for a while, and no step is taken.
  bool advance(Entity i);
  /// Ends the present step of member i's island at this instant. The next one is due.
  void interrupt(Entity i);
  /// Books the present steps of an island up to `time` (s), the run's end.
  void book_last(const Island& island, double time) const;
  /// Appends the forces in the present step of an island.
  static void report(const Island& island, vector<ContactForce>& forces);

 private:
  // What was before the step.
  void close(Crowd& crowd, const Instant& at) const;
  void book(Crowd& crowd, double since, bool full) const;
  double book_couplings(const Crowd& crowd, double since) const;
  void couple(Crowd& crowd) const;
  double work_on(const Crowd& crowd, size_t k, double since) const;
  void free_flights(Crowd& crowd) const;

  // What takes part.
  Crowd& gather(Island& island);
  void add_member(Crowd& crowd, size_t k, bool comes);
  void take_over(Crowd& crowd, const Crowd& earlier, vector<uint8_t>& known) const;
  void renew_forces(Crowd& crowd) const;
  double longest_step(const Crowd& crowd) const;
  bool take_guests(Entity i);
  vector<Entity> choose_guests(Crowd& crowd, span<const Entity> near);
  vector<Entity> unite(Entity i, span<const Entity> guests);
  void go_on_with(Entity i, Crowd& earlier);
  bool list(Crowd& crowd);
  bool let_go(Crowd& crowd);
  bool split(Crowd& crowd);
  void move_things(Crowd& crowd) const;

  // The step, and what comes after it.
  bool solve_step(Crowd& crowd);
  void begin(Crowd& crowd);
  static void count_calm(Island& island, Crowd& crowd);

  ExactBodies& bodies_;
  ModeChanges& modes_;
  ExactGroup& group_;
  FlightChanges& flights_;
  const ContactQuality& quality_;
  CrowdThreads threads_;
  CrowdList list_;
  CrowdSteps steps_;
  CrowdSleep sleep_;
};

}  // namespace carom
