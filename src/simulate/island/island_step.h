#pragma once
// A step of an island by constrained motion, as a value: what is found for it, and what its end will change.

#include "numerics/dormand_prince.h"
#include "numerics/radau_collocation.h"
#include "physics/collision.h"
#include "physics/tally.h"
#include "simulate/contact/contact_list.h"
#include "simulate/contact/contact_work.h"
#include "simulate/contact/flat_contacts.h"
#include "simulate/contact/numbering.h"
#include "simulate/event_log.h"
#include "simulate/island/constrained_system.h"
#include "simulate/path/instant.h"
#include "std.h"

namespace carom {

/// The path of an island's bodies in a step.
struct IslandPath {
  Instant start;
  unique_ptr<DenseMotion> motion;

  void keep(auto& archive) {
    bool stiff = dynamic_cast<const RadauCollocation*>(motion.get()) != nullptr;
    archive(start, stiff);
    stiff ? keep_by<RadauCollocation>(archive) : keep_by<DormandPrince>(archive);
  }

 private:
  template <typename Method>
  void keep_by(auto& archive) {
    if (!motion) motion = make_unique<Method>();
    archive(static_cast<Method&>(*motion));
  }
};

/// The work of moving things and of forces between members, and the impulses of contacts, along such a path.
class IslandWork final : public WorkingPath {
 public:
  IslandWork() = default;  // to be restored
  IslandWork(shared_ptr<const IslandPath> path, shared_ptr<const ConstrainedSystem> forces)
      : path_(std::move(path)), forces_(std::move(forces)) {}

  void book(double seconds, EventLog& log) const override {
    const double length = min(seconds, path_->motion->length());
    if (forces_->has_carriers()) log.add_carried_work(forces_->work(*path_->motion, length));
    if (!forces_->is_coupled()) return;

    // The energy of contact changes by what these forces do besides.
    const auto [work, released] = forces_->exchanged(*path_->motion, length);
    log.add_work(work);
    log.deviate(released + work.sum());
  }
  void impulses(double from, double to, const Take& take) const override {
    const double length = path_->motion->length();
    if (from < length) forces_->add_impulses(*path_->motion, from, min(to, length), take);
  }

  void keep(auto& archive) { archive(path_, forces_); }

 private:
  shared_ptr<const IslandPath> path_;
  shared_ptr<const ConstrainedSystem> forces_;
};

/// What becomes of a member.
struct MemberFate {
  bool rests = false;        // neither it nor its island moves or accelerates
  bool pressed = false;      // a thing presses on it
  bool bound = false;        // a thing that is not flat does
  FlatContactList flats;     // the surfaces on which it lies if it leaves the island
  Vec3 down = Vec3::Zero();  // m, closes the remaining gaps to these

  /// Whether it leaves the island after it has had time to fall back: nothing presses on it, or only flat surfaces do.
  bool leaves() const { return !bound && !(pressed && rests); }
};

/// Approaches that contact has taken away at once.
struct AbsorbedApproaches {
  vector<Vec3> before;              // m/s, by member
  vector<Vec3> after;               // m/s
  vector<ContactConstraint> pairs;  // with the impulses (N s)
  vector<AbsorbedImpact> impacts;   // by pair
  vector<Contact> names;            // of the pairs, where their impulses are summed
};

struct IslandStep {
  explicit IslandStep(Numbering of_members) : members(std::move(of_members)) {}

  Numbering members;         // ascending
  Instant at;                // its start
  bool undisturbed = false;  // the step before has reached its end

  // By member, at the step's start: m, m/s, m/s^2, 1/kg.
  vector<Vec3> x;
  vector<Vec3> v;
  vector<Vec3> a;
  vector<double> inverse_mass;
  vector<Vec3> applied;     // m/s^2, by forces without contact
  CoupledForces couplings;  // forces between members
  double load = 0;          // m/s^2, the greatest acceleration with which members may press on anything
  double smallest = never;  // m, the least radius
  double fastest = 0;       // m/s
  ContactList contacts;     // force: N, at the step's start
  vector<MemberFate> fates;

  // s. A body that nothing binds stays for the time `grace`, to fall back.
  double length = 0;
  double grace = 0;
  double fade = 0;                    // 1/s, of all members' accelerations
  shared_ptr<const IslandPath> path;  // none: parabolas

  /// What is known besides when the motion has been chosen.
  struct Motion {
    // Of the path, where things that move take part, or impulses are summed: to integrate these. none: they do not.
    shared_ptr<ConstrainedSystem> forces;
    double next_length = 0;  // s, a good length for the next step
    bool inexact = false;    // the paths have an error beyond rounding
    bool changes = false;    // a contact changes at the path's end
  } motion;

  /// What is to be booked.
  struct Bookings {
    vector<Certificate> solutions;
    AbsorbedApproaches absorbed;
    vector<Collision> collisions;
    vector<Entity> struck;  // bodies with an impact in turn with a strike
    double work = 0;        // J, of moving things when separations end
    // The impulses that end separations, where impulses are summed: N s in place of N, below 0 where they pull.
    vector<ContactForce> stopped;
    vector<Unbalanced> unbalanced;
  } bookings;

  /// The accelerations of the members (m/s^2) by forces, without contact, at these velocities (m/s).
  vector<Vec3> applied_at(const ExactBodies& bodies, const vector<Vec3>& velocities) const {
    vector<Vec3> all;
    for (size_t k = 0; k < x.size(); ++k) all.push_back(bodies.force_at(members[k], x[k], velocities[k]));
    if (couplings.any()) couplings.accelerate(inverse_mass, x, velocities, all);
    return all;
  }
  /// By member: the first of those that contacts and forces connect with it.
  vector<uint32_t> parts() const {
    DisjointSets sets(x.size());
    for (const ContactConstraint& pair : contacts.pairs)
      if (pair.b != ContactConstraint::fixed) sets.join(pair.a, pair.b);
    couplings.for_each_link([&](uint32_t a, uint32_t b) { sets.join(a, b); });
    return first_of_each(sets, x.size());
  }

  /// The position (m), velocity (m/s) and acceleration (m/s^2) of a thing: a member, a string to a member or to its
  /// anchor, or a fixed thing.
  Vec3 position_of(const ExactBodies& bodies, Entity thing) const {
    const Entity body = bodies.world.second_body(thing);
    return body != no_entity ? x[members.number(body)] : bodies.fixed_position(thing, at);
  }
  Vec3 velocity_of(const ExactBodies& bodies, Entity thing) const {
    const Entity body = bodies.world.second_body(thing);
    return body != no_entity ? v[members.number(body)] : bodies.fixed_velocity(thing, at);
  }
  Vec3 pull_of(const ExactBodies& bodies, Entity thing) const {
    const Entity body = bodies.world.second_body(thing);
    return body != no_entity ? a[members.number(body)] : bodies.fixed_acceleration(thing, at);
  }
  /// The speed at which pair c separates (m/s).
  double parting_speed(const ExactBodies& bodies, size_t c) const {
    const ContactConstraint& p = contacts.pairs[c];
    return p.normal.dot(velocity_of(bodies, contacts.names[c].e) - v[p.a]);
  }
};

}  // namespace carom
