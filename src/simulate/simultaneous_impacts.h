#pragma once
// Impacts at one instant among bodies of the contact group. One that is pushed to and fro between others would go on so
// for ever: then all of those that touch one another there are struck at once. Where margins are wide they part a
// little, lest they strike again at the next rounding.
#include <vector>

#include "physics/contact_problem.h"
#include "simulate/event_predictor.h"
#include "simulate/exact_group.h"
#include "simulate/flight_changes.h"

namespace carom {

class SimultaneousImpacts {
 public:
  SimultaneousImpacts(ExactBodies& bodies, ExactGroup& group, FlightChanges& flights, EventPredictor& predictor)
      : bodies_(bodies), group_(group), flights_(flights), predictor_(predictor) {}

  /// An impact of body i has ended in contact. After some of them since the last time step it and all that touch one
  /// another there are struck at once.
  void count_impact(Entity i);

 private:
  /// Members that touch one another, in numbers of their own.
  struct Touching {
    std::vector<Entity> members;
    std::vector<ContactConstraint> pairs;
    std::vector<double> inverse_mass;  // 1/kg
    std::vector<Vec3> before, after;   // m/s
  };

  Touching find_touching(Entity first) const;
  void solve(Touching& set, bool part) const;
  std::vector<Entity> begin_flights(const Touching& set);

  ExactBodies& bodies_;
  ExactGroup& group_;
  FlightChanges& flights_;
  EventPredictor& predictor_;
};

}  // namespace carom
