#pragma once
// Bodies that come into the world after the start: each when it is due and there is room for it. A place is free where
// nothing overlaps the body there by more than what counts as touching. A body with a place of its own waits until that
// place is free: until the last thing in it has left. A ball of a Pour tries places at random at each of the pour's
// ticks, one ball after the other.
//
// What is in the way leaves at a root of its path, which is found anew when the path has changed.

#include "physics/state.h"
#include "physics/world.h"
#include "simulate/contact/exact_bodies.h"
#include "std.h"

namespace carom {

class Appearances {
 public:
  Appearances(ExactBodies& bodies, const State& initial);

  /// Whether bodies have yet to come.
  bool any() const;
  /// The next instant, at present or later, at which one may have room. Infinite: none, unless paths change.
  Instant next();

  struct Admitted {
    Entity body;
    Vec3 x, v;  // m, m/s
  };
  /// Lets those that wait try again at once: things move in another way than when they last did.
  void try_again() {
    for (Blocked& one : blocked_) one.due = bodies_.now;
  }

  /// Finds the bodies that are due at the present instant and have room, which are then among the neighbours. Each call
  /// returns one of them; none: there is no other.
  optional<Admitted> take();

  void keep(auto& archive) { archive(coming_, blocked_, lines_); }

 private:
  /// A body in whose place there is something.
  struct Blocked {
    Entity body = no_entity;
    Instant due;                // for the next try
    Entity last = no_entity;    // the thing that leaves last, if its path stays
    uint16_t last_version = 0;  // of a body's path

    void keep(auto& archive) { archive(body, due, last, last_version); }
  };
  /// The balls of a pour that have yet to come.
  struct Line {
    Entity next = 0;  // the number in the pour of the first of them
    double due = 0;   // s, for its next try

    void keep(auto& archive) { archive(next, due); }
  };

  Instant due_of(const Blocked& one) const;
  double overlap(Entity i, const Vec3& x, Entity e, const Instant& at) const;
  bool blocks(Entity e, Entity i, const Vec3& x) const;
  bool has_room(Entity i, const Vec3& x);
  Instant exit_of(Entity e, Entity i, const Vec3& x) const;
  Blocked blocked(Entity i, const Vec3& x);
  optional<Admitted> take_of_line(size_t k);

  ExactBodies& bodies_;
  vector<Vec3> x_, v_;       // m and m/s, by body, as it appears; empty: none does
  vector<Entity> coming_;    // with a place of their own, not due yet: the next ones last
  vector<Blocked> blocked_;  // in the order in which they were due
  vector<Line> lines_;       // by pour
};

}  // namespace carom
