#pragma once
// Constrained motion of an island: bodies that press on each other stay on each other's surfaces. Where all contacts
// are flat, or nothing slides, paths are parabolas, and a step lasts until a contact reaches its rim. Where surfaces
// are curved, a method of order 8 follows the motion step by step (constrained_system.h). Within a step a body flies
// along a polynomial of degree 8. All bodies take part in impacts as elsewhere, except the pairs in contact. After a
// change the first step is a moment. It is too short for anything but impacts at the same place, so that many of these
// cost one step.
#include <memory>
#include <vector>

#include "physics/contact_force.h"
#include "simulate/constrained_system.h"
#include "simulate/flat_contacts.h"
#include "simulate/instant.h"
#include "simulate/lazy_array.h"
#include "solver/contact_problem.h"

namespace carom {

class CollapseDetector;

class ExactGroup;
class FlightChanges;

class ConstrainedMotion {
 public:
  ConstrainedMotion(ExactBodies& bodies, Modes& modes, ExactGroup& group, FlatContacts& flat,
                    CollapseDetector& collapses, FlightChanges& flights);

  /// Takes the next step of member i's island, or of the parts into which it has split. False: its contacts change too
  /// often, and nothing else has changed.
  bool advance(Entity i);

  /// The number of steps so far along paths that are not exact, but for rounding.
  std::uint64_t inexact_steps() const { return inexact_steps_; }

  /// Appends the forces in an island at `time` (s). They change between two steps, and may turn to zero.
  void report(const Island& island, double time, std::vector<ContactForce>& forces) const;

 private:
  /// The path of an island's bodies in a step.
  struct Path {
    Instant start;
    std::unique_ptr<DenseMotion> motion;
  };
  /// The path that a body follows, if it is still on this flight.
  struct Following {
    std::shared_ptr<const Path> path;
    std::uint32_t place = 0;    // number in the path
    std::uint16_t version = 0;  // of the flight
    bool bound = false;         // things other than flat surfaces press on the body
  };

  /// A step, in numbers of its own.
  struct Step {
    std::vector<Entity> members;  // ascending
    // The load (m/s^2) and the least radius (m).
    double greatest = 0, smallest = never;
    std::vector<Vec3> x, v;            // m and m/s, by member
    std::vector<double> inverse_mass;  // 1/kg
    ContactList contacts;              // force: N, at the step's start
    std::vector<Vec3> a;               // m/s^2, at the step's start
    double fastest = 0;                // m/s
    std::vector<std::uint8_t> rests;   // by member
    // By member: whether a thing presses on it, and whether a thing that is not flat does.
    std::vector<std::uint8_t> held, bound;
    std::vector<FlatContactList> flats;  // by member: the surfaces on which it rests if it leaves the group
    std::vector<Vec3> down;              // m, closes the remaining gaps to these
    // s. A body that nothing binds stays for the time `grace`, to fall back.
    double length = 0, grace = 0;
    double fade = 0;                   // 1/s, of all members' accelerations
    std::shared_ptr<const Path> path;  // none: parabolas
    // Of the path, where things that move take part: to integrate their work. none: they do not.
    std::shared_ptr<ConstrainedSystem> forces;
    bool undisturbed = false;  // the step before has reached its end
  };

  bool follows(Entity i) const;
  double step_share() const;
  bool count_change(const Step& step) const;
  void take_in_touching(Entity i);
  Step begin_step(std::vector<Entity> members) const;
  std::vector<std::uint32_t> parts_of(const Step& step) const;
  void advance_whole(Step& step);
  void find_contacts(Step& step) const;
  void find_touching(Step& step) const;
  double load_of(const Step& step) const;
  void drop_striking(Step& step) const;
  void find_strings(Step& step, std::size_t k) const;
  void close_overlaps(Step& step) const;
  void take_approaches(Step& step);
  double surface_speed(const Vec3& normal, Entity e) const;
  std::vector<AbsorbedImpact> absorbed_impacts(const Step& step, const std::vector<Vec3>& met) const;
  void record_fast(const Step& step, std::vector<AbsorbedImpact>& impacts) const;
  double parting_speed(const Step& step) const;
  void drop_parting(Step& step) const;
  ConstrainedSystem find_forces(Step& step) const;
  void check_digits(const Step& step, double acceleration) const;
  double turn_by_rounding(const Step& step, std::size_t pair) const;
  void check_directions(const Step& step) const;
  double leverage(const Step& step, std::size_t pair) const;
  [[noreturn]] void fail_jammed(Entity i, double force) const;
  bool stop_parting(Step& step) const;
  void find_resting(Step& step) const;
  void note_unbalanced(const Step& step) const;
  double longest(Step& step) const;
  void choose_motion(Step& step, ConstrainedSystem& system);
  double rim_time(const Step& step, std::size_t pair, double length) const;
  double away_time(const Step& step, std::size_t pair) const;
  void find_unbound(Step& step) const;
  bool leaves(const Step& step, std::size_t k) const;
  void note_contacts(const Step& step);
  void begin_flights(const Step& step);
  bool begin_flight(const Step& step, std::size_t k, Entity i);
  void clear_index(const std::vector<Entity>& members) const;

  Vec3 at(const std::vector<Vec3>& x, Entity e) const;            // m, of a member or a fixed thing
  Vec3 rate(const std::vector<Vec3>& v, Entity e) const;          // m/s
  Vec3 acceleration(const std::vector<Vec3>& a, Entity e) const;  // m/s^2

  ExactBodies& bodies_;
  Modes& modes_;
  ExactGroup& group_;
  FlatContacts& flat_;
  CollapseDetector& collapses_;
  FlightChanges& flights_;
  LazyArray<Following> following_;  // by body
  std::uint64_t inexact_steps_ = 0;
};

}  // namespace carom
