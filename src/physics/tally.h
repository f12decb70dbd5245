#pragma once
// Running sums of a run: what summary.csv needs without a table of collisions.

#include "numerics/vec3.h"
#include "physics/collision.h"
#include "physics/entity.h"
#include "std.h"

namespace carom {

/// Impacts that lasting contact absorbed. They leave no approach and are not recorded.
struct TakenUp {
  uint64_t impacts = 0;
  double fastest = 0;  // m/s, of approach
  double energy = 0;   // J, a part of the energy lost
};

/// Several impacts on a body at one instant, not all with e = 0. Rigid bodies leave their outcome open.
struct SharedImpacts {
  uint64_t instants = 0;
  uint64_t ties = 0;          // of these: with opposed impacts of equal speed, where a slight difference decides
  uint64_t without_room = 0;  // instants with bodies that had no room to rebound
  double absorbed = 0;        // J, by these; a part of the energy lost
  // When (s) it was so first, for which body, and the two things that it met. NaN: never.
  double first = numeric_limits<double>::quiet_NaN();
  Entity body = no_entity;
  Entity one = no_entity;
  Entity other = no_entity;

  void keep(auto& archive) { archive(instants, ties, without_room, absorbed, first, body, one, other); }
};

/// Bodies that have left the world, or that have come into it.
struct Passage {
  uint64_t bodies = 0;
  double energy = 0;             // J, kinetic and potential, each body's at its passage
  Vec3 momentum = Vec3::Zero();  // kg m/s

  void keep(auto& archive) { archive(bodies, energy, momentum); }
};

/// What has changed the World: bodies that pass both ways, and events.
struct WorldChanges {
  Passage removed;   // by regions
  Passage appeared;  // after the start
  // s, by trigger of the World: the first double after its event; not_yet: it has not happened.
  vector<double> fired;

  void keep(auto& archive) { archive(removed, appeared, fired); }
};

/// Why a run has ended before its duration.
enum class EndReason : uint8_t {
  rest,        // all bodies were at rest
  collisions,  // there were as many as simulate.stop allows
  region       // a body entered it
};

struct RunEnd {
  double time = 0;  // s
  EndReason reason = EndReason::rest;
  uint32_t region = 0;  // of that reason

  void keep(auto& archive) { archive(time, reason, region); }
};

/// The greatest speed of a body.
struct Fastest {
  double speed = 0;         // m/s
  Entity body = no_entity;  // no_entity: none has moved, or it was not recorded

  void keep(auto& archive) { archive(speed, body); }
};

/// A step of one length for all, in which forces on a body turn.
struct StiffStep {
  double phase = 0;                         // rad, the angle
  double length = 0;                        // s
  double time = 0;                          // s, of its start
  Entity body = no_entity;                  // no_entity: there was no such step
  Vec3 x = Vec3::Zero(), v = Vec3::Zero();  // m, m/s

  void keep(auto& archive) { archive(phase, length, time, body, x, v); }
};

/// An acceleration that forces left to a body at rest. It counts as balance, and is more than their rounding.
struct Unbalanced {
  double acceleration = 0;  // m/s^2
  double way = 0;           // m, how far it would have moved the body by the run's end
  Entity body = no_entity;  // no_entity: there was none

  void keep(auto& archive) { archive(acceleration, way, body); }
};

/// What may make a run doubtful (run/warnings.h).
struct Doubts {
  // Contact problems with a solution that may be off by more than rounding.
  uint64_t contacts = 0;
  double contact_made = 0;  // J, by errors of the steps of crowds; a part of the method's error
  uint64_t crowd_steps = 0;
  uint64_t unsolved_steps = 0;  // of crowds: forces were less accurate than they should be
  StiffStep stiffest;           // the step with the greatest angle, for a method with steps of one length
  Unbalanced unbalanced;        // that with the longest way

  void keep(auto& archive) { archive(contacts, contact_made, crowd_steps, unsolved_steps, stiffest, unbalanced); }
};

struct Tally {
  uint64_t body_body = 0;   // collisions
  uint64_t body_fixed = 0;  // collisions
  uint64_t merges = 0;
  uint64_t tautened = 0;  // strings that went taut
  // Inelastic collapses: clusters of bodies with ever more frequent impacts, taken into lasting contact.
  uint64_t collapses = 0;
  double first_collision = numeric_limits<double>::quiet_NaN();  // s, NaN: none
  double last_collision = numeric_limits<double>::quiet_NaN();   // s, NaN: none
  // J, by impacts: those recorded, and those that contact absorbed.
  double energy_lost = 0;
  // J, lost in lasting contact beside impacts (below 0: made). This is the method's own error.
  double method_error = 0;
  double work = 0;  // J, by the World's forces (gravity apart)
  // J, the part of each force in the work; empty: there are no forces, or it was not recorded. Where there are forces
  // between bodies, those of springs and of gravitation are the last two.
  vector<double> force_work;
  Doubts doubts;
  double max_overlap = 0;  // m, deepest seen
  Fastest fastest;         // seen
  uint64_t resting = 0;    // bodies in lasting contact
  // s, summed over bodies: lasting contact in crowds.
  double stepped_contact = 0;
  TakenUp taken_up;
  SharedImpacts shared;
  WorldChanges changes;
  optional<RunEnd> end;  // none: the run goes on until its duration

  /// Counts a record. The end of bounces is not a collision.
  void count(CollisionKind kind) {
    if (kind == CollisionKind::rest) return;
    ++(kind == CollisionKind::body_body    ? body_body
       : kind == CollisionKind::body_fixed ? body_fixed
       : kind == CollisionKind::taut       ? tautened
                                           : merges);
  }
  /// The same, with its time (s).
  void count(CollisionKind kind, double time) {
    if (kind == CollisionKind::rest) return;
    count(kind);
    if (std::isnan(first_collision)) first_collision = time;
    last_collision = time;
  }
  uint64_t collisions() const { return body_body + body_fixed + merges + tautened; }

  void keep(auto& archive) {
    archive(body_body, body_fixed, merges, tautened, collapses, first_collision, last_collision, energy_lost);
    archive(method_error, work, force_work, doubts, max_overlap, fastest, resting, stepped_contact);
    archive(taken_up, shared, changes, end);
  }
};

}  // namespace carom
