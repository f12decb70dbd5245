// Who meets whom in a step.
#include <algorithm>
#include <cmath>

#include "physics/path_meeting.h"
#include "simulate/stepped_simulator.h"

namespace carom {

namespace {

constexpr double looks_ahead = 32;  // steps for which a region is to last

/// How far a path may be from where it begins after `length` (s), along each axis.
Vec3 reach_of(const Path& p, double length) {
  return length * (p.v.cwiseAbs() + 0.5 * length * (p.a.cwiseAbs() + length / 3 * p.j.cwiseAbs()));
}

}  // namespace

/// Sees to it that body i is known to all that it can meet on its path.
void SteppedSimulator::stay_known(Entity i) {
  const Path& path = path_[i];
  const double length = length_ - start_[i];
  const double far = reach_of(path, length).norm();
  const double rounding = 0x1p-48 * (path.x.cwiseAbs().maxCoeff() + world_.radius[i]);
  spot_[i] = {path.x, world_.radius[i] + far + rounding};
  if (length > 0) goes_ = std::max(goes_, far * (length_ / length));
  if ((path.x - neighbours_.center(i)).norm() + far <= neighbours_.room(i)) return;
  neighbours_.cover(i, path.x, far, looks_ahead * length_ * v_[i]);
}

Path SteppedSimulator::path_of(Entity e, double time) const {
  if (!world_.is_body(e)) return {world_.fixed_position(e), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  return path_[e].from(time - start_[e]);
}

bool SteppedSimulator::bound(Entity a, Entity b) const {
  if (cluster_of_[a] == none) return false;
  const std::vector<Bond>& bonds = clusters_[cluster_of_[a]].bonds;
  return std::any_of(bonds.begin(), bonds.end(),
                     [&](const Bond& bond) { return bond.a == std::min(a, b) && bond.b == std::max(a, b); });
}

/// Finds whom body i meets first of each of its neighbours. all: else only those that do not find it themselves. Those
/// that go with the crowd have been kept clear of one another, and are found by the others, but for those that sleep.
void SteppedSimulator::predict(Entity i, bool all) {
  const auto with_crowd = [&](Entity e) { return in_crowd_[e] && host_[e] == no_entity; };
  const bool sleepers_only = !all && with_crowd(i);
  if (sleepers_only && !some_sleep_) return;
  if (!all && !neighbours_.has_news(i) && gone_ + goes_ < alone_until_[i]) return;
  const auto sleeps = [&](Entity e) { return cluster_of_[e] != none && clusters_[cluster_of_[e]].asleep; };
  const Spot here = spot_[i];
  double nearest = never;
  for (const Entity e : neighbours_.near(i)) {
    if (!world_.is_body(e)) {
      const double clear = touch(world_, i, here.x, e, world_.fixed_position(e)).gap + world_.radius[i] - here.reach;
      nearest = std::min(nearest, clear);
      if (clear <= 0 && !sleepers_only) predict_pair(i, e);
      continue;
    }
    const Spot& there = spot_[e];
    const double clear = (there.x - here.x).norm() - (here.reach + there.reach);
    nearest = std::min(nearest, clear);
    if (clear > 0) continue;  // most: what branches foresee comes first
    if (sleepers_only && !sleeps(e)) continue;
    if (!all && e < i && !sleeps(e) && !with_crowd(e)) continue;
    predict_pair(std::min(i, e), std::max(i, e));
  }
  alone_until_[i] = all ? 0 : gone_ + 0.5 * nearest;
}

void SteppedSimulator::predict_pair(Entity a, Entity b) {
  const bool body = world_.is_body(b);
  if (crowded(a) && (!body || crowded(b))) {  // they have kept clear of each other, but for one that came later
    const bool late = (host_[a] != no_entity && host_[a] != b) || (body && host_[b] != no_entity && host_[b] != a);
    if (!late) return;
  }
  const double base = body ? std::max(start_[a], start_[b]) : start_[a], length = length_ - base;
  const Path pa = path_of(a, base), pb = path_of(b, base);
  const bool left = origin_[a].partner == b && (!body || (origin_[b].partner == a && start_[a] == start_[b]));
  if (bound(a, b)) return;
  const Meeting first = meeting(world_, a, pa, b, pb, left ? origin_[a].feature : no_feature, length);
  if (!(first.time <= length)) return;
  events_.push(
      {base + first.time, Kind::impact, a, b, first.feature, version_[a], body ? version_[b] : std::uint32_t{0}});
}

/// Finds when a cluster's contacts end on its path: where the force turns to zero, or where the surface does.
void SteppedSimulator::predict_releases(std::uint32_t c) {
  const Cluster& cluster = clusters_[c];
  Motion m = gather(cluster);
  const double from = start_[cluster.members.front()], length = length_ - from;
  std::vector<PressedPair> pairs;
  std::vector<Vec3> a(m.x.size());
  std::vector<const Bond*> pressing;
  for (const Bond& bond : cluster.bonds)
    if (bond.presses) pressing.push_back(&bond);
  const auto go = [&](double t) {
    move(cluster, t, m);
    accelerate(cluster, m.end_x, m.end_v, a, pairs);
  };
  // N, what is left of a force, and a little: one that is only rounding does not end.
  const auto force_of = [&](std::size_t which) {
    const Bond& bond = *pressing[which];
    const double weight =
        world_.mass[bond.a] * free_acceleration(bond.a, m.x[local_[bond.a]], m.v[local_[bond.a]]).norm();
    return pairs[which].force + 1e-9 * weight;
  };
  const auto force_after = [&](double t, std::size_t which) {
    go(t);
    return force_of(which);
  };
  const auto feature_now = [&](std::size_t which) {
    const Bond& bond = *pressing[which];
    const Vec3 xb = world_.is_body(bond.b) ? m.end_x[local_[bond.b]] : world_.fixed_position(bond.b);
    return touch(world_, bond.a, m.end_x[local_[bond.a]], bond.b, xb).feature;
  };
  const auto feature_after = [&](double t, std::size_t which) {
    move(cluster, t, m);
    return feature_now(which);
  };
  std::vector<double> first(pressing.size()), last(pressing.size());  // N
  std::vector<std::uint8_t> feature_last(pressing.size());
  go(0);
  for (std::size_t k = 0; k < pressing.size(); ++k) first[k] = force_of(k);
  go(length);
  for (std::size_t k = 0; k < pressing.size(); ++k) {
    last[k] = force_of(k);
    feature_last[k] = world_.is_plane(pressing[k]->b) ? pressing[k]->feature : feature_now(k);
  }
  for (std::size_t k = 0; k < pressing.size(); ++k) {
    const Bond& bond = *pressing[k];
    double ends = never;
    std::uint8_t beyond = bond.feature;
    if (double low = 0, high = length, at_low = first[k], at_high = last[k]; at_low > 0 && at_high < 0) {
      // Regula falsi, the Illinois way.
      for (int pass = 0; pass < 60 && high - low > 0x1p-40 * length; ++pass) {
        const double t = high - (high - low) * at_high / (at_high - at_low);
        const double at = force_after(t, k);
        if (at < 0) {
          high = t;
          at_high = at;
          at_low *= 0.5;
        } else {
          low = t;
          at_low = at;
          at_high *= 0.5;
        }
        if (at == 0) break;
      }
      ends = high;
    }
    const bool flat_for_ever = world_.is_plane(bond.b);
    if (!flat_for_ever && (ends < never ? feature_after(ends, k) : feature_last[k]) != bond.feature) {
      double low = 0, high = std::min(ends, length);
      while (high - low > 0x1p-48 * length) {
        const double t = 0.5 * (low + high);
        (feature_after(t, k) == bond.feature ? low : high) = t;
      }
      ends = high;
      beyond = feature_after(high, k);
    }
    if (!(ends < never)) continue;
    events_.push({from + ends, Kind::release, bond.a, bond.b, beyond, version_[bond.a],
                  world_.is_body(bond.b) ? version_[bond.b] : std::uint32_t{0}});
  }
}

}  // namespace carom
