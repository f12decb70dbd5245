#pragma once
// The state of a crowd: an island with contacts that change too often to be followed one by one. It moves in
// synchronous leapfrog steps. From the step's start on, bodies drift at the velocity of the step's middle.

#include "geometry/contact_time.h"
#include "numerics/vec3.h"
#include "physics/coupled_forces.h"
#include "physics/world.h"
#include "simulate/crowd/crowd_rows.h"
#include "simulate/path/instant.h"
#include "std.h"

namespace carom {

/// How long a list of near pairs holds: until a body has gone `reach`. Outsiders keep to their paths.
struct CrowdReach {
  bool listed = false;
  double reach = 0;          // m
  double most = never;       // m, of the next list
  double gone = 0;           // m, so far
  double need = 0;           // m, what a body goes in a step, at least
  double room = 0;           // m, from its members, within which all bodies are their neighbours
  Instant sure;              // until then no other outsiders than those of `coming` come near
  vector<Entity> outsiders;  // neighbours of other kinds, or of other crowds
  vector<Entity> coming;     // those that may come near until `sure`

  void keep(auto& archive) { archive(listed, reach, most, gone, need, room, sure, outsiders, coming); }
};

/// The present step.
struct CrowdStep {
  Instant start;
  Instant end;
  double length = 0;           // s
  double last_length = never;  // s, of the step before
  bool open = false;           // it has begun, and is not booked
  bool valid = true;           // places and drifts are those of the bodies
  bool solved = true;          // its forces are as accurate as they should be
  double kinetic = 0;          // J, at its start
  Instant next_switch;         // of forces on members, and of things that move
  double speed = 0;            // m/s, of pairs that press on each other
  double shell = 0;            // m, that contacts keep
  int waits = 0;               // steps to come in which missing gaps do not return
  int waited = 0;              // the last number of these
  CoupledForces coupled;       // forces between members, which have the numbers of Crowd::by_name
  double coupling_rate = 0;    // 1/s, at which they change

  void keep(auto& archive) {
    archive(start, end, length, last_length, open, valid, solved, kinetic, next_switch, speed, shell, waits, waited);
    archive(coupled, coupling_rate);
  }
};

/// What precedes rest, or constrained motion.
struct CrowdRest {
  bool closing = false;          // shells shrink, because the crowd is calm
  Instant slow_since{never, 0};  // the crowd as a whole has been slow since then
  uint32_t steps = 0;            // in which not all were slow
  double next_try = 0;           // s: forces are not tried for balance before
  double try_after = 0;          // s, between two tries

  void keep(auto& archive) { archive(closing, slow_since, steps, next_try, try_after); }
};

/// Energy so far.
struct CrowdBalance {
  double taken = 0;  // J, by contacts
  double made = 0;   // J, by errors
  double lost = 0;   // J, in impacts
};

struct Crowd {
  // By number: members, then things that forces do not move in a step, then one for lanes without a row of each part.
  vector<Entity> members;  // by slab (crowd_slabs.h): ascending in each, and on the cut behind it
  vector<Entity> things;   // fixed or asleep: those of each part of the rows
  vector<Four> x;          // m, and radii
  vector<Four> v;          // m/s, of the drift, and inverse masses (1/kg)

  vector<uint32_t> by_name;  // numbers of members, in ascending order of these

  // By member.
  vector<Vec3> a;        // m/s^2: the last step's change of velocity by its time, contact included
  vector<double> lag;    // s: how much older v is than the step's start
  vector<double> lent;   // J: what contact gives back as its force falls (CrowdSteps::lent)
  vector<uint8_t> idle;  // steps since a thing last pressed on it
  vector<uint8_t> pressed;
  vector<uint8_t> still;  // looks at hardly any speed, with all that press on one another with it

  CrowdRows rows;
  // Crowds with forces and shells for the next list: those of which this one is made.
  vector<shared_ptr<Crowd>> earlier;
  CrowdReach list;
  CrowdStep step;
  CrowdRest rest;

  vector<RowName> struck;   // rows of sleeping bodies with an impact: they are to wake
  double smallest = never;  // m, the least radius
  double load = 0;          // m/s^2, the greatest acceleration by forces
  CrowdBalance balance;

  uint32_t movable() const { return uint32_t(members.size()); }
  /// Whether these are its members. They must be ascending.
  bool is_of(span<const Entity> entities) const {
    return ranges::equal(entities, by_name, {}, {}, [&](uint32_t k) { return members[k]; });
  }
  Vec3 position(size_t k) const { return {x[k].at[0], x[k].at[1], x[k].at[2]}; }
  Vec3 drift(size_t k) const { return {v[k].at[0], v[k].at[1], v[k].at[2]}; }
  /// Whether a row presses on a sleeping body, as it did in the last step. A slow touch does not wake it.
  bool presses_on_sleeper(size_t group, size_t lane, const World& world) const {
    const RowGroup& row = rows.hot[group];
    return row.impulse[lane] > 0 && rows.state[group].force[lane] > 0 && row.b[lane] >= movable() &&
           world.is_body(rows.names[group][lane].e);
  }
  /// The sum of of(k) over members, the same for mirror images of a crowd: those on the cuts are by themselves.
  template <typename Of>
  double sum(const Of& of) const {
    const auto of_slab = [&](size_t slab, uint32_t on_cut) {
      double sum = 0;
      for (size_t k = rows.first[slab]; k < rows.first[slab + 1]; ++k)
        if ((rows.place[k] & 1) == on_cut) sum += of(k);
      return sum;
    };
    const double inside = sum_in_pairs(0, rows.slabs(), [&](size_t slab) { return of_slab(slab, 0); });
    return inside + sum_in_pairs(0, rows.slabs() - 1, [&](size_t slab) { return of_slab(slab, 1); });
  }
  void keep(auto& archive) {
    archive(members, things, x, v, by_name, a, lag, lent, idle, pressed, still, rows, earlier);
    archive(list, step, rest, struck, smallest, load, balance);
  }

  /// The velocity of member k (m/s) when its drift is so old (s).
  Vec3 velocity(size_t k, double age) const { return drift(k) + age * a[k]; }
};

}  // namespace carom
