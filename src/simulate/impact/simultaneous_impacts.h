#pragma once
// Impacts at one instant among members of an island. A body that others push to and fro would be struck for
// ever. It and all that touch it are therefore struck at once, together with all that would meet before the next step
// because of it. The rest of the time step is solved anew for these bodies, as a step is: impacts first, then forces.
// No contact then continues to press on a body that was struck off it, which would make energy. Time stepping keeps a
// margin between bodies. Those within it count as touching. Where margins are wide they separate a little, so that the
// next rounding does not make them strike again.
#include <utility>
#include <vector>

#include "simulate/contact/contact_list.h"
#include "simulate/contact/numbering.h"
#include "solver/contact_problem.h"

namespace carom {

struct ExactBodies;

class ExactGroup;
class FlightChanges;

class SimultaneousImpacts {
 public:
  SimultaneousImpacts(ExactBodies& bodies, ExactGroup& group, FlightChanges& flights)
      : bodies_(bodies), group_(group), flights_(flights) {}

  /// Counts an impact of body i that has ended in contact. After some of them since the last time step, the body is
  /// struck together with others.
  void count_impact(Entity i);

 private:
  /// Members that are struck together, in numbers of their own.
  struct Struck {
    explicit Struck(Numbering of_members) : members(std::move(of_members)) {}

    Numbering members;  // of the members
    double rest = 0;    // s, until the next step
    double slack = 0;   // m/s, allowed approach of any pair
    // Touching pairs separate, if that is possible and makes no energy.
    bool part = false;
    ContactList near;                 // things near the members; a of its pairs: the member's number
    std::vector<std::uint8_t> added;  // by near thing: whether it is among the pairs
    std::vector<double> held;         // kg m/s, by near thing: impulse of its force in the rest of the step
    std::vector<std::size_t> which;   // by pair: number of the near thing
    std::vector<ContactConstraint> pairs, impacts;  // with the forces in the rest of the step, and at this instant
    std::vector<double> inverse_mass;               // 1/kg
    // m/s: at this instant, and with the effect of forces expected for the rest of the step.
    std::vector<Vec3> before, path;
    // m/s: after the impacts, and from this instant on, with the effect of forces.
    std::vector<Vec3> struck, after;
    // m/s: the effect of forces in the rest of the step.
    std::vector<Vec3> forced;
  };

  Struck strike(Entity first);
  void take_in(Struck& set, Entity i) const;
  double remaining(const Struck& set, Entity i) const;
  double remaining(const Struck& set, Entity i, Entity e) const;
  Vec3 forced(const Struck& set, Entity i) const;
  double approach(const Struck& set, const std::vector<Vec3>& velocities, std::size_t near) const;
  double margin(const Struck& set, std::size_t near) const;
  double allowed(const Struck& set, std::size_t near) const;
  double slack(const Struck& set, std::size_t near) const;
  void add(Struck& set, std::size_t near) const;
  bool add_meeting(Struck& set) const;
  void take_impacts(Struck& set);
  void solve(Struck& set);
  static bool makes_energy(const Struck& set);
  void note_forces(const Struck& set);
  void begin_flights(const Struck& set);

  ExactBodies& bodies_;
  ExactGroup& group_;
  FlightChanges& flights_;
};

}  // namespace carom
