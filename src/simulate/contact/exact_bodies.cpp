// State that the parts of the exact simulator share, and queries on it.
// Queries on a pair use the relative path, so that the common motion costs no digits.
#include "simulate/contact/exact_bodies.h"

#include <fmt/format.h>

#include "physics/force.h"
#include "physics/world.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

ExactBodies::ExactBodies(const World& given, const ExactOptions& given_options)
    : BodyPaths(given, given_options),
      same_radius(!options.merge && std::adjacent_find(given.radius.begin(), given.radius.end(), std::not_equal_to{}) ==
                                        given.radius.end()),
      ties(world),
      neighbours(world),
      islands(given.body_count()),
      contact_work(world, moving.any() || couplings.any(), options.impulses, log),
      touches_nothing(given.body_count()) {}

ExactBodies::PairState ExactBodies::in_frame_of(Entity a, Entity b) const {
  const Flight p = flights[a];
  const Flight q = flights[b];
  const Instant base = max(p.start, q.start);
  const double t = now - base;

  // Where a flight follows a curve: the positions at `base`, and the displacements since then.
  if (p.curve != nullptr || q.curve != nullptr) {
    const double tp = base - p.start;
    const double tq = base - q.start;
    const Vec3 way = (q.displacement(tq + t) - q.displacement(tq)) - (p.displacement(tp + t) - p.displacement(tp));
    return {Vec3::Zero(), Vec3::Zero(), q.position(tq) - p.position(tp) + way, q.velocity(tq + t) - p.velocity(tp + t)};
  }

  const FadingPath of_a = p.path().from(base - p.start);
  const FadingPath of_b = q.path().from(base - q.start);
  if (of_a.fade != of_b.fade)
    return {Vec3::Zero(), Vec3::Zero(), of_b.position(t) - of_a.position(t), of_b.velocity(t) - of_a.velocity(t)};

  // With equal drag the relative path is of the same form.
  const FadingPath relative{of_b.x - of_a.x, of_b.v - of_a.v, of_b.a - of_a.a, of_a.fade};
  return {Vec3::Zero(), Vec3::Zero(), relative.position(t), relative.velocity(t)};
}

bool ExactBodies::hops_fade(Entity i, double speed, double press) const {
  return speed * speed < press * exact_tolerance::fading_hop * world.radius[i] && damps(world, i, now.hi);
}

CoupledForces ExactBodies::apply_couplings(span<const Entity> those, span<const Vec3> x, span<const Vec3> v) {
  const auto number = [&](Entity i) { return uint32_t(ranges::lower_bound(those, i) - those.begin()); };
  CoupledForces forces = couplings.among(those, now.floor(), number);
  if (!forces.any()) return forces;

  vector<Vec3> a(those.size(), Vec3::Zero());
  vector<double> inverse_mass;
  for (const Entity i : those) inverse_mass.push_back(1 / world.mass[i]);
  forces.accelerate(inverse_mass, x, v, a);
  for (size_t k = 0; k < those.size(); ++k) applied.write(those[k]) += a[k];
  return forces;
}

void ExactBodies::fail_squeezed(Entity i, vector<Entity> things) const {
  ranges::sort(things);
  things.erase(std::unique(things.begin(), things.end()), things.end());
  vector<string> after = {" has no room left between "};
  for (size_t k = 0; k < things.size(); ++k)
    after.emplace_back(k + 2 < things.size()    ? ", "
                       : k + 2 == things.size() ? " and "
                                                : ": end or slow their `motion` before, leave room for the body, or "
                                                  "shorten simulate.duration");
  things.insert(things.begin(), i);
  throw SimulationError(fmt::format("at t = {} s ", now.hi), std::move(things), std::move(after));
}

vector<Entity> ExactBodies::neighbours_of(Entity i) const {
  const span<const Entity> near = neighbours.near(i);
  vector<Entity> all(near.begin(), near.end());
  ranges::sort(all);
  return all;
}

Touch ExactBodies::touch_at(Entity a, const Vec3& xa, Entity b, const Vec3& xb, uint8_t feature) const {
  if (world.is_body(b) && world.volume.empty()) {
    // The normal uses the actual distance, not the sum of the radii. It is then a unit vector, and energy is conserved
    // to rounding.
    const Vec3 d = xb - xa;
    const double distance = d.norm();
    const Vec3 n = d / distance;
    return {distance - (world.radius[a] + world.radius[b]), n, xa + world.radius[a] * n, 0};
  }
  return touch(world, a, xa, b, xb, feature);
}

Touch ExactBodies::string_now(Entity string) const {
  const String& s = world.string(string);
  return touch(world, s.body, position(s.body), string, position_of(string));
}

bool ExactBodies::holds(Entity string) const {
  const String& s = world.string(string);
  return in_lasting_contact(mode(s.body)) && (s.other == no_entity || in_lasting_contact(mode(s.other))) &&
         keeps_length(string, 0);
}

bool ExactBodies::keeps_length(Entity string, double near) const {
  const String& s = world.string(string);
  if (s.rod) return true;
  const Vec3 x = position(s.body);
  const Vec3 v = velocity(s.body);
  const Vec3 xe = position_of(string);
  const Vec3 ve = velocity_of(string);
  const Touch there = touch(world, s.body, x, string, xe);
  return there.gap <= max(near, contact_gap(s.body, x, xe)) &&
         std::abs(there.normal.dot(ve - v)) <= drift_of(s.body, v, ve);
}

bool ExactBodies::is_taut(Entity string) const {
  const String& s = world.string(string);
  return s.rod || string_now(string).gap <= contact_gap(s.body, position(s.body), position_of(string));
}

bool ExactBodies::any_taut(span<const Entity> those) const {
  return ties.any() && any_of(those, [&](Entity i) {
           const span<const Entity> strings = ties.of(i);
           return any_of(strings, [&](Entity string) { return is_taut(string); });
         });
}

double ExactBodies::contact_gap(Entity i, const Vec3& x, const Vec3& xe) const {
  return max(exact_tolerance::contact_gap * world.radius[i],
             exact_tolerance::contact_rounding * (x.cwiseAbs().sum() + xe.cwiseAbs().sum()));
}

double ExactBodies::drift_of(Entity i, const Vec3& v, const Vec3& ve) const {
  return exact_tolerance::drift * (v.norm() + ve.norm() + sqrt(applied[i].norm() * world.radius[i]));
}

double ExactBodies::slow_speed(double press, double length) const {
  return options.rest_speed > 0 ? options.rest_speed : exact_tolerance::slow_impact * sqrt(press * length);
}

}  // namespace carom
