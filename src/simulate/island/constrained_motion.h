#pragma once
// Constrained motion of an island: bodies that press on each other stay on each other's surfaces. Where all contacts
// are flat, or nothing slides, paths are parabolas, and a step lasts until a contact reaches its rim. Where surfaces
// are curved, a method of order 8 follows the motion step by step (constrained_system.h). Within a step a body flies
// along a polynomial of degree 8. All bodies take part in impacts as elsewhere, except the pairs in contact. After a
// change the first step is a moment. It is too short for anything but impacts at the same place, so that many of these
// cost one step.
//
// A step is found as a value (constrained_steps.h), and applied here.

#include "numerics/lazy_array.h"
#include "physics/contact_force.h"
#include "simulate/island/constrained_steps.h"
#include "simulate/island/contact_search.h"
#include "std.h"

namespace carom {

class CollapseDetector;
class FlightChanges;

class ConstrainedMotion {
 public:
  ConstrainedMotion(ExactBodies& bodies, ModeChanges& modes, ExactGroup& group, FlatContacts& flat,
                    CollapseDetector& collapses, FlightChanges& flights);

  /// Takes the next step of member i's island, or of the parts into which it has split. False: its contacts change too
  /// often, and nothing else has changed.
  bool advance(Entity i);

  /// The number of steps so far along paths that are not exact, but for rounding.
  uint64_t inexact_steps() const { return inexact_steps_; }

  /// Appends the forces in an island at `time` (s). They change between two steps, and may turn to zero.
  void report(const Island& island, double time, vector<ContactForce>& forces) const;

  void keep(auto& archive) {
    archive(following_, inexact_steps_);
    bodies_.contact_work.keep<IslandWork>(archive);
  }

 private:
  /// The path that a body follows, if it is still on this flight.
  struct Following {
    shared_ptr<const IslandPath> path;
    uint32_t place = 0;    // number in the path
    uint16_t version = 0;  // of the flight
    bool bound = false;    // things other than flat surfaces press on the body

    void keep(auto& archive) { archive(path, place, version, bound); }
  };

  void take_in_touching(Entity i);
  bool count_change(Island& island, double load, double smallest) const;
  void book_before_switch(Entity i);
  IslandStep begin_step(const vector<Entity>& members, bool undisturbed);
  pair<Vec3, Vec3> place_of(Entity i) const;
  void apply(IslandStep& step);
  void book(const IslandStep& step);
  void note_contacts(const IslandStep& step);
  void note_untouched(const IslandStep& step);
  void begin_flights(const IslandStep& step);
  bool begin_flight(const IslandStep& step, uint32_t k);

  ExactBodies& bodies_;
  ModeChanges& modes_;
  ExactGroup& group_;
  FlatContacts& flat_;
  CollapseDetector& collapses_;
  FlightChanges& flights_;
  const ContactSearch search_;
  const ConstrainedSteps steps_;
  LazyArray<Following> following_;  // by body
  uint64_t inexact_steps_ = 0;
};

}  // namespace carom
