#pragma once
// Begins flights, and books the effect of forces on those that end.

#include "simulate/contact/exact_bodies.h"
#include "simulate/path/curved_flights.h"
#include "std.h"

namespace carom {

class FlatContacts;
class PathLog;

class FlightChanges {
 public:
  FlightChanges(ExactBodies& bodies, FlatContacts& flat, PathLog& paths);

  /// Begins a new flight of body i at the present instant, at x (m) with velocity v (m/s). A step of constrained motion
  /// ends with it.
  void begin(Entity i, const Vec3& x, const Vec3& v, const FlightOrigin& origin);
  /// The same within such a step.
  void go_on(Entity i, const Vec3& x, const Vec3& v, const FlightOrigin& origin);
  /// The position of body i at an instant of its flight (m).
  Vec3 position_of_method(Entity i, const Instant& at) const;
  /// The velocity of body i at an instant of its flight (m/s), by the scene's method, without the effect of later
  /// forces.
  Vec3 velocity_of_method(Entity i, const Instant& at) const;
  /// Ends body i's step at an impact. A motion in closed form has its own position and velocity.
  /// Verlet's method changes the velocity where its step ends, at an impact or not.
  [[gnu::always_inline]] void end_step(Entity i) {
    const bool verlet = bodies_.options.integrator == Integrator::verlet;
    if (curved_.follows_closed_form(i) || (verlet && bends_freely(i))) [[unlikely]]
      end_by_method(i);
  }
  /// Ends a step of body i's own flight, and begins the next.
  void take_step(Entity i);
  /// Lets body i's flight, which has just begun, continue as if it were free.
  void let_fall(Entity i);
  /// Lets the flight of member i, which has just begun, follow this path of constrained motion.
  void follow(Entity i, const PolynomialPath& path);
  /// Books the effect of forces on body i for the flight that ends at x (m) and `end`.
  /// These are the World's forces, and contact forces against them.
  [[gnu::always_inline]] void book(Entity i, const Vec3& x, const Instant& end) {
    const World& world = bodies_.world;
    if (in_contact_[i] != Contact::none) [[unlikely]]
      return book_contact(i, x, end);
    if (bodies_.in_steps && (bodies_.bent[i] || bodies_.flights.curve(i) != nullptr)) [[unlikely]]
      return book_varying(i, x, end);
    if (bodies_.flights.acceleration(i) != world.gravity || !world.forces.empty()) book_forces(i, x, end);
  }
  /// Books the work of forces on body i in `length` (s) of a drift, and returns it (J).
  double book_drift(Entity i, const Flight& drift, double length);
  /// Leaves body i at x (m) with velocity v (m/s), out of all contact. What has ended is booked already.
  void take_out(Entity i, const Vec3& x, const Vec3& v);
  /// Books body i's flight up to an instant. Returns its velocity there (m/s).
  Vec3 book_until(Entity i, const Instant& at);
  /// Books all flights up to `time` (s), the run's end. Only the first call has an effect.
  /// Between collisions a speed is greatest at an end of a flight.
  void book_last(double time);
  bool has_ended() const { return ended_; }
  /// Makes all events with body i stale.
  void count(Entity i);
  /// Notes that body i's next event is to be predicted. The event loop does so at the end of the present event. Bodies
  /// that begin a flight are noted.
  [[gnu::always_inline]] void note_changed(Entity i) {
    if (changed_count_ > 0 && changed_[changed_count_ - 1] == i) return;
    if (changed_count_ == changed_.size()) [[unlikely]]
      changed_.resize(2 * changed_count_ + 2);
    changed_[changed_count_++] = i;
  }
  /// The bodies noted since the last call, in no order, some of them more than once. Valid until the next note.
  span<Entity> take_changed() { return {changed_.data(), exchange(changed_count_, 0)}; }

  void keep(auto& archive) { archive(curved_, in_contact_, ended_); }

 private:
  /// Whether a free flight of body i follows a curve.
  bool bends_freely(Entity i) const {
    return bodies_.flights.curve(i) != nullptr && !in_lasting_contact(bodies_.mode(i));
  }
  [[gnu::noinline]] void count_anew(Entity i);
  void end_by_method(Entity i);
  void curve(Entity i, Flight from, bool free);
  [[gnu::always_inline]] void end_change(Entity i, const FlightOrigin& origin);
  [[gnu::noinline]] void note_forces(Entity i);

  void book_contact(Entity i, const Vec3& x, const Instant& end);
  void book_followed(Entity i, const Vec3& x, const Instant& end);
  double book_work(Entity i, double time, const Vec3& displacement, double squared_speed);
  void book_forces(Entity i, const Vec3& x, const Instant& end);
  void book_varying(Entity i, const Vec3& x, const Instant& end);
  double greatest_speed(Entity i, const Flight& f, double length) const;
  double kinetic_loss(Entity i, const Flight& f, double length) const;

  ExactBodies& bodies_;
  FlatContacts& flat_;
  PathLog& paths_;
  CurvedFlights curved_;
  // What moves a body in its flight: parabolas or free motion, a crowd, or a path of constrained motion.
  enum class Contact : uint8_t { none, crowd, followed };
  LazyArray<Contact> in_contact_;  // by body, of its present flight
  vector<Entity> changed_;         // longer than the list of noted bodies
  size_t changed_count_ = 0;       // in that list
  bool ended_ = false;             // the last flights are booked
};

}  // namespace carom
