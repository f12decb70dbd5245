#include "simulate/stepped_impacts.h"

#include <algorithm>
#include <cmath>

#include "physics/force.h"
#include "physics/impact.h"
#include "physics/restitution.h"
#include "simulate/stepped_releases.h"
#include "simulate/tolerances.h"

namespace carom {

using namespace stepped_tolerance;

void StepImpacts::process(const StepEvent& event) {
  event.kind == StepEventKind::impact ? collide(event) : release(event);
}

void StepImpacts::release(const StepEvent& event) {
  std::vector<Entity> bodies;
  motion_.dissolve(shared_.clusters.of(event.a), event.time, bodies);
  binding_.bind_after(event, true, bodies, event.time);
  begin_paths(bodies);
}

void StepImpacts::collide(const StepEvent& event) {
  const Entity a = event.a, b = event.b;
  const double time = refined_time(event);
  if (waits_for_step(a) || waits_for_step(b)) return stop_at_waiting(a, b, time);
  shared_.bounces.count_contact(a);
  if (shared_.bounces.jammed(a)) return stop_at(b, a, time);
  const Vec3 relative_acceleration = motion_.acceleration_of(a) - motion_.acceleration_of(b);
  std::vector<Entity> bodies;
  for (const Entity e : {a, b})
    if (shared_.world.is_body(e) && std::find(bodies.begin(), bodies.end(), e) == bodies.end())
      motion_.set_free(e, time, bodies);
  const ImpactOutcome outcome = resolve(event, time, relative_acceleration);
  binding_.bind_after({time, StepEventKind::impact, a, b, outcome.feature}, outcome.parts, bodies, time);
  begin_paths(bodies);
}

/// s, since the step's start. A cubic path through a step is not quite where shorter steps lead: goes there, and looks
/// again.
double StepImpacts::refined_time(const StepEvent& event) const {
  const StepPaths& paths = shared_.paths;
  const auto free_cubic = [&](Entity e) {
    return shared_.world.is_body(e) && !shared_.clusters.holds(e) && !paths.path[e].j.isZero(0);
  };
  if (!free_cubic(event.a) && !free_cubic(event.b)) return event.time;
  const bool body = shared_.world.is_body(event.b);
  const double base = body ? std::max(paths.start[event.a], paths.start[event.b]) : paths.start[event.a];
  const double length = shared_.clock.length();
  double time = event.time;
  for (int pass = 0; pass < refinements; ++pass) {  // Newton's method
    const PointState a = state_at(event.a, time), b = state_at(event.b, time);
    const Touch there = touch(shared_.world, event.a, a.x, event.b, b.x, event.feature);
    const double rate = there.normal.dot(b.v - a.v);
    if (!(rate < 0)) break;
    const double next = std::clamp(time - there.gap / rate, base, length);
    if (std::abs(next - event.time) > farthest_refinement * length || next == time) break;
    time = next;
  }
  return time;
}

/// Of a body alone by a step as long as it takes; of one in a cluster by its path.
StepImpacts::PointState StepImpacts::state_at(Entity e, double time) const {
  const StepPaths& paths = shared_.paths;
  if (!shared_.world.is_body(e)) return {shared_.world.fixed_position(e), Vec3::Zero()};
  if (shared_.clusters.holds(e)) {
    const Path now = paths.from(e, time);
    return {now.x, now.v};
  }
  Vec3 x = paths.x[e], v = paths.v[e];
  Path path;
  shared_.free.carry(e, time - paths.start[e], x, v, path);
  return {x, v};
}

/// Whether what e is of takes no other path before the next step: the contact group, or a large cluster asleep.
bool StepImpacts::waits_for_step(Entity e) const {
  if (shared_.group.has(e)) return true;
  if (!shared_.world.is_body(e) || !shared_.clusters.asleep(e)) return false;
  return shared_.clusters[shared_.clusters.of(e)].bodies.size() > most_cluster_bodies;
}

/// a or b waits for the next step: the other one stops at it. A body that a third one carries yields. It stands from
/// then on, and others yield to it.
void StepImpacts::stop_at_waiting(Entity a, Entity b, double time) {
  const GroupMembers& group = shared_.group;
  const bool a_waits = waits_for_step(a);
  const bool a_stands = a_waits && group.stands(a);
  const bool b_comes = shared_.world.is_body(b) &&
                       (!waits_for_step(b) || (a_waits && (group.carried(b) || (a_stands && !group.stands(b)))));
  b_comes ? stop_at(a, b, time) : stop_at(b, a, time);
}

/// The body that comes, and its cluster, go along with the one that waits until the step ends.
void StepImpacts::stop_at(Entity still, Entity comes, double time) {
  if (shared_.world.is_body(still) && shared_.clusters.holds(still))
    shared_.clusters[shared_.clusters.of(still)].woken = true;
  std::vector<Entity> bodies;
  if (!shared_.clusters.holds(comes) && shared_.group.in_step(comes)) {
    StepPaths& paths = shared_.paths;
    const Vec3 from = paths.x[comes];
    const double work = motion_.end(comes, time, paths.from(comes, time).x, paths.v[comes]);
    shared_.log.lose(potential(shared_.world, comes, from) - potential(shared_.world, comes, paths.x[comes]) + work);
    bodies.push_back(comes);
  } else {
    motion_.set_free(comes, time, bodies);
  }
  for (const Entity i : bodies) attach(i, still);
  for (const Entity i : bodies) {
    predictor_.cover_path(i);
    predictor_.predict(i);
  }
}

/// Body i goes along with a carrier of the contact group to the step's end, or to what it meets before. It keeps
/// its own velocity for the next step, or the one that the group's step has given it.
void StepImpacts::attach(Entity i, Entity carrier) {
  StepPaths& paths = shared_.paths;
  GroupMembers& group = shared_.group;
  const bool stopped_before = group.in_step(i);
  const Vec3 along = stopped_before ? Vec3(Vec3::Zero()) : paths.from(carrier, paths.start[i]).v;
  if (!stopped_before) paths.end_v[i] = paths.v[i];
  paths.path[i] = {paths.x[i], along, Vec3::Zero(), Vec3::Zero()};
  paths.end_x[i] = paths.path[i].position(shared_.clock.length() - paths.start[i]);
  group.enter_step(i, stopped_before ? i : carrier);
  group.join(i);
}

/// The impact of a and b, whose paths begin at `time`. relative_acceleration: m/s^2, a's less b's as they met.
StepImpacts::ImpactOutcome StepImpacts::resolve(const StepEvent& event, double time,
                                                const Vec3& relative_acceleration) {
  const World& world = shared_.world;
  StepPaths& paths = shared_.paths;
  const Entity a = event.a, b = event.b;
  const bool body = world.is_body(b);
  const Vec3 xb = paths.position_of(b), w = paths.velocity_of(b) - paths.v[a];
  const Touch there = touch(world, a, paths.x[a], b, xb, event.feature);
  const Vec3& n = there.normal;
  shared_.log.note_overlap(-there.gap);
  const double approach = -n.dot(w), e = pair_restitution(world, a, b);
  const double press = n.dot(relative_acceleration) - bending(world, a, paths.x[a], b, xb, there, w);
  const double noise =
      impact_rounding * (paths.v[a].norm() + paths.velocity_of(b).norm() + std::abs(press) * shared_.options.step);
  shared_.bounces.count_impact(a, b, e);
  const bool lasting = shared_.bounces.ends_in_contact(a, b, e, approach, press, noise);
  const double separation = lasting ? 0 : e * approach;
  const CollisionKind kind = lasting && !body && e > 0 ? CollisionKind::rest
                             : body                    ? CollisionKind::body_body
                                                       : CollisionKind::body_fixed;
  const Collision collision =
      make_collision(world, kind, shared_.clock.from() + time, a, b, there.point, n, approach, separation, e);
  if (approach > noise) shared_.log.record(collision);
  if (lasting) return {there.feature, false};
  shared_.log.lose(collision.energy_lost);
  paths.v[a] -= collision.impulse / world.mass[a] * n;
  if (body) paths.v[b] += collision.impulse / world.mass[b] * n;
  shared_.check_bounds(a, paths.x[a], paths.v[a]);
  if (body) shared_.check_bounds(b, paths.x[b], paths.v[b]);
  return {there.feature, true};
}

/// New paths for bodies whose last ones have ended, and what they meet on them.
void StepImpacts::begin_paths(const std::vector<Entity>& bodies) {
  std::vector<std::uint32_t> moving;  // clusters
  for (const Entity i : bodies) {
    const std::uint32_t c = shared_.clusters.of(i);
    if (c == Clusters::none && shared_.group.in_step(i)) {  // too many to go on together
      shared_.paths.stay(i);
    } else if (c == Clusters::none) {
      motion_.begin(i);
    } else if (shared_.clusters[c].moves() && std::find(moving.begin(), moving.end(), c) == moving.end()) {
      moving.push_back(c);
      motion_.begin(shared_.clusters[c]);
    }
  }
  for (const Entity i : bodies) predictor_.cover_path(i);
  for (const Entity i : bodies) predictor_.predict(i);
  for (const std::uint32_t c : moving) predict_releases(shared_, motion_.of_clusters(), shared_.clusters[c], events_);
}

}  // namespace carom
