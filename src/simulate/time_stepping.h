#pragma once
// Time stepping of an island whose contacts change too often to be followed. Between two steps a member that is carried
// flies straight and the others fall freely, so that impacts with and within the island are found and resolved as
// everywhere else. At a step contact takes slow approaches at once; fast ones are left to be impacts. Then the
// velocities are those nearest to what forces alone would make of them that keep every pair apart until the next step
// (contact_problem.h): linearised at the closest points, which for convex bodies on straight paths is on the safe side.
// (Stewart & Trinkle, Int. J. Numer. Meth. Eng. 39 (1996) 2673, without friction and with exact impacts.) An impact
// meets the velocities that bodies have by then, not those that the step's kick has given them for its end. A body that
// an impact throws off what carries it falls freely, and the next step is due after a shortest one. A step that ends
// early takes back what forces would have done in its rest.
//
// Members that have just been struck are kept apart by a margin, so that the small motions that a strike causes wait
// for the next step instead of making thousands of impacts at one instant. The margin shrinks as the group slows down.
// Bodies that touch inside their margin part a little, as far as what slow approaches have lost pays for it.
// An island that forces hold in balance is put to rest: velocities exactly zero, no more steps, until struck.
#include <vector>

#include "simulate/contact_list.h"
#include "solver/contact_problem.h"

namespace carom {

struct ExactBodies;
struct Island;

class EventPredictor;
class ExactGroup;
class FlightChanges;

class TimeStepping {
 public:
  TimeStepping(ExactBodies& bodies, ExactGroup& group, FlightChanges& flights, EventPredictor& predictor)
      : bodies_(bodies), group_(group), flights_(flights), predictor_(predictor) {}

  /// Takes the next step of member i's island, with those of other islands that it may press on before the step ends.
  void advance(Entity i);

 private:
  /// A step, in numbers of its own.
  struct Step {
    std::vector<Entity> members;               // ascending
    double length = 0, shortest = 0;           // s
    std::uint32_t short_steps = 0;             // on end, that simultaneous impacts ended at once
    double smallest = never, greatest = 0;     // m, the least radius; m/s^2, the greatest acceleration
    std::vector<Vec3> x, v;                    // m, m/s: now,
    std::vector<Vec3> after_impacts;           // m/s: without the approaches that contact takes at once,
    std::vector<Vec3> solved;                  // m/s: from now on
    std::vector<double> expected;              // m/s: half of the speed that contacts are searched for
    std::vector<double> inverse_mass;          // 1/kg
    std::vector<Entity> near;                  // bodies of other islands that members may press on
    ContactList contacts;                      // that may press before the step ends
    std::vector<ContactConstraint> impacts;    // by pair: what contact takes at once, or none
    std::vector<std::uint32_t> island;         // by member: one of those that press on one another with it
    std::vector<double> taking;                // W, by member: what impacts within the step take
    std::vector<std::uint8_t> carried, rests;  // by member: something presses on it; it is at rest
  };
  /// The forces among bodies that may be at rest.
  struct Holding {
    std::vector<ContactConstraint> pairs;
    std::vector<std::size_t> which;  // of the step's pairs
    std::vector<Vec3> a;             // m/s^2: what they leave of the members' accelerations
  };

  Step begin_step(Entity one) const;
  bool solve_step(Step& step) const;
  double shortest_step(const Step& step) const;
  bool shorten(Step& step, double shortest) const;
  void find_pairs(Step& step) const;
  void take_slow_impacts(Step& step) const;
  void keep_apart(Step& step) const;
  static double lost_by_impacts(const Step& step);
  static double parting_work(const Step& step);
  bool makes_energy(const Step& step, const std::vector<Vec3>& free) const;
  void find_parts(Step& step);
  void put_to_rest(Step& step) const;
  std::vector<std::uint8_t> stop_slow(Step& step) const;
  Holding hold(const Step& step, const std::vector<std::uint8_t>& still) const;
  void take_closings(Step& step) const;
  double taken(const Step& step) const;
  void begin_flights(Step& step);
  static void count_calm(const Step& step, Island& island);
  void split(const Step& step);
  bool begin_flight(const Step& step, std::size_t k, Entity i);

  ExactBodies& bodies_;
  ExactGroup& group_;
  FlightChanges& flights_;
  EventPredictor& predictor_;
};

}  // namespace carom
