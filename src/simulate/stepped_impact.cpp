// What happens when two meet.
#include <algorithm>
#include <cmath>

#include "physics/force.h"
#include "physics/impact.h"
#include "physics/restitution.h"
#include "simulate/stepped_simulator.h"

namespace carom {

namespace {

constexpr double immovable = never;            // kg
constexpr std::uint32_t most_meetings = 2000;  // of a body in one step under load: it waits for the next one

}  // namespace

void SteppedSimulator::process(const Event& event) {
  const bool body = world_.is_body(event.b);
  if (version_[event.a] != event.version_a || (body && version_[event.b] != event.version_b)) return;
  if (event.kind == Kind::impact) return collide(event);
  std::vector<Entity> group;
  dissolve(cluster_of_[event.a], event.time, group);
  bind(group, event.time, &event, true);
  go_on(group);
}

/// A cubic path through a step is not quite where shorter steps lead: goes there, and looks again.
double SteppedSimulator::refined(const Event& event) const {
  const auto free_cubic = [&](Entity e) {
    return world_.is_body(e) && cluster_of_[e] == none && !path_[e].j.isZero(0);
  };
  if (!free_cubic(event.a) && !free_cubic(event.b)) return event.time;
  const bool body = world_.is_body(event.b);
  const double base = body ? std::max(start_[event.a], start_[event.b]) : start_[event.a];
  const auto state_after = [&](Entity e, double time, Vec3& x, Vec3& v) {
    if (!world_.is_body(e)) {
      x = world_.fixed_position(e);
      v = Vec3::Zero();
    } else if (cluster_of_[e] == none) {
      x = x_[e];
      v = v_[e];
      Path path;
      take(e, time - start_[e], x, v, path);
    } else {
      x = path_of(e, time).x;
      v = path_of(e, time).v;
    }
  };
  double time = event.time;
  for (int pass = 0; pass < 4; ++pass) {
    Vec3 xa, va, xb, vb;
    state_after(event.a, time, xa, va);
    state_after(event.b, time, xb, vb);
    const Touch there = touch(world_, event.a, xa, event.b, xb, event.feature);
    const double rate = there.normal.dot(vb - va);
    if (!(rate < 0)) break;
    const double next = std::clamp(time - there.gap / rate, base, length_);
    if (std::abs(next - event.time) > 0.1 * length_ || next == time) break;
    time = next;
  }
  return time;
}

/// m/s^2, of a body or a fixed thing where its path begins.
Vec3 SteppedSimulator::acceleration_of(Entity e) const {
  if (!world_.is_body(e)) return Vec3::Zero();
  if (cluster_of_[e] == none) return free_acceleration(e, x_[e], v_[e]);
  const Cluster& cluster = clusters_[cluster_of_[e]];
  if (cluster.asleep) return Vec3::Zero();
  const Motion m = gather(cluster);
  std::vector<Vec3> a(m.x.size());
  std::vector<PressedPair> pairs;
  accelerate(cluster, m.x, m.v, a, pairs);
  return a[local_[e]];
}

/// Whether bounces of less than a step begin: press (m/s^2) drives the two together.
bool SteppedSimulator::slow(double e, double approach, double press) const {
  return press > 0 && e < 1 && (2 * e * approach < press * shortest_hop_ || approach <= options_.rest_speed);
}

bool SteppedSimulator::taken_up(Entity a, Entity b, double e, double approach, double press, double noise) {
  std::uint32_t impacts = 0;
  if (e < 1) impacts = std::max(++impacts_[a], world_.is_body(b) ? ++impacts_[b] : 0);
  return approach <= noise || slow(e, approach, press) || (impacts > many_impacts_ && e < 1);
}

/// `still` is of the crowd, or of a sleeping pile, which wakes with the next step: who comes waits there.
void SteppedSimulator::stop_at_crowd(Entity still, Entity comes, double time) {
  if (world_.is_body(still) && cluster_of_[still] != none) clusters_[cluster_of_[still]].woken = true;
  std::vector<Entity> group;
  if (cluster_of_[comes] != none) {
    dissolve(cluster_of_[comes], time, group);
  } else if (in_crowd_[comes]) {
    const Vec3 from = x_[comes];
    const double work = cut(comes, time, path_of(comes, time).x, v_[comes]);
    lose(potential(world_, comes, from) - potential(world_, comes, x_[comes]) + work);
    group.push_back(comes);
  } else {
    bring(comes, time);
    group.push_back(comes);
  }
  for (const Entity i : group) park(i, still);
  for (const Entity i : group) {
    stay_known(i);
    predict(i, true);
  }
}

void SteppedSimulator::collide(const Event& event) {
  const Entity a = event.a, b = event.b;
  const bool body = world_.is_body(b);
  const double time = refined(event);
  const auto large = [&](Entity e) {
    return crowded(e) || (world_.is_body(e) && cluster_of_[e] != none && clusters_[cluster_of_[e]].asleep &&
                          clusters_[cluster_of_[e]].members.size() > most_members);
  };
  if (large(a) || large(b)) {
    // Who goes along with another gives way; then, as he stands, so do those that come his way.
    const auto gives_way = [&](Entity e) { return host_[e] != no_entity && host_[e] != e; };
    const bool a_stands = large(a) && host_[a] == a;
    const bool b_comes = body && (!large(b) || (large(a) && (gives_way(b) || (a_stands && host_[b] != b))));
    return stop_at_crowd(b_comes ? a : b, b_comes ? b : a, time);
  }
  if (loaded_ && ++meetings_[a] > most_meetings) return stop_at_crowd(b, a, time);  // jammed
  const Vec3 acceleration = acceleration_of(a) - acceleration_of(b);
  std::vector<Entity> group;
  for (const Entity e : {a, b}) {
    if (!world_.is_body(e) || std::find(group.begin(), group.end(), e) != group.end()) continue;
    if (cluster_of_[e] != none) {
      dissolve(cluster_of_[e], time, group);
    } else {
      bring(e, time);
      group.push_back(e);
    }
  }
  const Vec3 xb = position_of(b), w = velocity_of(b) - v_[a];
  const Touch there = touch(world_, a, x_[a], b, xb, event.feature);
  const Vec3& n = there.normal;
  tally_.max_overlap = std::max(tally_.max_overlap, -there.gap);
  const double approach = -n.dot(w), e = pair_restitution(world_, a, b);
  const double press = n.dot(acceleration) - bending(world_, a, x_[a], b, xb, there, w);
  const double noise = 0x1p-46 * (v_[a].norm() + velocity_of(b).norm() + std::abs(press) * options_.step);
  const double ma = world_.mass[a], mb = body ? world_.mass[b] : immovable;
  const bool lasting = taken_up(a, b, e, approach, press, noise);
  const double separation = lasting ? 0 : e * approach;
  if (approach > noise) {
    const bool bounces_end = lasting && !body && e > 0;
    record({from_ + time,
            bounces_end ? CollisionKind::rest
            : body      ? CollisionKind::body_body
                        : CollisionKind::body_fixed,
            a, b, there.point, n, approach, separation, e, impact_impulse(ma, mb, approach, separation),
            impact_loss(ma, mb, approach, separation)});
  }
  if (!lasting) {
    const double impulse = impact_impulse(ma, mb, approach, separation);
    lose(impact_loss(ma, mb, approach, separation));
    v_[a] -= impulse / ma * n;
    if (body) v_[b] += impulse / mb * n;
    hold_to(bounds_, a, to_, x_[a], v_[a], too_fast);
    if (body) hold_to(bounds_, b, to_, x_[b], v_[b], too_fast);
  }
  const Event struck{time, Kind::impact, a, b, there.feature, 0, 0};
  bind(group, time, &struck, !lasting);
  go_on(group);
}

}  // namespace carom
