#pragma once
// Time stepping of an island with contacts that change too often to be followed. Between two steps a carried member
// flies straight and the others fall freely. Impacts with and within the island are found and resolved as everywhere
// else. At a step contact takes away slow approaches at once. Fast ones stay impacts. The new velocities are then the
// nearest to those by forces alone that keep every pair apart until the next step (contact_problem.h). They are
// linearised at the closest points, which is on the safe side for convex bodies on straight paths. (Stewart & Trinkle,
// Int. J. Numer. Meth. Eng. 39 (1996) 2673, without friction and with exact impacts.) An impact uses the velocities
// that bodies have at its time, not those of the step's kick at its end. A body that an impact throws off its support
// falls freely, and the next step is due after a shortest one. A step that ends early takes back the effect of forces
// in its rest.
//
// Members that were just struck keep a margin. The small motions after a strike then wait for the next step instead of
// making thousands of impacts at one instant. The margin shrinks as the island slows down. Bodies that touch within
// their margin separate a little, as far as the loss of slow approaches pays for it. An island that forces hold in
// balance is put to rest: its velocities are exactly zero, and it takes no steps until it is struck.
#include <utility>
#include <vector>

#include "simulate/contact/contact_list.h"
#include "simulate/contact/numbering.h"
#include "solver/contact_problem.h"

namespace carom {

struct ExactBodies;
struct Island;

class ExactGroup;
class FlightChanges;
class ModeChanges;

class TimeStepping {
 public:
  TimeStepping(ExactBodies& bodies, ModeChanges& modes, ExactGroup& group, FlightChanges& flights)
      : bodies_(bodies), modes_(modes), group_(group), flights_(flights) {}

  /// Takes the next step of member i's island. Islands that it may press on before the step ends are united with it.
  /// False: one of them has taut strings, and no step is taken. It would let these lengthen.
  bool advance(Entity i);

 private:
  /// A step, in numbers of its own.
  struct Step {
    explicit Step(Numbering of_members) : members(std::move(of_members)) {}

    Numbering members;                // of the members, ascending
    double length = 0, shortest = 0;  // s
    // Consecutive steps that simultaneous impacts ended at once.
    std::uint32_t short_steps = 0;
    // The least radius (m), and the greatest acceleration (m/s^2).
    double smallest = never, greatest = 0;
    std::vector<Vec3> x, v;                  // m and m/s, at present
    std::vector<Vec3> after_impacts;         // m/s, without the approaches that contact takes away at once
    std::vector<Vec3> solved;                // m/s, from this instant on
    std::vector<double> expected;            // m/s: half of the speed for which contacts are searched
    std::vector<double> inverse_mass;        // 1/kg
    std::vector<Entity> near;                // bodies of other islands that members may press on
    ContactList contacts;                    // contacts that may press before the step ends
    std::vector<ContactConstraint> impacts;  // by pair: impulses that contact takes at once, or empty
    std::vector<std::uint32_t> island;       // by member: a member that represents its island
    std::vector<double> taking;              // W, by member: power of impacts within the step
    // By member: whether a thing presses on it, and whether it is at rest.
    std::vector<std::uint8_t> carried, rests;
  };
  /// The forces among bodies that may be at rest.
  struct Holding {
    std::vector<ContactConstraint> pairs;
    std::vector<std::size_t> which;  // number in the step's pairs
    std::vector<Vec3> a;             // m/s^2: the members' accelerations under these forces
  };

  Step begin_step(Entity one);
  bool solve_step(Step& step);
  double shortest_step(const Step& step) const;
  bool shorten(Step& step, double shortest) const;
  void find_pairs(Step& step);
  void take_slow_impacts(Step& step);
  void keep_apart(Step& step);
  static double lost_by_impacts(const Step& step);
  static double parting_work(const Step& step);
  bool makes_energy(const Step& step, const std::vector<Vec3>& free) const;
  void find_parts(Step& step);
  void put_to_rest(Step& step);
  std::vector<std::uint8_t> stop_slow(Step& step) const;
  Holding hold(const Step& step, const std::vector<std::uint8_t>& still);
  void take_exact_forces(const Step& step, Holding& holding) const;
  void take_closings(Step& step);
  double taken(const Step& step) const;
  void begin_flights(Step& step);
  static void count_calm(const Step& step, Island& island);
  void split(const Step& step);
  bool begin_flight(const Step& step, std::size_t k, Entity i);

  ExactBodies& bodies_;
  ModeChanges& modes_;
  ExactGroup& group_;
  FlightChanges& flights_;
};

}  // namespace carom
