#pragma once
// Begins flights, and books what forces did on those that end.
#include "simulate/curved_flights.h"
#include "simulate/exact_bodies.h"

namespace carom {

class FlatContacts;
class PathLog;

class FlightChanges {
 public:
  FlightChanges(ExactBodies& bodies, FlatContacts& flat, PathLog& paths)
      : bodies_(bodies),
        flat_(flat),
        paths_(paths),
        curved_(bodies),
        stepped_(bodies.body.size()),
        taking_(bodies.body.size()) {}

  /// Begins a new flight of body i, now, at x (m) with velocity v (m/s). A step of constrained motion ends with it.
  void begin(Entity i, const Vec3& x, const Vec3& v, const FlightOrigin& origin);
  /// The same within such a step.
  void go_on(Entity i, const Vec3& x, const Vec3& v, const FlightOrigin& origin);
  /// m: where body i is at an instant of its flight.
  Vec3 position_of_method(Entity i, const Instant& at) const;
  /// m/s: body i's at an instant of its flight, by the method that is asked for, without what forces do later.
  Vec3 velocity_of_method(Entity i, const Instant& at) const;
  /// An impact ends body i's step, now: a motion in closed form has its own place and velocity. Verlet's method changes
  /// the velocity where its step ends, at an impact or by itself.
  void end_step(Entity i) {
    if (curved_.follows_closed_form(i)) [[unlikely]]
      return end_closed(i);
    if (bodies_.options.integrator == Integrator::verlet) [[unlikely]]
      end_verlets(i);
  }
  /// Body i, free as far as its own step goes, has come to its end.
  void take_step(Entity i);
  /// Body i's flight, which has just begun, goes on as if it were free.
  void let_fall(Entity i);
  /// Member i falls from now on: nothing presses on it in the rest of its time step, which is no longer than a short
  /// one.
  void release(Entity i);
  /// Member i, which something presses on from now on, flies straight. What forces do in the rest of its time step is
  /// in its velocity.
  void hold(Entity i);
  /// m/s: what forces do to body i in so many seconds from now; drag is implicit.
  Vec3 by_forces(Entity i, double seconds) const;
  /// A force in the rest of the time step changes member i's velocity by dv (m/s), from now on.
  void push(Entity i, const Vec3& dv);
  /// Impacts within member i's time step take energy at this rate (W) from now on, as long as the step goes on.
  void take(Entity i, double power) {
    if (power != taking_[i]) taking_.write(i) = power;
  }
  /// Body i's flight goes on from now with velocity v (m/s), which it ought to have had. Its events stay.
  void correct(Entity i, const Vec3& v);
  /// Books what forces did to body i on the flight that ends at x (m) then: the World's, and contact forces against
  /// them.
  void book(Entity i, const Vec3& x, const Instant& end) {
    const World& world = bodies_.world;
    if (stepped_[i]) book_stepped(i, end);
    if (bodies_.in_steps && (bodies_.bent[i] || bodies_.flights.curve(i) != nullptr)) [[unlikely]]
      return book_varying(i, x, end);
    if (bodies_.flights.acceleration(i) != world.gravity || !world.forces.empty()) book_forces(i, x, end);
  }
  /// Books all flights up to `time` (s), the run's end; only once. Between collisions a speed is greatest at a flight's
  /// ends.
  void book_last(double time);
  /// Events with body i are stale from now on.
  void count(Entity i);

 private:
  void end_verlets(Entity i);
  void end_closed(Entity i);
  void change(Entity i, const Vec3& dv);
  void curve(Entity i, Flight from, bool free);
  void end_change(Entity i, const FlightOrigin& origin);
  void book_stepped(Entity i, const Instant& end);
  void book_taking(Entity i, const Instant& end);
  void book_work(Entity i, double time, const Vec3& displacement, double squared_speed);
  void book_forces(Entity i, const Vec3& x, const Instant& end);
  void book_varying(Entity i, const Vec3& x, const Instant& end);

  ExactBodies& bodies_;
  FlatContacts& flat_;
  PathLog& paths_;
  CurvedFlights curved_;
  LazyArray<std::uint8_t> stepped_;  // by body: this flight is one of time stepping
  LazyArray<double> taking_;         // W, by body: what impacts within its time step take
  bool ended_ = false;               // the last flights are booked
};

}  // namespace carom
