// How a crowd comes to rest.
#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/complementarity.h"
#include "simulate/parts.h"
#include "simulate/stepped_simulator.h"

namespace carom {

namespace {

constexpr std::uint32_t calm_steps = 8;    // that a part has been calm for before it is looked at
constexpr double first_drive = 1e-3;       // of a radius: how far bodies would sink if nothing held them, at first
constexpr double last_drive = 1;           // and at last, of a part that hardly sinks,
constexpr double farthest_sink = 2e-2;     // and how far it may in all,
constexpr int balance_passes = 12;         // and in how many times,
constexpr double balanced = 1e-7;          // the last of them no farther than this much of it
constexpr int balance_iterations = 2000;   // of the solver for large parts
constexpr std::size_t most_direct = 4000;  // bodies; the cost of the other one grows as their square

}  // namespace

/// Whether and where forces hold a part of the crowd in balance, close to where it is: it sinks by a little at a time,
/// as far as its contacts let it, until it sinks no more. x: m, in: where it is, out: where it stands, or has sunk to.
/// The impulses of its contacts become forces (N).
SteppedSimulator::Balance SteppedSimulator::find_balance(Crowd& part) {
  const std::size_t n = part.members.size();
  const std::vector<Vec3> from = part.x;
  double drive = first_drive;
  for (int pass = 0; pass < balance_passes; ++pass) {
    part.contacts.clear();
    part.known.assign(n, -never);
    find_contacts(part);
    part.pairs.clear();
    for (const CrowdContact& c : part.contacts)
      part.pairs.push_back({c.of_a, c.of_b, c.normal, -c.gap, 1e-10 * part.smallest, 0});
    std::vector<Vec3> way(n);
    for (std::size_t k = 0; k < n; ++k) way[k] = drive * part.smallest / part.pulls * part.pull[k];
    const bool told = n <= most_direct ? press_apart_directly(part.inverse_mass, way, part.pairs)
                                       : press_apart(part.inverse_mass, way, part.pairs, balance_iterations);
    if (!told) return Balance::none;
    double farthest = 0;
    for (std::size_t k = 0; k < n; ++k) {
      part.x[k] += way[k];
      farthest = std::max(farthest, way[k].norm());
      if ((part.x[k] - from[k]).norm() > farthest_sink * part.smallest) return Balance::none;
    }
    if (farthest <= balanced * drive * part.smallest) {
      const double per_way = part.pulls / (drive * part.smallest);  // 1/s^2
      for (std::size_t p = 0; p < part.pairs.size(); ++p) part.contacts[p].impulse = per_way * part.pairs[p].force;
      return Balance::found;
    }
    if (farthest < 0.1 * first_drive * part.smallest) drive = std::min(10 * drive, last_drive);
  }
  return Balance::sinking;
}

/// Parts of the crowd that have hardly moved for a while sink to where forces hold them in balance, and fall asleep
/// there.
void SteppedSimulator::put_to_rest(const Crowd& crowd) {
  const std::size_t n = crowd.members.size();
  if (std::none_of(crowd.members.begin(), crowd.members.end(), [&](Entity i) { return calm_[i] >= calm_steps; }))
    return;
  Parts joined(n);
  for (const CrowdContact& c : crowd.contacts) {
    const bool touch = c.impulse > 0 || c.gap < 2 * first_drive * crowd.smallest;
    if (touch && c.of_b != PressedPair::none) joined.join(c.of_a, c.of_b);
  }
  std::vector<std::vector<std::uint32_t>> parts(n);  // by root
  for (std::uint32_t k = 0; k < n; ++k) parts[joined.root(k)].push_back(k);
  for (const std::vector<std::uint32_t>& members : parts) {
    std::uint32_t since = std::numeric_limits<std::uint32_t>::max();
    for (const std::uint32_t k : members) since = std::min(since, calm_[crowd.members[k]]);
    if (members.empty() || since < calm_steps) continue;
    // Looked at in vain it is left alone for a while, longer each time.
    std::uint32_t& wait = patience_[crowd.members[members.front()]];
    if (since % (calm_steps << wait) != 0) continue;
    Crowd part;
    part.part = true;
    for (const std::uint32_t k : members) {
      const Entity i = crowd.members[k];
      local_[i] = static_cast<std::uint32_t>(part.members.size());
      part.add(i, end_x_[i], Vec3::Zero(), crowd.pull[k], world_.mass[i], world_.radius[i]);
    }
    part.pulls = crowd.pulls;
    part.haste.assign(members.size(), 4 * farthest_sink * part.smallest / length_);
    const Balance balance = find_balance(part);
    wait = balance == Balance::none ? std::min(wait + 1, 10u) : 0;
    if (balance == Balance::none) continue;
    stand(part);
    if (balance == Balance::found) fall_asleep(part);
  }
}

/// A part of the crowd stops where it has sunk to.
void SteppedSimulator::stand(const Crowd& part) {
  for (std::size_t k = 0; k < part.members.size(); ++k) {
    const Entity i = part.members[k];
    const Vec3& to = part.x[k];
    end_x_[i] = to;
    end_v_[i].setZero();
    path_[i] = {x_[i], (to - x_[i]) / length_, Vec3::Zero(), Vec3::Zero()};
  }
}

void SteppedSimulator::fall_asleep(const Crowd& part) {
  const std::uint32_t number = new_cluster();
  Cluster& cluster = clusters_[number];
  cluster.asleep = true;
  cluster.members = part.members;
  tally_.resting += part.members.size();
  for (const Entity i : part.members) {
    cluster_of_[i] = number;
    crowd_[i] = 0;
    calm_[i] = 0;
  }
  for (const CrowdContact& c : part.contacts)
    if (c.impulse > 0) cluster.bonds.push_back({c.a, c.b, no_feature, true, c.impulse});
}

}  // namespace carom
