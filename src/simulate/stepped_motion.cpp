#include "simulate/stepped_motion.h"

namespace carom {

StepMotion::StepMotion(StepShared& shared)
    : shared_(shared), cluster_motion_(shared.world, shared.free, shared.paths) {}

Vec3 StepMotion::acceleration_of(Entity e) const {
  if (!shared_.world.is_body(e)) return Vec3::Zero();
  if (!shared_.clusters.holds(e)) return shared_.free.acceleration(e, shared_.paths.x[e], shared_.paths.v[e]);
  const Cluster& cluster = shared_.clusters[shared_.clusters.of(e)];
  if (cluster.asleep) return Vec3::Zero();
  const ClusterState s = cluster_motion_.start(cluster);
  std::vector<Vec3> a(s.x.size());
  std::vector<ContactConstraint> pairs;
  cluster_motion_.accelerate(cluster, s, s.x, s.v, a, pairs);
  return a[cluster.place_of(e)];
}

void StepMotion::begin(Entity i) {
  StepPaths& paths = shared_.paths;
  Vec3 x = paths.x[i], v = paths.v[i];
  shared_.free.carry(i, shared_.clock.length() - paths.start[i], x, v, paths.path[i]);
  paths.end_x[i] = x;
  paths.end_v[i] = v;
}

void StepMotion::begin(Cluster& cluster) {
  StepPaths& paths = shared_.paths;
  ClusterState s = cluster_motion_.start(cluster);
  cluster_motion_.carry_and_activate(cluster, shared_.clock.length() - paths.start[cluster.bodies.front()], s);
  shared_.log.note(s.certificate);
  for (std::size_t k = 0; k < cluster.bodies.size(); ++k) {
    const Entity i = cluster.bodies[k];
    paths.path[i] = s.path[k];
    paths.end_x[i] = s.end_x[k];
    paths.end_v[i] = s.end_v[k];
  }
}

double StepMotion::end(Entity i, double time, const Vec3& x, const Vec3& v) {
  const double length = time - shared_.paths.start[i];
  const double work = length > 0 ? book_work(i, x, v, length) : 0;
  shared_.paths.cut(i, time, x, v, shared_.constrained(i));
  return work;
}

void StepMotion::end_alone(Entity i, double time) {
  Vec3 x = shared_.paths.x[i], v = shared_.paths.v[i];
  Path path;
  shared_.free.carry(i, time - shared_.paths.start[i], x, v, path);
  end(i, time, x, v);
}

void StepMotion::dissolve(std::uint32_t c, double time, std::vector<Entity>& bodies) {
  StepPaths& paths = shared_.paths;
  const Cluster& cluster = shared_.clusters[c];
  const double start = paths.start[cluster.bodies.front()];
  if (!cluster.asleep && time > start) {
    ClusterState s = cluster_motion_.start(cluster);
    cluster_motion_.carry(cluster, time - start, s);
    shared_.log.note(s.certificate);
    for (std::size_t k = 0; k < cluster.bodies.size(); ++k) end(cluster.bodies[k], time, s.end_x[k], s.end_v[k]);
  }
  for (const Entity i : cluster.bodies) {
    if (cluster.asleep) {
      shared_.awake.wake(i);
      paths.wake(i, time);
    }
    ++paths.version[i];  // what was predicted for the cluster is void, even if it has gone nowhere
    bodies.push_back(i);
  }
  shared_.log.remove_resting(cluster.bodies.size());
  shared_.clusters.remove(c);
}

void StepMotion::set_free(Entity i, double time, std::vector<Entity>& bodies) {
  if (shared_.clusters.holds(i)) return dissolve(shared_.clusters.of(i), time, bodies);
  end_alone(i, time);
  bodies.push_back(i);
}

double StepMotion::book_work(Entity i, const Vec3& x, const Vec3& v, double length) {
  if (!shared_.free.works() || length == 0) return 0;
  const StepPaths& paths = shared_.paths;
  const double work = shared_.free.work(i, paths.x[i], paths.v[i], x, v, length);
  shared_.log.add_work(work);
  return work;
}

}  // namespace carom
