// Paths through a step.
#include <algorithm>
#include <array>
#include <cmath>

#include "physics/force.h"
#include "physics/held_contacts.h"
#include "simulate/stepped_simulator.h"

namespace carom {

Vec3 SteppedSimulator::free_acceleration(Entity i, const Vec3& x, const Vec3& v) const {
  return world_.forces.empty() ? world_.gravity : carom::free_acceleration(world_, i, from_, x, v);
}

/// Carries body i alone on for `length` (s).
void SteppedSimulator::take(Entity i, double length, Vec3& x, Vec3& v, Path& path) const {
  using One = std::array<Vec3, 1>;
  if (options_.closed_form) {
    const LinearFlight flight = linear_flight(world_, i, from_);
    Vec3 way = Vec3::Zero(), end = v;
    flight.carry(length, way, end);
    path = {x, v, flight.pull - flight.fade * v, Vec3::Zero()};
    if (flight.fade > 0 && length > 0) {  // Hermite's polynomial through both ends
      path.a = (6 / length * way - 4 * v - 2 * end) / length;
      path.j = (6 * (v + end) - 12 / length * way) / (length * length);
    }
    x += way;
    v = end;
    return;
  }
  if (constant_) {  // the methods in closed form
    const Vec3 a = free_acceleration(i, x, v);
    const bool euler = options_.integrator == Integrator::euler;
    path = {x, v, euler ? Vec3(2 * a) : a, Vec3::Zero()};
    x = path.position(length);
    v += length * a;
    return;
  }
  One from_x{x}, from_v{v}, end_x, end_v;
  std::array<Path, 1> paths;
  take_step(
      options_.integrator, length, from_x, from_v,
      [&](const One& at, const One& speed, One& a) { a[0] = free_acceleration(i, at[0], speed[0]); }, end_x, end_v,
      paths);
  x = end_x[0];
  v = end_v[0];
  path = paths[0];
}

/// Body i flies on alone from where it is.
void SteppedSimulator::begin_path(Entity i) {
  Vec3 x = x_[i], v = v_[i];
  take(i, length_ - start_[i], x, v, path_[i]);
  end_x_[i] = x;
  end_v_[i] = v;
}

/// The accelerations of a cluster's members, with the forces that hold those that press. pairs: in the bonds' order,
/// for those that press alone.
void SteppedSimulator::accelerate(const Cluster& cluster, const std::vector<Vec3>& x, const std::vector<Vec3>& v,
                                  std::vector<Vec3>& a, std::vector<PressedPair>& pairs) const {
  const std::size_t n = cluster.members.size();
  for (std::size_t k = 0; k < n; ++k) a[k] = free_acceleration(cluster.members[k], x[k], v[k]);
  pairs.clear();
  for (const Bond& bond : cluster.bonds) {
    if (!bond.presses) continue;
    const std::uint32_t ka = local_[bond.a], kb = world_.is_body(bond.b) ? local_[bond.b] : PressedPair::none;
    const bool body = kb != PressedPair::none;
    const Vec3 xb = body ? x[kb] : world_.fixed_position(bond.b), vb = body ? v[kb] : Vec3(Vec3::Zero());
    const Touch there = touch(world_, bond.a, x[ka], bond.b, xb, bond.feature);
    const double bend = is_flat(world_, bond.a, bond.b, bond.feature)
                            ? 0
                            : bending(world_, bond.a, x[ka], bond.b, xb, there, vb - v[ka]);
    pairs.push_back({ka, kb, there.normal, -bend, 0, 0});
  }
  hold(inverse_masses(cluster), a, pairs);
}

std::vector<double> SteppedSimulator::inverse_masses(const Cluster& cluster) const {
  std::vector<double> inverse;
  for (const Entity i : cluster.members) inverse.push_back(1 / world_.mass[i]);
  return inverse;
}

/// Sets bodies that press on each other on each other's surfaces, where a step has strayed from them, and takes what
/// speed they have into or off them; of the others those that the step has led into each other are set apart.
void SteppedSimulator::set_on_surfaces(const Cluster& cluster, Motion& m) const {
  const std::vector<double> inverse = inverse_masses(cluster);
  std::vector<PressedPair> pairs;
  std::vector<std::uint8_t> into(cluster.bonds.size());
  const auto look = [&](bool at_speeds) {
    pairs.clear();
    for (std::size_t c = 0; c < cluster.bonds.size(); ++c) {
      const Bond& bond = cluster.bonds[c];
      if (at_speeds && !bond.presses && !into[c]) continue;
      const std::uint32_t ka = local_[bond.a], kb = world_.is_body(bond.b) ? local_[bond.b] : PressedPair::none;
      const bool body = kb != PressedPair::none;
      const Vec3 xb = body ? m.end_x[kb] : world_.fixed_position(bond.b);
      const Touch there = touch(world_, bond.a, m.end_x[ka], bond.b, xb, bond.feature);
      if (!bond.presses) {
        into[c] = into[c] || there.gap < 0;
        const double rate = there.normal.dot((body ? m.end_v[kb] : Vec3(Vec3::Zero())) - m.end_v[ka]);
        if (!into[c] || (at_speeds && rate >= 0)) continue;
      }
      pairs.push_back({ka, kb, there.normal, at_speeds ? 0 : -there.gap, 0, 0});
    }
  };
  for (int pass = 0; pass < 2; ++pass) {  // Newton's method: the second finds what the first one's curvature left
    look(false);
    std::vector<Vec3> way(m.end_x.size(), Vec3::Zero());
    hold(inverse, way, pairs);
    for (std::size_t k = 0; k < way.size(); ++k) m.end_x[k] += way[k];
  }
  look(true);
  hold(inverse, m.end_v, pairs);
}

/// Carries a cluster on for `length` (s) from motion.x, motion.v.
void SteppedSimulator::move(const Cluster& cluster, double length, Motion& m) const {
  m.end_x = m.x;
  m.end_v = m.v;
  m.path.resize(m.x.size());
  std::vector<PressedPair> pairs;
  take_step(
      options_.integrator, length, m.x, m.v,
      [&](const std::vector<Vec3>& x, const std::vector<Vec3>& v, std::vector<Vec3>& a) {
        accelerate(cluster, x, v, a, pairs);
      },
      m.end_x, m.end_v, m.path);
  set_on_surfaces(cluster, m);
}

/// A cluster's state where its paths begin. Its members have their places in local_ until forget().
SteppedSimulator::Motion SteppedSimulator::gather(const Cluster& cluster) const {
  Motion m;
  for (const Entity i : cluster.members) {
    local_[i] = static_cast<std::uint32_t>(m.x.size());
    m.x.push_back(x_[i]);
    m.v.push_back(v_[i]);
  }
  return m;
}

/// A cluster goes on together. Two that only touch and come to press on the way are held from the first.
void SteppedSimulator::begin_paths(Cluster& cluster) {
  Motion m = gather(cluster);
  const double length = length_ - start_[cluster.members.front()];
  move(cluster, length, m);
  if (std::any_of(cluster.bonds.begin(), cluster.bonds.end(), [](const Bond& bond) { return !bond.presses; }))
    hold_more(cluster, length, m);
  for (std::size_t k = 0; k < cluster.members.size(); ++k) {
    const Entity i = cluster.members[k];
    path_[i] = m.path[k];
    end_x_[i] = m.end_x[k];
    end_v_[i] = m.end_v[k];
  }
}

/// Of those in contact that nothing presses where the path begins: holds the ones that the path leads into each other
/// and that do press at its end.
void SteppedSimulator::hold_more(Cluster& cluster, double length, Motion& m) const {
  std::vector<Bond*> held;
  for (Bond& bond : cluster.bonds) {
    if (bond.presses) continue;
    const Path& pa = m.path[local_[bond.a]];
    const Vec3 xb = world_.is_body(bond.b) ? m.path[local_[bond.b]].position(length) : world_.fixed_position(bond.b);
    const double gap = touch(world_, bond.a, pa.position(length), bond.b, xb, bond.feature).gap;
    if (gap >= -1e-12 * world_.radius[bond.a]) continue;
    bond.presses = true;
    held.push_back(&bond);
  }
  if (held.empty()) return;
  move(cluster, length, m);
  std::vector<PressedPair> pairs;
  std::vector<Vec3> a(m.x.size());
  accelerate(cluster, m.end_x, m.end_v, a, pairs);
  std::size_t k = 0;
  bool pulls = false;
  for (Bond& bond : cluster.bonds) {
    if (!bond.presses) continue;
    const bool pull = pairs[k++].force < 0;
    if (!pull || std::find(held.begin(), held.end(), &bond) == held.end()) continue;
    bond.presses = false;
    pulls = true;
  }
  if (pulls) move(cluster, length, m);
}

/// Carries body i, which is alone, to `time` (s, since the step's start), where its path ends.
void SteppedSimulator::bring(Entity i, double time) {
  Vec3 x = x_[i], v = v_[i];
  Path path;
  take(i, time - start_[i], x, v, path);
  cut(i, time, x, v);
}

/// Ends body i's path at x and v. J: the work on it that was booked.
double SteppedSimulator::cut(Entity i, double time, const Vec3& x, const Vec3& v) {
  double work = 0;
  if (time > start_[i]) {
    pieces_.push_back({i, start_[i], time, path_[i], v, in_company(i)});
    if (works_) work = book_work(i, x, v, time - start_[i]);
  }
  x_[i] = x;
  v_[i] = v;
  start_[i] = time;
  origin_[i] = {};
  ++version_[i];
  return work;
}

/// Books what forces without a potential did on the way of `length` (s) to x and v (J): by Simpson's rule, with the
/// middle of Hermite's polynomial through both ends.
double SteppedSimulator::book_work(Entity i, const Vec3& x, const Vec3& v, double length) {
  if (length == 0) return 0;
  const auto power = [&](const Vec3& at, const Vec3& speed) {
    return world_.mass[i] * working_acceleration(world_, i, from_, at, speed).dot(speed);
  };
  const Vec3 middle_x = 0.5 * (x_[i] + x) + (length / 8) * (v_[i] - v);
  const Vec3 middle_v = (1.5 / length) * (x - x_[i]) - 0.25 * (v_[i] + v);
  const double work = length / 6 * (power(x_[i], v_[i]) + 4 * power(middle_x, middle_v) + power(x, v));
  work_.add(work);
  tally_.work = work_.value();
  return work;
}

}  // namespace carom
