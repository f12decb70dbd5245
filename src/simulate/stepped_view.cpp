#include "simulate/stepped_view.h"

#include <algorithm>

namespace carom {

StepView::StepView(const StepShared& shared, const ClusterMotion& motion, const ContactGroup& group)
    : shared_(shared), motion_(motion), group_(group) {}

const State& StepView::state(double time) {
  if (fresh_) return state_;
  const StepPaths& paths = shared_.paths;
  state_.time = time;
  state_.position = paths.end_x;
  state_.velocity = paths.end_v;
  fresh_ = true;
  if (!(time < shared_.clock.to())) return state_;
  const double t = time - shared_.clock.from();
  for (const Entity i : shared_.awake.list()) {
    if (!(t >= paths.start[i])) continue;
    look({i, paths.start[i], shared_.clock.length(), paths.path[i], paths.end_v[i], shared_.constrained(i)}, t);
  }
  for (const StepPiece& piece : paths.pieces)
    if (t >= piece.from && t < piece.to) look(piece, t);
  return state_;
}

/// A body on a piece of its path, at t (s, since the step's start).
void StepView::look(const StepPiece& piece, double t) {
  Vec3 x = piece.path.x, v = piece.path.v;
  const double since = t - piece.from;
  if (!piece.constrained) {
    Path same;
    shared_.free.carry(piece.body, since, x, v, same);
  } else {
    const double length = piece.to - piece.from;
    x = piece.path.position(since);
    v = piece.path.velocity(since) + since / length * (piece.end_v - piece.path.velocity(length));
  }
  state_.position[piece.body] = x;
  state_.velocity[piece.body] = v;
}

std::span<const ContactForce> StepView::forces(double time) {
  forces_.clear();
  for (std::uint32_t c = 0; c < shared_.clusters.size(); ++c) {
    const Cluster& cluster = shared_.clusters[c];
    if (!cluster.in_use()) continue;
    add_forces(cluster, time - shared_.clock.from() - shared_.paths.start[cluster.bodies.front()]);
  }
  group_.add_forces(forces_);
  std::sort(forces_.begin(), forces_.end(),
            [](const ContactForce& p, const ContactForce& q) { return std::pair(p.a, p.b) < std::pair(q.a, q.b); });
  return forces_;
}

/// Of a cluster, `since` (s) after its paths began.
void StepView::add_forces(const Cluster& cluster, double since) {
  const bool moved = !cluster.asleep && since > 0;
  std::vector<ContactConstraint> pairs;  // by active contact
  if (moved) {
    ClusterState s = motion_.start(cluster);
    motion_.carry(cluster, since, s);
    std::vector<Vec3> a(s.x.size());
    motion_.accelerate(cluster, s, s.end_x, s.end_v, a, pairs);
  }
  std::size_t k = 0;
  for (const ClusterContact& c : cluster.contacts) {
    if (!c.active) continue;
    const double force = moved ? pairs[k].force : c.force;
    ++k;
    if (force > 0) forces_.push_back({c.a, c.b, force});
  }
}

}  // namespace carom
