// Bodies that press on one another.
#include <algorithm>
#include <cmath>

#include "physics/few_contacts.h"
#include "physics/restitution.h"
#include "simulate/parts.h"
#include "simulate/stepped_simulator.h"

namespace carom {

namespace {

constexpr double closed = 1e-9;        // of a radius: a gap that counts as contact
constexpr double still = 1e-9;         // of the speed of falling by a radius: at rest, if forces are in balance
constexpr double balanced = 1e-9;      // of the greatest acceleration
constexpr std::size_t few_pairs = 32;  // that are told to rounding

/// Moves u until no pair falls short of its target.
void press(std::span<const double> inverse_mass, std::span<Vec3> u, std::vector<PressedPair>& pairs) {
  for (PressedPair& p : pairs) p.force = 0;
  if (pairs.size() <= few_pairs)
    press_few_apart(inverse_mass, u, pairs);
  else if (std::vector<Vec3> free(u.begin(), u.end()); !press_apart(inverse_mass, u, pairs, 2000)) {
    std::copy(free.begin(), free.end(), u.begin());
    press_apart_directly(inverse_mass, u, pairs);
  }
}

}  // namespace

/// Parts a cluster's members, at `time` (s, since the step's start), and adds them to `members`.
void SteppedSimulator::dissolve(std::uint32_t c, double time, std::vector<Entity>& members) {
  Cluster& cluster = clusters_[c];
  const bool asleep = cluster.asleep;
  if (!asleep && time > start_[cluster.members.front()]) {
    Motion m = gather(cluster);
    move(cluster, time - start_[cluster.members.front()], m);
    for (std::size_t k = 0; k < cluster.members.size(); ++k) cut(cluster.members[k], time, m.end_x[k], m.end_v[k]);
  }
  for (const Entity i : cluster.members) {
    if (asleep) {
      if (!is_awake_[i]) awake_.push_back(i);
      is_awake_[i] = 1;
      start_[i] = time;
      const Vec3 zero = Vec3::Zero();
      if (time > 0) pieces_.push_back({i, 0, time, {x_[i], zero, zero, zero}, zero, true});
    }
    ++version_[i];  // what was predicted for the cluster is void, even if it has gone nowhere
    cluster_of_[i] = none;
    members.push_back(i);
  }
  tally_.resting -= cluster.members.size();
  cluster = {};
  unused_.push_back(c);
}

/// Whether a and b touch and neither separate nor strike each other, so that they may be in lasting contact.
bool SteppedSimulator::leans(Entity a, const Vec3& xa, const Vec3& va, Entity b, const Vec3& xb, const Vec3& vb,
                             Touch& there) const {
  const bool body = world_.is_body(b);
  if (body && (xb - xa).cwiseAbs().maxCoeff() > 1.001 * (world_.radius[a] + world_.radius[b])) return false;
  there = touch(world_, a, xa, b, xb);
  const double rounding = 0x1p-50 * (xa.cwiseAbs().sum() + xb.cwiseAbs().sum());
  if (there.gap > std::max(closed * world_.radius[a], rounding)) return false;
  const double pull = std::max(free_acceleration(a, xa, va).norm(), body ? free_acceleration(b, xb, vb).norm() : 0.0);
  const double approach = there.normal.dot(va - vb), noise = 0x1p-44 * (va.norm() + vb.norm() + pull * options_.step);
  if (std::abs(approach) <= noise) return true;
  if (approach < 0) return false;
  return slow(pair_restitution(world_, a, b), approach, pull);
}

/// Adds to the group, all of which is at `time`, who leans on one of it, and so on.
void SteppedSimulator::grow(std::vector<Entity>& group, double time) {
  const auto number = [&](std::size_t from) {
    for (std::size_t k = from; k < group.size(); ++k) local_[group[k]] = static_cast<std::uint32_t>(k);
  };
  number(0);
  const auto in_group = [&](Entity e) { return local_[e] < group.size() && group[local_[e]] == e; };
  for (std::size_t k = 0; k < group.size(); ++k) {
    const Entity i = group[k];
    for (const Entity e : neighbours_.near(i)) {
      if (!world_.is_body(e) || in_group(e) || in_crowd_[e] || crowd_[e] > 0) continue;
      const Path now = path_of(e, time);
      Touch there;
      const bool lean =
          i < e ? leans(i, x_[i], v_[i], e, now.x, now.v, there) : leans(e, now.x, now.v, i, x_[i], v_[i], there);
      if (!lean) continue;
      const std::size_t first = group.size();
      if (cluster_of_[e] != none) {
        dissolve(cluster_of_[e], time, group);
      } else {
        bring(e, time);
        group.push_back(e);
      }
      number(first);
    }
  }
}

/// Finds what of a group of bodies, all at `time` (s, since the step's start), is in lasting contact: among themselves,
/// with fixed things, and with others that lean on them, which join the group. Velocities are changed, as little as
/// kinetic energy tells, so that none of these approach; those whose forces do not hold them together part. `met`: two
/// that have just met, and now part, or are not to: paths may lead two into each other that neither their velocities
/// nor their accelerations do.
void SteppedSimulator::bind(std::vector<Entity>& group, double time, const Event* met, bool parts) {
  if (loaded_ || !parts) {
    grow(group, time);
    std::sort(group.begin(), group.end());  // lists of neighbours are in no order that results may depend on
    const std::vector<Bond> bonds = settle(group, met, parts);
    if (!bonds.empty()) gather_clusters(group, bonds);
  }
  if (!parts) return;
  for (const auto& [i, other] : {std::pair(met->a, met->b), std::pair(met->b, met->a)})
    if (world_.is_body(i)) origin_[i] = {other, met->feature};
}

/// The contacts of a group; takes up what approach is left in them.
std::vector<SteppedSimulator::Bond> SteppedSimulator::settle(const std::vector<Entity>& group, const Event* met,
                                                             bool parts) {
  const auto is_met = [&](Entity a, Entity b) { return met != nullptr && met->a == a && met->b == b; };
  const std::size_t n = group.size();
  for (std::size_t k = 0; k < n; ++k) local_[group[k]] = static_cast<std::uint32_t>(k);
  std::vector<Bond> bonds;
  std::vector<PressedPair> pairs;
  std::vector<std::pair<Entity, Touch>> found;  // of one body, in the order of their numbers
  for (const Entity i : group) {
    found.clear();
    for (const Entity e : neighbours_.near(i)) {
      const bool body = world_.is_body(e);
      if (body && (e < i || local_[e] >= n || group[local_[e]] != e)) continue;
      if (parts && is_met(i, e)) continue;
      Touch there;
      if (!leans(i, x_[i], v_[i], e, position_of(e), velocity_of(e), there)) {
        if (!is_met(i, e)) continue;
        there = touch(world_, i, x_[i], e, position_of(e), met->feature);
      }
      found.emplace_back(e, there);
    }
    std::sort(found.begin(), found.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
    for (const auto& [e, there] : found) {
      bonds.push_back({i, e, there.feature, false, 0});
      pairs.push_back({local_[i], world_.is_body(e) ? local_[e] : PressedPair::none, there.normal, 0, 0, 0});
    }
  }
  if (bonds.empty()) return bonds;
  std::vector<double> inverse_mass(n);
  std::vector<Vec3> v(n), a(n);
  double fastest = 0, pull = 0;
  for (std::size_t k = 0; k < n; ++k) {
    inverse_mass[k] = 1 / world_.mass[group[k]];
    v[k] = v_[group[k]];
    fastest = std::max(fastest, v[k].norm());
  }
  const auto rate = [&](std::size_t c, const std::vector<Vec3>& u) {
    const PressedPair& p = pairs[c];
    return p.normal.dot((p.b == PressedPair::none ? Vec3(Vec3::Zero()) : u[p.b]) - u[p.a]);
  };
  for (PressedPair& p : pairs) p.slack = 0x1p-52 * fastest;
  press(inverse_mass, v, pairs);
  for (std::size_t k = 0; k < n; ++k) {
    const Entity i = group[k];
    if (v[k] == v_[i]) continue;
    lose(0.5 * world_.mass[i] * (v_[i] - v[k]).dot(v_[i] + v[k]));
    v_[i] = v[k];
  }
  const auto keep_if = [&](const auto& keeps) {
    std::size_t kept = 0;
    for (std::size_t c = 0; c < pairs.size(); ++c) {
      if (!keeps(c)) continue;
      pairs[kept] = pairs[c];
      bonds[kept++] = bonds[c];
    }
    pairs.resize(kept);
    bonds.resize(kept);
  };
  for (std::size_t k = 0; k < n; ++k) {
    a[k] = free_acceleration(group[k], x_[group[k]], v[k]);
    pull = std::max(pull, a[k].norm());
  }
  const auto insists = [&](std::size_t c) { return is_met(bonds[c].a, bonds[c].b); };
  keep_if([&](std::size_t c) { return insists(c) || rate(c, v) <= 0x1p-44 * (fastest + pull * options_.step); });
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    const Bond& bond = bonds[c];
    const Vec3 xb = position_of(bond.b);
    const Touch there = touch(world_, bond.a, x_[bond.a], bond.b, xb, bond.feature);
    pairs[c].target = -bending(world_, bond.a, x_[bond.a], bond.b, xb, there, velocity_of(bond.b) - v_[bond.a]);
    pairs[c].slack = 1e-15 * pull;
  }
  press(inverse_mass, a, pairs);
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    bonds[c].presses = pairs[c].force > 0;
    bonds[c].force = pairs[c].force;
  }
  keep_if(
      [&](std::size_t c) { return insists(c) || bonds[c].presses || rate(c, a) - pairs[c].target <= 1e-12 * pull; });
  pulled_ = std::move(a);
  return bonds;
}

std::uint32_t SteppedSimulator::new_cluster() {
  if (unused_.empty()) {
    unused_.push_back(static_cast<std::uint32_t>(clusters_.size()));
    clusters_.emplace_back();
  }
  const std::uint32_t c = unused_.back();
  unused_.pop_back();
  return c;
}

/// Makes clusters of those of the group that bonds bind.
void SteppedSimulator::gather_clusters(const std::vector<Entity>& group, const std::vector<Bond>& bonds) {
  const std::size_t n = group.size();
  Parts parts(n);
  std::vector<std::uint8_t> is_bound(n);
  for (const Bond& bond : bonds) {
    is_bound[local_[bond.a]] = 1;
    if (!world_.is_body(bond.b)) continue;
    is_bound[local_[bond.b]] = 1;
    parts.join(local_[bond.a], local_[bond.b]);
  }
  std::vector<std::uint32_t> cluster(n, none);
  double pull = 0;
  for (const Entity i : group) pull = std::max(pull, free_acceleration(i, x_[i], v_[i]).norm());
  for (std::size_t k = 0; k < n; ++k) {
    if (!is_bound[k]) continue;
    std::uint32_t& c = cluster[parts.root(static_cast<std::uint32_t>(k))];
    if (c == none) {
      c = new_cluster();
      clusters_[c].asleep = true;
    }
    const Entity i = group[k];
    clusters_[c].members.push_back(i);
    cluster_of_[i] = c;
    const double unit = std::sqrt(pull * world_.radius[i]);
    if (!(v_[i].norm() <= still * unit && pulled_[k].norm() <= balanced * pull)) clusters_[c].asleep = false;
  }
  for (const Bond& bond : bonds) clusters_[cluster[parts.root(local_[bond.a])]].bonds.push_back(bond);
  for (std::size_t k = 0; k < n; ++k) {
    const std::uint32_t c = cluster[k];
    if (c == none || clusters_[c].members.empty()) continue;
    Cluster& made = clusters_[c];
    tally_.resting += made.members.size();
    std::sort(made.members.begin(), made.members.end());
    if (!made.asleep && made.members.size() > most_members) {
      std::vector<Entity> members;
      dissolve(c, start_[made.members.front()], members);
      for (const Entity i : members) {
        join(i);
        in_crowd_[i] = 1;
        host_[i] = i;
      }
      continue;
    }
    if (!made.asleep) continue;
    for (const Entity i : made.members) {
      lose(0.5 * world_.mass[i] * v_[i].squaredNorm());
      v_[i].setZero();
      path_[i] = {x_[i], v_[i], Vec3::Zero(), Vec3::Zero()};
      end_x_[i] = x_[i];
      end_v_[i] = v_[i];
    }
  }
}

/// New paths for a group of bodies whose last ones have ended, and whom they meet on them.
void SteppedSimulator::go_on(const std::vector<Entity>& group) {
  std::vector<std::uint32_t> clusters;
  for (const Entity i : group) {
    const std::uint32_t c = cluster_of_[i];
    if (c == none && in_crowd_[i]) {  // too many to go on together: they wait for the step's end
      path_[i] = {x_[i], Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
      end_x_[i] = x_[i];
      end_v_[i] = v_[i];
    } else if (c == none) {
      begin_path(i);
    } else if (std::find(clusters.begin(), clusters.end(), c) == clusters.end()) {
      clusters.push_back(c);
      if (!clusters_[c].asleep) begin_paths(clusters_[c]);
    }
  }
  for (const Entity i : group) stay_known(i);
  for (const Entity i : group) predict(i, true);
  for (const std::uint32_t c : clusters)
    if (!clusters_[c].asleep) predict_releases(c);
}

}  // namespace carom
