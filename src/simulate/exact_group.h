#pragma once
// The exact simulator's bodies in lasting contact with one another and with anything that is not flat, where paths have
// no closed form. Each island of them moves in steps of its own: by constrained motion (constrained_motion.h), or by
// time stepping (time_stepping.h) where its contacts change too often. Here: what is known of each of these bodies, and
// what impacts do to them between steps.
#include <vector>

#include "simulate/exact_bodies.h"

namespace carom {

class CollapseDetector;
class FlatContacts;
class PathLog;

/// One end of a contact with a force: the lower body's list has the other one.
struct PressingContact {
  Entity partner;
  double force;  // N
};

class ExactGroup {
 public:
  ExactGroup(ExactBodies& bodies, FlatContacts& flat, const CollapseDetector& collapses, PathLog& paths);

  LazyArray<std::vector<PressingContact>> pressing;  // by the lower body: what the last step found pressing on it
  LazyArray<std::vector<Entity>> partners;           // by body: what constrained motion keeps it in contact with
  LazyArray<std::vector<Vec3>> floors;  // by body: normals, to it, of the flat fixed things that it is kept on
  LazyArray<std::uint32_t> index;       // scratch of a step: a member's place in it, or ContactConstraint::fixed
  LazyArray<std::uint32_t> impacts;     // by member: impacts that ended in contact since the last step
  LazyArray<std::uint8_t> idle;         // by member: steps since something pressed on it
  LazyArray<double> margin;             // m, by member: the gap that time stepping leaves about it
  LazyArray<Instant> needed;            // by member: when it was last struck or pressed on, but by flat surfaces alone

  /// Body i is in an island from now on; if it sleeps, all that rest in contact with it wake too.
  void join(Entity i);
  /// Members a and b are in one island from now on, whose next step is due.
  void unite(Entity a, Entity b) { bodies_.islands.merge(a, b, bodies_.now); }
  /// The same if one of them has only just joined: a time step of the other one goes on.
  void unite_fresh(Entity a, Entity b) {
    if (bodies_.islands.of(a).fresh || bodies_.islands.of(b).fresh) unite(a, b);
  }
  /// A sleeping body, and all that rest in contact with it, are an island from now on.
  void wake(Entity i);
  /// At the start: a body that touches others, or a curved surface, without speed along the normal and is pressed on
  /// joins the group, and so does all that it touches.
  void join_initial(Entity first);
  /// Whether body i, a member or asleep, rests on something: counted in the tally.
  void set_carried(Entity i, bool carried);
  /// Member i has been struck at this speed (m/s): for a while bodies are kept apart by about as much as they could
  /// move at that speed until the next step.
  void widen_margin(Entity i, double approach);
  /// How much of an approach (m/s) along n is there already: in time stepping flights have been kicked by what forces
  /// do in the rest of the step. 0 where no more than rounding is.
  double approach_without_kick(double approach, const Vec3& n, Entity i, Entity e) const;
  /// Whether member i parts from what the last time step found pressing on it.
  bool opens(Entity i) const;
  /// Whether member i and e approach each other (m/s) for an impact of its own: one that bounces, or if they are
  /// `apart`. Contact must not take that speed. `greatest` is the greatest acceleration in the group (m/s^2).
  bool strikes(Entity i, Entity e, double approach, double greatest, bool apart = false) const;

  /// Body i, which leaves its island, may meet all that it was in contact with.
  void part(Entity i);
  /// Whether constrained motion keeps bodies i and e in contact, so that they cannot meet.
  bool are_partners(Entity i, Entity e) const;

  /// Whether body i cannot strike this fixed thing: it lies behind one that constrained motion has it on.
  bool hides(Entity i, Entity fixed) const;

  /// Appends the forces of sleeping bodies, and of members between steps of time stepping.
  void report(Entity i, std::vector<ContactForce>& forces) const;

 private:
  void join_at_rest(Entity i);

  ExactBodies& bodies_;
  FlatContacts& flat_;
  const CollapseDetector& collapses_;
  PathLog& paths_;
  LazyArray<std::uint8_t> carried_;  // by body: a member or asleep, and something presses on it
};

}  // namespace carom
