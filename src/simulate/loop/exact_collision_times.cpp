// Times of collision of bodies on their flights, from the later of the two flights' starts and with the lower number
// first. Every prediction of a pair therefore has the same bits. Parabolas take the closed forms of geometry/, paths
// under drag and polynomials the search by separating planes.
#include "simulate/loop/exact_collision_times.h"

#include "geometry/contact_time.h"
#include "geometry/path_time_of_impact.h"
#include "physics/world.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

namespace {

/// An upper bound of |v|.
double sum_of_speeds(const Vec3& v) {
  return v.cwiseAbs().sum();
}

/// Whether two bodies certainly stay farther apart than `sizes` (m) for a time (s), with a relative acceleration of at
/// most `bending` (m/s^2). It takes nothing nearer than it bends the straight path from the relative velocity.
bool stay_apart(const RelativeMotion& m, double sizes, double bending, double time) {
  const double speed2 = m.w.squaredNorm();
  const double nearest = speed2 > 0 ? clamp(-m.d.dot(m.w) / speed2, 0.0, time) : 0;
  const double bend = 0.5 * time * time * bending;
  return (m.d + nearest * m.w).norm() > (1 + exact_tolerance::near_miss) * (sizes + bend);
}

}  // namespace

Instant ExactCollisionTimes::of_pair(Entity i, Entity j, uint8_t& feature, double until) const {
  const World& world = bodies_.world;
  const Entity a = min(i, j);
  const Entity b = max(i, j);
  const Flight& p = bodies_.flights[a];
  const Flight& q = bodies_.flights[b];
  const bool p_earlier = p.start < q.start;
  const Instant base = p_earlier ? q.start : p.start;
  // One of the two is zero.
  const double tp = base - p.start;
  const double tq = base - q.start;

  // The motion of b relative to a, at the later start.
  RelativeMotion m;
  m.w = q.velocity(tq) - p.velocity(tp);
  m.d = q.position(tq) - p.position(tp);
  m.a = q.acceleration(tq) - p.acceleration(tp);
  const bool balls = world.volume.empty();
  if (balls && m.a.isZero(0) && p.fade == q.fade && m.d.dot(m.w) >= 0) return {never, 0};

  // The horizon is the end of a step, or of the run.
  const double s = world.radius[a] + world.radius[b];
  const bool curved = p.curve != nullptr || q.curve != nullptr;
  const bool parabolas = p.is_parabola() && q.is_parabola();
  const bool step = is_member(bodies_.mode(a)) || is_member(bodies_.mode(b));
  const double horizon = (step || curved ? min(end_of(a), end_of(b)) : Instant{bodies_.options.duration, 0}) - base;

  // Most pairs end here: they are too far apart for the rest of the step, or until the time that matters.
  if (curved && !(horizon > 0)) return {never, 0};
  if (parabolas || !curved) {
    const double time = min(horizon, until - base.hi);
    // Accelerations fade with drag, each in its own time.
    const bool alike = parabolas || p.fade == q.fade;
    const double bending = alike ? m.a.norm() : p.acceleration(tp).norm() + q.acceleration(tq).norm();
    if (time >= 0 && stay_apart(m, s, bending, time)) return {never, 0};
  }

  m.speeds = sum_of_speeds(p.v) + sum_of_speeds(q.v) + sum_of_speeds(tp * p.a) + sum_of_speeds(tq * q.a);
  m.just_separated = p.start == q.start && bodies_.body[a].origin_partner == b && bodies_.body[b].origin_partner == a;
  if (curved && !parabolas) [[unlikely]]
    return of_curves(a, p, b, q, m, feature);
  if (step) {
    const double greatest = max(bodies_.applied[a].norm(), bodies_.applied[b].norm());
    m.speeds += exact_tolerance::step_rounding * sqrt(greatest * s);
  }

  // The time by the kind of paths and volumes.
  double t;
  if (!parabolas) {
    const FeatureTime first = time_of_impact(world, a, p.path().from(tp), b, q.path().from(tq), m.speeds,
                                             m.just_separated ? bodies_.body[a].origin_feature : no_feature, horizon);
    t = first.time;
    feature = first.feature;
  } else if (balls) {
    t = sphere_contact_time(m, s, horizon);
  } else {
    const FeatureTime first =
        time_of_impact(world, a, b, m, m.just_separated ? bodies_.body[a].origin_feature : no_feature, horizon);
    t = first.time;
    feature = first.feature;
  }

  return t == never ? Instant{never, 0} : base + t;
}

/// Collision of two bodies of which at least one is on a curve.
Instant ExactCollisionTimes::of_curves(Entity a, const Flight& p, Entity b, const Flight& q, const RelativeMotion& m,
                                       uint8_t& feature) const {
  const Instant base = max(p.start, q.start);
  const double horizon = min(end_of(a), end_of(b)) - base;
  const double tp = base - p.start;
  const double tq = base - q.start;

  const double speeds = m.speeds + noise_in_contact(a) + noise_in_contact(b);
  uint8_t left = m.just_separated ? bodies_.body[a].origin_feature : no_feature;

  // Searches piece by piece. One polynomial is accurate in each.
  for (double t = 0; t < horizon;) {
    const double length = min({horizon - t, p.span_of_fade(tp + t), q.span_of_fade(tq + t)});
    const FeatureTime first = of_piece(a, p, tp + t, b, q, tq + t, length, speeds, left);
    if (first.time < never) {
      feature = first.feature;
      return base + (t + first.time);
    }

    if (!(t + length > t)) break;
    t += length;
    left = no_feature;
  }
  return {never, 0};
}

/// Collision in a piece of `length` (s), tp and tq (s) after the starts of the two flights. Polynomials give the paths
/// in it (time in s from its start).
FeatureTime ExactCollisionTimes::of_piece(Entity a, const Flight& p, double tp, Entity b, const Flight& q, double tq,
                                          double length, double speeds, uint8_t left) const {
  const PolynomialPath::Terms displacement = relative_displacement(p, tp, q, tq, length);
  double reach = bodies_.world.radius[a] + bodies_.world.radius[b];  // m
  for (const Vec3& term : displacement) reach += term.norm();
  const Vec3 xa = p.position(tp), xb = q.position(tq);
  if ((xb - xa).squaredNorm() > reach * reach) return {never, no_feature};
  return time_of_impact(bodies_.world, a, xa, b, xb, displacement, length, speeds, left, length);
}

/// The displacement of flight q less that of p (m), tp and tq (s) after their starts, by t / length (s).
PolynomialPath::Terms ExactCollisionTimes::relative_displacement(const Flight& p, double tp, const Flight& q, double tq,
                                                                 double length) {
  PolynomialPath::Terms displacement = q.displacement_from(tq, length);
  const PolynomialPath::Terms of_p = p.displacement_from(tp, length);
  // The remainder of an acceleration that both have in common is rounding, and counts as zero.
  const double noise =
      exact_tolerance::curve_rounding * length * length * (p.greatest_acceleration() + q.greatest_acceleration());  // m
  for (size_t k = 0; k < displacement.size(); ++k) {
    displacement[k] -= of_p[k];
    if (k > 0 && displacement[k].norm() <= noise) displacement[k].setZero();
  }
  return displacement;
}

Instant ExactCollisionTimes::of_string(Entity string) const {
  const String& s = bodies_.world.string(string);
  const bool anchored = s.other == no_entity;
  const Flight p = bodies_.flights[s.body];
  const Flight q = anchored ? Flight{p.start, s.anchor, Vec3::Zero(), Vec3::Zero()} : bodies_.flights[s.other];

  const Instant base = max(p.start, q.start);
  const double tp = base - p.start;
  const double tq = base - q.start;
  const double horizon = min(end_of(s.body), anchored ? Instant{never, 0} : end_of(s.other)) - base;
  if (!(horizon > 0)) return {never, 0};

  // The motion of the second end relative to the first, at the later start.
  RelativeMotion m{q.position(tq) - p.position(tp), q.velocity(tq) - p.velocity(tp),
                   q.acceleration(tq) - p.acceleration(tp),
                   sum_of_speeds(p.v) + sum_of_speeds(q.v) + sum_of_speeds(tp * p.a) + sum_of_speeds(tq * q.a),
                   p.start == q.start && bodies_.body[s.body].origin_partner == string &&
                       (anchored || bodies_.body[s.other].origin_partner == string)};
  m.speeds += noise_in_contact(s.body) + (anchored ? 0 : noise_in_contact(s.other));

  if (p.is_parabola() && q.is_parabola()) {
    const double t = taut_time(m, s.length, horizon);
    return t == never ? Instant{never, 0} : base + t;
  }

  // Other paths are searched piece by piece.
  for (double t = 0; t < horizon;) {
    const double length = min({horizon - t, p.span_of_fade(tp + t), q.span_of_fade(tq + t)});
    const double first =
        taut_time(q.position(tq + t) - p.position(tp + t), relative_displacement(p, tp + t, q, tq + t, length), length,
                  s.length, m.speeds, m.just_separated && t == 0, length);
    if (first < never) return base + (t + first);
    if (!(t + length > t)) break;
    t += length;
  }
  return {never, 0};
}

/// The rounding of body i's speed by steps in contact (m/s).
double ExactCollisionTimes::noise_in_contact(Entity i) const {
  return in_lasting_contact(bodies_.mode(i))
             ? exact_tolerance::step_rounding * sqrt(bodies_.applied[i].norm() * bodies_.world.radius[i])
             : 0;
}

/// How long body i, at t (s) of its flight, surely stays clear of a thing that swings (s). A plane through the points
/// at which it is the closest to the thing's middle parts the two until it has come as near as the thing ever goes. No
/// plane parts a body from a shell around it: there the distance decides, whatever its direction.
double ExactCollisionTimes::clear_time(Entity i, const Flight& f, double t, Entity surface) const {
  const World& world = bodies_.world;
  const Swing& swing = *world.swing(surface);
  const Vec3 x = f.position(t);
  const Vec3 middle = world.fixed_position(surface) + swing.middle;
  const Touch there = touch(world, i, x, surface, middle);
  const Vec3& n = there.normal;
  const double rounding = 0x1p-48 * (x.cwiseAbs().sum() + middle.cwiseAbs().sum());

  const bool shell = world.is_obstacle(surface) && world.obstacle(surface).hollow != Hollow::none;
  const double width = shell ? sqrt(swing.sine.squaredNorm() + swing.cosine.squaredNorm()) : width_along(swing, n);
  const double room = there.gap - width - rounding;
  if (!(room > 0)) return 0;
  if (shell) {
    const double speed = f.velocity(t).norm();
    return 2 * room / (speed + sqrt(speed * speed + 2 * room * f.greatest_acceleration()));
  }

  const double approach = n.dot(f.velocity(t));
  if (f.is_parabola()) return plane_contact_time(room, -approach, -n.dot(f.acceleration(t)), 0, false, never);
  const double towards = max(approach, 0.0);
  return 2 * room / (towards + sqrt(towards * towards + 2 * room * f.greatest_acceleration()));
}

/// A thing that swings: wherever it may be near, piece by piece of its path, in each of which a polynomial gives that
/// to rounding.
Instant ExactCollisionTimes::of_swinging(Entity i, Entity surface, uint8_t& feature, double until) const {
  const World& world = bodies_.world;
  const Flight& f = bodies_.flights[i];
  const Swing& swing = *world.swing(surface);
  // Where the search ends shortens no piece: a time of impact depends on the flight alone.
  const double end = bodies_.flight_end(i) - f.start;
  double horizon = min(end_of(i), Instant{until, 0}) - f.start;
  // What stays where it is meets the thing in the first period, or never.
  if (f.is_straight() && f.v.isZero(0) && f.a.isZero(0)) horizon = min(horizon, (bodies_.now - f.start) + swing.period);

  const double smooth = smooth_time(swing);
  const bool just_left = bodies_.body[i].origin_partner == surface;
  for (double t = 0; t < horizon;) {
    const bool leaves = t == 0 && just_left;
    const double length = min({smooth, end - t, f.span_of_fade(t)});
    if (const double clear = leaves ? 0 : clear_time(i, f, t, surface); clear > length) {
      t += clear;
      continue;
    }

    // The path of the thing as seen from the body.
    const Instant from = f.start + t;
    PolynomialPath::Terms displacement = displacement_on(swing, {from.hi, from.lo}, length);
    const PolynomialPath::Terms of_body = f.displacement_from(t, length);
    for (size_t k = 0; k < displacement.size(); ++k) displacement[k] -= of_body[k];

    const double speeds =
        sum_of_speeds(f.velocity(t)) + sum_of_speeds(bodies_.moving.velocity(surface, from)) + noise_in_contact(i);
    const FeatureTime first =
        time_of_impact(world, i, f.position(t), surface, bodies_.moving.position(surface, from), displacement, length,
                       speeds, leaves ? bodies_.body[i].origin_feature : no_feature, length);
    if (first.time < never) {
      feature = first.feature;
      return from + first.time;
    }

    if (!(t + length > t)) break;
    t += length;
  }
  return {never, 0};
}

/// Times count from the leg's start, if that is later than the flight's.
Instant ExactCollisionTimes::of_moving(Entity i, Entity surface, uint8_t& feature, double until) const {
  const World& world = bodies_.world;
  if (world.swing(surface) != nullptr) return of_swinging(i, surface, feature, until);
  const Flight& f = bodies_.flights[i];
  const Instant base = max(f.start, bodies_.moving.leg_start(surface, bodies_.now));
  const double since = base - f.start;
  const double horizon = end_of(i) - base;
  if (!(horizon > 0)) return {never, 0};

  // The body and the thing at `base`.
  const Vec3 x = f.position(since);
  const Vec3 v = f.velocity(since);
  const Vec3 xs = bodies_.moving.position(surface, base);
  const Vec3 u = bodies_.moving.velocity(surface, base);

  const double speeds = sum_of_speeds(v) + sum_of_speeds(u) + noise_in_contact(i);
  const bool just_left = since == 0 && bodies_.body[i].origin_partner == surface;
  const uint8_t left = just_left ? bodies_.body[i].origin_feature : no_feature;

  // Each kind of flight has a search of its own.
  FeatureTime first{never, 0};
  if (f.curve != nullptr && !f.curve->is_parabola) {
    PolynomialPath::Terms displacement = f.displacement_from(since, horizon);
    for (Vec3& term : displacement) term = -term;
    displacement[0] += horizon * u;
    first = time_of_impact(world, i, x, surface, xs, displacement, horizon, speeds, left, horizon);
  } else if (!f.is_parabola()) {
    const FadingPath fixed{xs, u, Vec3::Zero(), 0};
    first = time_of_impact(world, i, f.path().from(since), surface, fixed, speeds, left, horizon);
  } else if (world.is_plane(surface)) {
    // A parabola meets a plane in closed form.
    const Vec3& n = world.plane(surface).normal;
    const double noise = exact_tolerance::plane_rounding * speeds;
    const double gap = plane_gap(x, xs, n, world.volume_of(i).support(n));
    first = {plane_contact_time(gap, n.dot(v - u), n.dot(f.acceleration(since)), noise, just_left, horizon), 0};
  } else {
    const double moved = (xs - world.fixed_position(surface)).cwiseAbs().sum();
    const RelativeMotion m{xs - x, u - v, -f.acceleration(since), speeds, just_left, moved};
    first = time_of_impact(world, i, surface, m, left, horizon);
  }

  feature = first.feature;
  return first.time == never ? Instant{never, 0} : base + first.time;
}

Instant ExactCollisionTimes::of_surface(Entity i, Entity surface, uint8_t& feature) const {
  const World& world = bodies_.world;
  const Flight& f = bodies_.flights[i];
  const Instant end = end_of(i);
  const bool step = end.hi < bodies_.options.duration;
  const double horizon = end - f.start;
  const bool left = bodies_.body[i].origin_partner == surface;

  double t;
  const bool ball = world.volume.empty() || world.volume[i].shape == Shape::sphere;
  const double steps = noise_in_contact(i);

  if (f.curve != nullptr && !(horizon > 0)) return {never, 0};
  if (f.curve != nullptr && !f.curve->is_parabola) {
    // The displacement of the surface relative to the body.
    PolynomialPath::Terms displacement = f.displacement_from(0, horizon);
    for (Vec3& term : displacement) term = -term;
    const FeatureTime first =
        time_of_impact(world, i, f.x, surface, world.fixed_position(surface), displacement, horizon,
                       sum_of_speeds(f.v) + steps, left ? bodies_.body[i].origin_feature : no_feature, horizon);
    t = first.time;
    feature = first.feature;
  } else if (!f.is_parabola()) {
    // A path under drag, and a surface at rest.
    const FadingPath fixed{world.fixed_position(surface), Vec3::Zero(), Vec3::Zero(), 0};
    const FeatureTime first = time_of_impact(world, i, f.path(), surface, fixed, sum_of_speeds(f.v) + steps,
                                             left ? bodies_.body[i].origin_feature : no_feature, horizon);
    t = first.time;
    feature = first.feature;
  } else if (ball && world.is_plane(surface)) {
    // A ball's parabola meets a plane in closed form.
    const Plane& plane = world.plane(surface);
    const double noise = exact_tolerance::plane_rounding * (sum_of_speeds(f.v) + steps);
    t = plane_contact_time(plane_gap(f.x, plane.point, plane.normal, world.radius[i]), plane.normal.dot(f.v),
                           plane.normal.dot(f.a), noise, left, horizon);
  } else if (ball && world.is_wall(surface)) {
    // Within a step most walls are out of reach.
    const double reach = world.radius[i] + horizon * (sum_of_speeds(f.v) + horizon * sum_of_speeds(f.a));
    if (step && (f.x - nearest_on_wall(world.wall(surface), f.x)).squaredNorm() > reach * reach) return {never, 0};

    const FeatureTime contact = wall_contact_time(world.wall(surface), f.x, f.v, f.a, world.radius[i],
                                                  left ? bodies_.body[i].origin_feature : no_feature, horizon);
    t = contact.time;
    feature = contact.feature;
  } else {
    const RelativeMotion m{world.fixed_position(surface) - f.x, -f.v, -f.a, sum_of_speeds(f.v) + steps, left};
    const FeatureTime first =
        time_of_impact(world, i, surface, m, left ? bodies_.body[i].origin_feature : no_feature, horizon);
    t = first.time;
    feature = first.feature;
  }

  return t == never ? Instant{never, 0} : f.start + t;
}

}  // namespace carom
