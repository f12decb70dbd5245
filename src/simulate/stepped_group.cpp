#include "simulate/stepped_group.h"

#include <algorithm>

#include "physics/force.h"
#include "physics/impact.h"
#include "physics/touch.h"
#include "simulate/tolerances.h"

namespace carom {

ContactGroup::ContactGroup(StepShared& shared, StepMotion& motion, StepImpactPredictor& predictor)
    : shared_(shared),
      motion_(motion),
      predictor_(predictor),
      contacts_(shared, predictor, false),
      step_(shared),
      rest_(shared, predictor) {}

void ContactGroup::step() {
  shared_.log.remove_resting(resting_);
  resting_ = 0;
  bodies_.clear();
  contacts_.clear();
  const std::span<const Entity> awake = shared_.awake.list();
  if (std::none_of(awake.begin(), awake.end(), [&](Entity i) { return shared_.group.joined(i); })) return;
  for (const Entity i : awake)
    if (!shared_.group.joined(i)) predictor_.cover_path(i);
  for (const Entity i : find_bodies()) {
    const Vec3 &x = shared_.paths.x[i], &v = shared_.paths.v[i];
    bodies_.add(shared_.world, i, x, v, shared_.free.acceleration(i, x, v));
  }
  find_motion();
  record_impacts();
  write_paths();
  rest_.put_to_rest(bodies_, contacts_.list());
  count_resting();
}

/// The bodies of the group in this step: those that have joined it, and those that they may meet.
std::vector<Entity> ContactGroup::find_bodies() {
  const StepPaths& paths = shared_.paths;
  std::vector<Entity> bodies;
  for (const Entity i : shared_.awake.list())
    if (shared_.group.joined(i)) bodies.push_back(i);
  for (const Entity i : bodies) {
    shared_.group.enter_step(i);
    const double acceleration = shared_.free.acceleration(i, paths.x[i], paths.v[i]).norm();
    cover_speed(i, paths.v[i].norm() + shared_.clock.length() * acceleration);
  }
  for (std::size_t k = 0; k < bodies.size(); ++k) add_reachable(bodies, k);
  std::sort(bodies.begin(), bodies.end());
  return bodies;
}

/// Adds the bodies that bodies[k] may meet in the step, with their clusters.
void ContactGroup::add_reachable(std::vector<Entity>& bodies, std::size_t k) {
  const World& world = shared_.world;
  const StepPaths& paths = shared_.paths;
  const double h = shared_.clock.length();
  const Entity i = bodies[k];
  for (const Entity e : predictor_.neighbours().near(i)) {
    if (!world.is_body(e) || shared_.group.in_step(e)) continue;
    const double acceleration = shared_.free.acceleration(i, paths.x[i], paths.v[i]).norm();
    const double far = h * (paths.v[i].norm() + paths.v[e].norm() + h * acceleration);
    const double reach = world.radius[i] + world.radius[e] + far;
    if ((paths.x[i] - paths.x[e]).squaredNorm() > reach * reach) continue;
    const Entity a = std::min(i, e), b = std::max(i, e);
    if (touch(world, a, paths.x[a], b, paths.x[b]).gap > far) continue;
    const std::size_t first = bodies.size();
    if (shared_.clusters.holds(e))
      motion_.dissolve(shared_.clusters.of(e), 0, bodies);
    else
      bodies.push_back(e);
    for (std::size_t m = first; m < bodies.size(); ++m) {
      shared_.group.enter_step(bodies[m]);
      shared_.group.join(bodies[m]);
    }
  }
}

/// Sees to it that body i's neighbours are all that it can meet at this speed (m/s), in any direction.
void ContactGroup::cover_speed(Entity i, double speed) {
  shared_.paths.path[i] = {shared_.paths.x[i], Vec3(speed, speed, speed), Vec3::Zero(), Vec3::Zero()};
  predictor_.cover_path(i);
}

/// Finds the contacts within the bounds of the bodies' speeds.
void ContactGroup::find_contacts() {
  const double kick = bodies_.greatest_acceleration * shared_.clock.length();
  for (std::size_t k = 0; k < bodies_.size(); ++k)
    if (!contacts_.searched(k)) cover_speed(bodies_.entity[k], contacts_.bound(k) + kick);
  contacts_.find(bodies_);
}

/// Finds the velocities and displacements of the step. A body that is pushed aside may go farther than was searched.
/// Contacts are then searched again.
void ContactGroup::find_motion() {
  const double kick = shared_.clock.length() * bodies_.greatest_acceleration;
  contacts_.start(bodies_, kick);
  find_contacts();
  step_.find_velocities(bodies_, contacts_.list());
  for (std::size_t k = 0; k < bodies_.size(); ++k) contacts_.raise(k, step_.end_v(k).norm());
  for (int pass = 0; pass < stepped_tolerance::search_passes; ++pass) {
    find_contacts();
    step_.find_displacements(bodies_, contacts_.list());
    bool farther = false;
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      const double speed = step_.drift(k).norm();
      if (speed <= contacts_.bound(k) + kick) continue;
      contacts_.raise(k, 2 * speed);
      farther = true;
    }
    if (!farther) break;
  }
  step_.find_pressed(bodies_, contacts_.list());
}

/// The bodies' paths through the step are straight.
void ContactGroup::write_paths() {
  StepPaths& paths = shared_.paths;
  if (shared_.free.constant()) step_.limit_free_bodies(bodies_);
  step_.remember(bodies_, contacts_.list());
  for (std::size_t k = 0; k < bodies_.size(); ++k) {
    const Entity i = bodies_.entity[k];
    const bool pressed = step_.pressed(k);
    paths.path[i] = {paths.x[i], step_.drift(k), Vec3::Zero(), Vec3::Zero()};
    paths.end_x[i] = paths.path[i].position(shared_.clock.length());
    paths.end_v[i] = step_.end_v(k);
    pressed ? shared_.group.join(i) : shared_.group.count_step(i);
    rest_.note(i, pressed, std::max(step_.drift(k).norm(), step_.end_v(k).norm()), bodies_.greatest_acceleration);
  }
}

void ContactGroup::record_impacts() {
  for (const GroupContact& c : contacts_.list()) {
    if (!c.impact || !(c.impulse > 0)) continue;
    const bool body = c.of_b != ContactConstraint::fixed;
    const Vec3 w = (body ? step_.end_v(c.of_b) : Vec3(Vec3::Zero())) - step_.end_v(c.of_a);
    const double separation = std::max(c.normal.dot(w), 0.0);
    const Vec3 point = touch(shared_.world, c.a, shared_.paths.x[c.a], c.b, shared_.paths.position_of(c.b)).point;
    Collision collision =
        make_collision(shared_.world, body ? CollisionKind::body_body : CollisionKind::body_fixed, shared_.clock.from(),
                       c.a, c.b, point, c.normal, c.approach, separation, c.restitution);
    collision.impulse = c.impulse;  // of the whole step
    shared_.log.record(collision);
  }
}

/// Whether a contact of the step lasts, between bodies that do not sleep.
bool ContactGroup::lasts(const GroupContact& c) const {
  return !c.impact && c.impulse > 0 && !shared_.clusters.holds(c.a);
}

void ContactGroup::count_resting() {
  std::vector<std::uint8_t> rests(bodies_.size());
  for (const GroupContact& c : contacts_.list()) {
    if (!lasts(c)) continue;
    rests[c.of_a] = 1;
    if (c.of_b != ContactConstraint::fixed) rests[c.of_b] = 1;
  }
  resting_ = static_cast<std::size_t>(std::count(rests.begin(), rests.end(), 1));
  shared_.log.add_resting(resting_);
  shared_.log.add_stepped_contact(static_cast<double>(resting_) * shared_.clock.length());
}

/// What a group's step does to energy, other than by forces, contact has taken.
void ContactGroup::book_energy(Entity i, double work) {
  const StepPaths& paths = shared_.paths;
  const World& world = shared_.world;
  shared_.log.lose(0.5 * world.mass[i] * (paths.v[i] - paths.end_v[i]).dot(paths.v[i] + paths.end_v[i]) +
                   potential(world, i, paths.x[i]) - potential(world, i, paths.end_x[i]) + work);
}

void ContactGroup::add_forces(std::vector<ContactForce>& forces) const {
  for (const GroupContact& c : contacts_.list())
    if (lasts(c)) forces.push_back({c.a, c.b, c.impulse / shared_.clock.length()});
}

}  // namespace carom
