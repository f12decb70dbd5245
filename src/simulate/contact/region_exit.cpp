// A lower bound of the time at which a body leaves its region. A straight path has a closed form.
// Other paths are bounded by their greatest acceleration, again and again until that gains little. The result may be
// too early, but not too late.
#include "simulate/contact/region_exit.h"

#include "std.h"

namespace carom {

double region_exit(const ExactBodies& bodies, Entity i) {
  const Flights::Core& f = bodies.flights.cores()[i];
  const Vec3& a = bodies.flights.acceleration(i);
  const double fade = bodies.flights.fade(i);
  const PolynomialPath* const curve = bodies.flights.curve(i);
  const double since = bodies.now - f.start;
  const double room = bodies.neighbours.room(i);
  const Vec3 center = bodies.neighbours.center(i);

  // The time on a straight path from `off` (m, from the region's centre) at v (m/s) until the distance from there is
  // `radius` (m).
  const auto straight_exit = [](const Vec3& off, const Vec3& v, double radius) {
    const double speed2 = v.squaredNorm();
    const double outward = off.dot(v);
    const double left = radius * radius - off.squaredNorm();
    if (!(left > 0)) return 0.0;
    const double root = sqrt(outward * outward + speed2 * left);
    return outward > 0 ? left / (root + outward) : speed2 > 0 ? (root - outward) / speed2 : never;
  };

  // The position from the region's centre and the velocity, at t (s) of the flight.
  const auto start_of = [&](double t, Vec3& off, Vec3& v) {
    if (curve != nullptr) [[unlikely]] {
      v = f.v + curve->change_at(t);
      off = f.x + curve->displacement_at(t) - center;
      return;
    }

    if (fade != 0) [[unlikely]] {
      const FadingPath now = FadingPath{f.x - center, f.v, a, fade}.from(t);
      v = now.v;
      off = now.x;
      return;
    }

    v = f.v + t * a;
    off = f.x + t * (f.v + (0.5 * t) * a) - center;
  };

  Vec3 off;
  Vec3 v;
  start_of(since, off, v);
  double t = straight_exit(off, v, room);
  // Drag never increases an acceleration.
  if (const double size = curve == nullptr ? a.norm() : curve->greatest_acceleration(); size > 0) {
    // The greater of two bounds: a straight path within the room less the acceleration's share, and the greatest
    // possible speed. It continues from there as long as that gains time.
    const double end = bodies.body[i].event.time.hi - bodies.now.hi;
    const auto bound = [&](double straight) {
      const double narrowed = room - 0.5 * size * straight * straight;
      const double left = room - off.norm();
      if (!(left > 0)) return 0.0;
      const double surely = 2 * left / (v.norm() + sqrt(v.squaredNorm() + 2 * size * left));
      return narrowed > 0 ? max(surely, straight_exit(off, v, narrowed)) : surely;
    };

    const double straight = t;
    t = bound(straight);
    for (double step = t < 0.75 * straight ? t : 0; t < end && step > 0x1p-5 * t;) {
      start_of(since + t, off, v);
      step = bound(straight_exit(off, v, room));
      t += step;
    }
  }

  // The bound errs on the early side.
  return (bodies.now.hi + t) * (1 - 0x1p-52);
}

span<const Entity> renew_region(ExactBodies& bodies, Entity i, double until) {
  const Flight f = bodies.flights[i];
  const double since = bodies.now - f.start;

  // Half of the time to that instant, or to the one at which the acceleration has reversed the motion.
  double half = 0.5 * max(min(until, bodies.options.duration) - bodies.now.hi, 0.0);
  if (const double a2 = f.a.squaredNorm(); a2 > 0) {
    const Vec3 v = f.velocity(since);
    const double size = sqrt(a2);
    half = min(half, (v.norm() + sqrt(v.squaredNorm() + 2 * size * bodies.neighbours.room(i))) / size);
  }

  const Vec3 here = f.position(since);
  const Vec3 ahead =
      f.is_straight() ? Vec3(half * (f.velocity(since) + (0.5 * half) * f.a)) : Vec3(f.position(since + half) - here);
  bodies.hold_to_bounds(i, bodies.now.hi, here, f.velocity(since));
  return bodies.neighbours.renew(i, here, ahead);
}

}  // namespace carom
