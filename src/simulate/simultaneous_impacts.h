#pragma once
// Impacts at one instant among bodies of the contact group. One that is pushed to and fro between others would go on so
// for ever: then it and all that touch it are struck at once, and with them all that would meet before the next step
// for it. For these bodies the rest of the time step is solved anew, as a step is: impacts first, then what forces do.
// So no contact goes on to press on what has been struck off it, which would make energy. Time stepping keeps bodies
// apart by a margin: those within it touch. Where margins are wide they part a little, lest they strike again at the
// next rounding.
#include <vector>

#include "simulate/contact_list.h"
#include "solver/contact_problem.h"

namespace carom {

struct ExactBodies;

class EventPredictor;
class ExactGroup;
class FlightChanges;

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
    double rest = 0;    // s, until the next step
    double slack = 0;   // m/s, that any pair may approach by
    bool part = false;  // those that touch part, if that is possible and makes no energy
    std::vector<Entity> members;
    ContactList near;                               // what the members are near; a of its pairs: the member's number
    std::vector<std::uint8_t> added;                // of what is near: whether it is among the pairs
    std::vector<double> held;                       // kg m/s, of what is near: what presses, in the rest of the step
    std::vector<std::size_t> which;                 // by pair: of what is near
    std::vector<ContactConstraint> pairs, impacts;  // forces in the rest of the step, and now
    std::vector<double> inverse_mass;               // 1/kg
    std::vector<Vec3> before, path;                 // m/s: now, and with what forces were to do in the rest of the step
    std::vector<Vec3> struck, after;                // m/s: after the impacts, and from now on, with what
    std::vector<Vec3> forced;                       // m/s, forces do in it
  };

  Struck strike(Entity first) const;
  void take_in(Struck& set, Entity i) const;
  double remaining(const Struck& set, Entity i) const;
  double remaining(const Struck& set, Entity i, Entity e) const;
  Vec3 forced(const Struck& set, Entity i) const;
  double pressing(Entity i, Entity e) const;
  double approach(const Struck& set, const std::vector<Vec3>& velocities, std::size_t near) const;
  double margin(const Struck& set, std::size_t near) const;
  double allowed(const Struck& set, std::size_t near) const;
  double slack(const Struck& set, std::size_t near) const;
  void add(Struck& set, std::size_t near) const;
  bool add_meeting(Struck& set) const;
  void take_impacts(Struck& set) const;
  void solve(Struck& set) const;
  static bool makes_energy(const Struck& set);
  void note_forces(const Struck& set);
  std::vector<Entity> begin_flights(const Struck& set);

  ExactBodies& bodies_;
  ExactGroup& group_;
  FlightChanges& flights_;
  EventPredictor& predictor_;
};

}  // namespace carom
