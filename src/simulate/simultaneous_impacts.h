#pragma once
// Impacts at one instant among bodies of the contact group. One that is pushed to and fro between others would go on so
// for ever: then it and all that touch it are struck at once, and with them all that would meet before the next step
// for it. Time stepping keeps bodies apart by a margin: those within it touch. Where margins are wide they part a
// little, lest they strike again at the next rounding.
#include <vector>

#include "physics/contact_problem.h"
#include "simulate/contact_list.h"
#include "simulate/event_predictor.h"
#include "simulate/exact_group.h"
#include "simulate/flight_changes.h"

namespace carom {

class SimultaneousImpacts {
 public:
  SimultaneousImpacts(ExactBodies& bodies, ExactGroup& group, FlightChanges& flights, EventPredictor& predictor)
      : bodies_(bodies), group_(group), flights_(flights), predictor_(predictor) {}

  /// An impact of body i has ended in contact. After some of them since the last time step it is struck with others at
  /// once.
  void count_impact(Entity i);

 private:
  /// Members that are struck together, in numbers of their own.
  struct Struck {
    double rest = 0;   // s, until the next step
    double slack = 0;  // m/s, that any pair may approach by
    std::vector<Entity> members;
    ContactList near;                 // what the members are near; a of its pairs: the member's number
    std::vector<std::uint8_t> added;  // of what is near: whether it is among the pairs
    std::vector<ContactConstraint> pairs;
    std::vector<double> inverse_mass;  // 1/kg
    std::vector<Vec3> before, after;   // m/s
  };

  Struck strike(Entity first) const;
  void take_in(Struck& set, Entity i) const;
  double approach(const Struck& set, std::size_t near) const;
  double margin(const Struck& set, std::size_t near) const;
  double allowed(const Struck& set, std::size_t near) const;
  double slack(const Struck& set, std::size_t near) const;
  void add(Struck& set, std::size_t near) const;
  bool add_meeting(Struck& set) const;
  void solve(Struck& set, bool part) const;
  std::vector<Entity> begin_flights(const Struck& set);

  ExactBodies& bodies_;
  ExactGroup& group_;
  FlightChanges& flights_;
  EventPredictor& predictor_;
};

}  // namespace carom
