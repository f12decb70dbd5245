#pragma once
// Constrained motion of a small island: bodies that press on one another keep to each other's surfaces, with
// forces from the complementarity conditions (0 <= force, 0 <= the gap's second derivative, one of them zero; the
// surfaces' curvature in it). Their paths are integrated by the classical Runge-Kutta method of fourth order. Between
// its steps a path is the parabola through both ends, which leaves the true one by less than `path_error` of a radius:
// steps are as short as that asks for. Where all contacts are flat the parabola is the path, and a step lasts until a
// contact comes to its rim. All bodies take part in impacts as everywhere else, only the pairs in contact do not.
#include <vector>

#include "physics/contact_problem.h"
#include "simulate/event_predictor.h"
#include "simulate/exact_group.h"
#include "simulate/flight_changes.h"

namespace carom {

class ConstrainedMotion {
 public:
  ConstrainedMotion(ExactBodies& bodies, ExactGroup& group, FlatContacts& flat, CollapseDetector& collapses,
                    FlightChanges& flights, EventPredictor& predictor);

  /// Takes the next step of member i's island, or of the parts that it has come into. False: one of these has too many
  /// contacts; nothing has changed.
  bool advance(Entity i);

  /// Appends the forces in an island at `time` (s): between two steps they change, and may turn to zero.
  void report(const Island& island, double time, std::vector<ContactForce>& forces) const;

 private:
  struct PairName {
    Entity a, b;
    std::uint8_t feature;
  };

  /// A step, in numbers of its own.
  struct Step {
    std::vector<Entity> members;            // ascending
    double greatest = 0, smallest = never;  // m/s^2, the greatest acceleration; m, the least radius
    std::vector<Vec3> x, v;                 // m, m/s, by member
    std::vector<double> inverse_mass;       // 1/kg
    std::vector<ContactConstraint> pairs;   // in contact,
    std::vector<PairName> names;            // and their names
    std::vector<double> force;              // N, by pair, at the step's start
    std::vector<Vec3> a;                    // m/s^2, at the step's start
    double fastest = 0;                     // m/s
    std::vector<std::uint8_t> rests;        // by member
    std::vector<std::uint8_t> held, bound;  // by member: something presses on it; something that is not flat does
    std::vector<FlatContactList> flats;     // by member: what it rests on if it leaves the group
    std::vector<Vec3> down;                 // m, closes what is left of the gaps to these
    double length = 0, grace = 0;           // s; grace: a body that nothing binds stays for it, to fall back
    std::vector<Vec3> path_a, end_v;        // m/s^2, m/s: the parabolas, and the velocities at the step's end
  };

  Step begin_step(std::vector<Entity> members) const;
  std::vector<std::uint32_t> parts_of(const Step& step) const;
  void advance_whole(Step& step);
  void find_contacts(Step& step) const;
  void close_overlaps(Step& step) const;
  void take_approaches(Step& step);
  void drop_parting(Step& step) const;
  std::vector<Vec3> accelerate(Step& step, const std::vector<Vec3>& x, const std::vector<Vec3>& v) const;
  void stop_parting(Step& step) const;
  void find_resting(Step& step) const;
  void choose_length(Step& step) const;
  double length_for(const Step& step, std::size_t pair, double length, double moment) const;
  void find_unbound(Step& step) const;
  bool leaves(const Step& step, std::size_t k) const;
  void integrate(Step& step) const;
  void note_contacts(const Step& step);
  void begin_flights(const Step& step);
  bool begin_flight(const Step& step, std::size_t k, Entity i);
  void forget_index(const std::vector<Entity>& members) const;

  Vec3 at(const std::vector<Vec3>& x, Entity e) const;  // m, of a member or a fixed thing
  Vec3 rate(const std::vector<Vec3>& v,
            Entity e) const;  // the same of a velocity or an acceleration: fixed things have none

  ExactBodies& bodies_;
  ExactGroup& group_;
  FlatContacts& flat_;
  CollapseDetector& collapses_;
  FlightChanges& flights_;
  EventPredictor& predictor_;
  LazyArray<Instant> arrival_time_;           // by body: when the step ends if nothing happens before,
  LazyArray<Vec3> arrival_v_;                 // m/s, its velocity then,
  LazyArray<std::uint16_t> arrival_version_;  // if it is still on this flight
};

}  // namespace carom
