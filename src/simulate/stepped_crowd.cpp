// Many bodies that press on one another, or strike each other many times a step: a crowd. It takes its steps as one.
// First come velocities: of all that the step's forces leave, the nearest ones with which touching pairs part, after a
// fast impact at e times their approach, else not approach. Then ways: halfway between the old and the new velocities,
// but for as much as it takes to overlap nobody at the step's end; a body that is stopped short on its way keeps its
// speed, and strikes in the next step. Both are problems of complementarity (Moreau, in Nonsmooth Mechanics and
// Applications, CISM 302 (1988) 1; Stewart & Trinkle, Int. J. Numer. Meth. Eng. 39 (1996) 2673), started from the last
// step's forces. To first order in the step; but a pile of a thousand costs little more than its thousand balls do, and
// the linearised ways of convex bodies are on the safe side: what overlap there is the solver has left.
//
// Who flies into a crowd stops where he meets it and is of it from the next step on. A part of the crowd that hardly
// moves and that forces hold in balance is set on its surfaces and put to sleep.
#include <algorithm>
#include <cmath>

#include "physics/complementarity.h"
#include "physics/force.h"
#include "physics/impact.h"
#include "physics/restitution.h"
#include "physics/sweeps.h"
#include "simulate/stepped_crowd.h"

namespace carom {

namespace {

constexpr std::uint8_t patience = 8;        // steps without contact, then a body leaves the crowd
constexpr double near_enough = 1e-3;        // of a radius: a gap over which fast bodies strike
constexpr int most_sweeps = 200;            // of either problem
constexpr std::size_t most_polished = 200;  // pairs for which there is another solver,
constexpr int polishing = 1000;             // and its iterations
constexpr double calm = 2e-4;               // of the speed of falling by a radius: slower bodies may be at rest
constexpr double least_slack = 1e-8;        // of a radius: by how much bodies may overlap,
constexpr double most_slack = 1e-3;         // and where that is hard to achieve

}  // namespace

/// Takes body i into the crowd, from the next step on.
void SteppedSimulator::join(Entity i) {
  crowd_[i] = patience;
}

/// Body i has met one of the crowd, e: it goes along with it to the step's end, or to whom it meets on that way, and
/// keeps its own velocity for later.
void SteppedSimulator::park(Entity i, Entity e) {
  const double length = length_ - start_[i];
  const Vec3 along = in_crowd_[i] ? Vec3(Vec3::Zero()) : path_of(e, start_[i]).v;
  host_[i] = in_crowd_[i] ? no_entity : e;
  path_[i] = {x_[i], along, Vec3::Zero(), Vec3::Zero()};
  end_x_[i] = path_[i].position(length);
  end_v_[i] = v_[i];
  in_crowd_[i] = 1;
  join(i);
}

/// Who is of the crowd in this step: those that were, and whom they may meet. All have paths as if nobody met.
std::vector<Entity> SteppedSimulator::find_crowd() {
  std::vector<Entity> members;
  for (const Entity i : awake_)
    if (crowd_[i] > 0) members.push_back(i);
  for (const Entity i : members) in_crowd_[i] = 1;
  for (std::size_t k = 0; k < members.size(); ++k) {
    const Entity i = members[k];
    for (const Entity e : neighbours_.near(i)) {
      if (!world_.is_body(e) || in_crowd_[e]) continue;
      const double way = length_ * (v_[i].norm() + v_[e].norm() + length_ * free_acceleration(i, x_[i], v_[i]).norm());
      const double reach = world_.radius[i] + world_.radius[e] + way;
      if ((x_[i] - x_[e]).squaredNorm() > reach * reach) continue;
      if (touch(world_, std::min(i, e), x_[std::min(i, e)], std::max(i, e), x_[std::max(i, e)]).gap > way) continue;
      const std::size_t first = members.size();
      if (cluster_of_[e] != none)
        dissolve(cluster_of_[e], 0, members);
      else
        members.push_back(e);
      for (std::size_t m = first; m < members.size(); ++m) {
        in_crowd_[members[m]] = 1;
        join(members[m]);
      }
    }
  }
  std::sort(members.begin(), members.end());
  return members;
}

/// Pairs that may come into contact in the step.
void SteppedSimulator::find_pairs(Crowd& crowd) const {
  const double drop = crowd.pulls * length_ * length_;
  crowd.pairs.clear();
  crowd.names.clear();
  const bool balls = world_.volume.empty();
  for (std::size_t k = 0; k < crowd.members.size(); ++k) {
    const Entity i = crowd.members[k];
    for (const Entity e : neighbours_.near(i)) {
      const bool body = world_.is_body(e);
      const bool member = body && local_[e] < crowd.members.size() && crowd.members[local_[e]] == e;
      if (member ? e < i : body && !crowd.part) continue;
      const std::uint32_t other = member ? local_[e] : PressedPair::none;
      const Vec3 xe = member ? crowd.x[other] : body ? end_x_[e] : world_.fixed_position(e);
      const double way = length_ * (crowd.haste[k] + (member ? crowd.haste[other] : 0)) + drop;
      Touch there;
      if (body && balls) {
        const Vec3 d = xe - crowd.x[k];
        const double s = world_.radius[i] + world_.radius[e], square = d.squaredNorm();
        if (square > (s + way) * (s + way)) continue;
        const double distance = std::sqrt(square);
        there = {distance - s, distance > 0 ? Vec3(d / distance) : Vec3(Vec3::UnitY()), xe, 0};
      } else {
        there = touch(world_, i, crowd.x[k], e, xe);
        if (there.gap > way) continue;
      }
      const double approach = there.normal.dot(crowd.v[k] - (member ? crowd.v[other] : Vec3(Vec3::Zero())));
      crowd.pairs.push_back({static_cast<std::uint32_t>(k), other, there.normal, 0, 0, 0});
      crowd.names.push_back({i, e, there.gap, approach, 0, false});
    }
  }
}

/// By sweeps; where these get nowhere, as between light bodies and heavy ones, otherwise, if that does not cost too
/// much.
bool SteppedSimulator::solve(const Crowd& crowd, std::vector<Vec3>& u, std::vector<PressedPair>& pairs) const {
  const std::vector<Vec3> free = pairs.size() > most_polished ? std::vector<Vec3>{} : u;
  if (sweep_apart(crowd.inverse_mass, u, pairs, most_sweeps)) return true;
  if (free.empty()) return false;
  u = free;
  return press_apart(crowd.inverse_mass, u, pairs, polishing);
}

/// The crowd's velocities at the step's end.
void SteppedSimulator::find_velocities(Crowd& crowd) {
  find_pairs(crowd);
  const double h = length_;
  std::vector<PressedPair> pairs;
  std::vector<std::size_t> which;
  for (std::size_t c = 0; c < crowd.pairs.size(); ++c) {
    CrowdName& name = crowd.names[c];
    PressedPair pair = crowd.pairs[c];
    name.restitution = pair_restitution(world_, name.a, name.b);
    tally_.max_overlap = std::max(tally_.max_overlap, -name.gap);
    const bool fast = 2 * name.restitution * name.approach > crowd.pulls * h && name.approach > options_.rest_speed;
    if (fast) {
      if (name.gap > near_enough * crowd.smallest) continue;  // it has not come yet
      name.strikes = true;
      pair.target = name.restitution * name.approach;
    } else {
      pair.target = -std::max(name.gap - 2 * way_slack(crowd), 0.0) / h;
    }
    pair.slack = std::clamp(10 * unrest_, 1e-5, 0.05) * crowd.pulls * h + 1e-2 * std::max(name.approach, 0.0);
    pair.force = known_force(name.a, name.b) * h;
    pairs.push_back(pair);
    which.push_back(c);
  }
  crowd.moved = crowd.v;
  for (std::size_t k = 0; k < crowd.moved.size(); ++k) crowd.moved[k] += h * crowd.pull[k];
  crowd.told = solve(crowd, crowd.moved, pairs);
  for (std::size_t c = 0; c < pairs.size(); ++c) crowd.pairs[which[c]].force = pairs[c].force;
}

/// m: by how much bodies may overlap, for a step or two: ever less, as long as sweeps achieve that. What gap they are
/// left with by that is as good as none.
double SteppedSimulator::way_slack(const Crowd& crowd) const {
  return slack_ * crowd.smallest;
}

/// The crowd's ways to the step's end.
void SteppedSimulator::find_ways(Crowd& crowd) {
  const double h = length_;
  crowd.way.resize(crowd.v.size());
  for (std::size_t k = 0; k < crowd.v.size(); ++k) crowd.way[k] = 0.5 * (crowd.v[k] + crowd.moved[k]);
  for (std::size_t c = 0; c < crowd.pairs.size(); ++c) {
    crowd.pairs[c].target = -crowd.names[c].gap / h;
    crowd.pairs[c].slack = way_slack(crowd) / h;
  }
  crowd.told = solve(crowd, crowd.way, crowd.pairs) && crowd.told;
}

double SteppedSimulator::known_force(Entity a, Entity b) const {
  for (const Pressed& p : pressed_[a])
    if (p.partner == b) return p.force;
  return 0;
}

/// A step of all the crowd. Its members' paths are straight.
void SteppedSimulator::step_crowd() {
  Crowd crowd;
  crowd.members = find_crowd();
  const std::size_t n = crowd.members.size();
  if (n == 0) return;
  const double h = length_;
  for (std::size_t k = 0; k < n; ++k) {
    const Entity i = crowd.members[k];
    local_[i] = static_cast<std::uint32_t>(k);
    crowd.x.push_back(x_[i]);
    crowd.v.push_back(v_[i]);
    crowd.pull.push_back(free_acceleration(i, x_[i], v_[i]));
    crowd.inverse_mass.push_back(1 / world_.mass[i]);
    crowd.haste.push_back(v_[i].norm());
    crowd.smallest = std::min(crowd.smallest, world_.radius[i]);
    crowd.pulls = std::max(crowd.pulls, crowd.pull[k].norm());
  }
  find_velocities(crowd);
  std::vector<std::uint8_t> pressed(n);
  const std::vector<PressedPair> forces = std::move(crowd.pairs);  // of this, for the ways need pairs of their own
  const std::vector<CrowdName> names = std::move(crowd.names);
  for (std::size_t k = 0; k < n; ++k) pressed_[crowd.members[k]].clear();
  for (std::size_t c = 0; c < forces.size(); ++c) {
    if (!(forces[c].force > 0)) continue;
    pressed[forces[c].a] = 1;
    if (forces[c].b != PressedPair::none) pressed[forces[c].b] = 1;
    pressed_[names[c].a].push_back({names[c].b, forces[c].force / h});
  }
  for (std::size_t k = 0; k < n; ++k) crowd.haste[k] = std::max(crowd.haste[k], crowd.moved[k].norm());
  // Pushed aside, one may go farther than was looked for others to meet: looked again, then.
  for (int pass = 0; pass < 4; ++pass) {
    for (std::size_t k = 0; k < n; ++k) {
      const double haste = crowd.haste[k];
      path_[crowd.members[k]] = {crowd.x[k], Vec3(haste, haste, haste), Vec3::Zero(), Vec3::Zero()};
      stay_known(crowd.members[k]);
    }
    find_pairs(crowd);
    find_ways(crowd);
    bool farther = false;
    for (std::size_t k = 0; k < n; ++k) {
      const double speed = crowd.way[k].norm();
      if (speed <= crowd.haste[k] + crowd.pulls * h) continue;
      crowd.haste[k] = 2 * speed;
      farther = true;
    }
    if (!farther) break;
  }
  record_strikes(crowd, forces, names);
  double unrest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Entity i = crowd.members[k];
    Vec3 &moved = crowd.moved[k], &way = crowd.way[k];
    if (!pressed[k] && constant_) {  // stopped short at most: as fast as it has fallen
      const double fell = 2 * h * crowd.pull[k].dot(way), before = crowd.v[k].squaredNorm();
      const double after = std::max(before + fell, 0.0), now = moved.squaredNorm();
      if (now > 0) moved *= std::sqrt(after / now);
    }
    path_[i] = {x_[i], way, Vec3::Zero(), Vec3::Zero()};
    end_x_[i] = path_[i].position(h);
    end_v_[i] = moved;
    crowd_[i] = pressed[k] ? patience : static_cast<std::uint8_t>(crowd_[i] - 1);
    const double speed = std::max(way.norm(), moved.norm());
    unrest += h * speed / world_.radius[i];
    calm_[i] = pressed[k] && speed * speed < calm * calm * crowd.pulls * world_.radius[i] ? calm_[i] + 1 : 0;
  }
  unrest_ = unrest / static_cast<double>(n);
  slack_ =
      std::clamp((crowd.told ? 0.9 : 1.2) * slack_, std::clamp(0.1 * unrest_, least_slack, most_slack), most_slack);
  put_to_rest(crowd, forces, names);
}

/// The impacts of the crowd's step.
void SteppedSimulator::record_strikes(const Crowd& crowd, const std::vector<PressedPair>& forces,
                                      const std::vector<CrowdName>& names) {
  for (std::size_t c = 0; c < names.size(); ++c) {
    const CrowdName& name = names[c];
    if (!name.strikes || !(forces[c].force > 0)) continue;
    const PressedPair& p = forces[c];
    const bool body = p.b != PressedPair::none;
    const Vec3 w = (body ? crowd.moved[p.b] : Vec3(Vec3::Zero())) - crowd.moved[p.a];
    const double ma = world_.mass[name.a], mb = body ? world_.mass[name.b] : never;
    const double separation = std::max(p.normal.dot(w), 0.0);
    record({from_, body ? CollisionKind::body_body : CollisionKind::body_fixed, name.a, name.b,
            touch(world_, name.a, x_[name.a], name.b, position_of(name.b)).point, p.normal, name.approach, separation,
            name.restitution, p.force, impact_loss(ma, mb, name.approach, separation)});
  }
}

}  // namespace carom
