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
#include "physics/whole.h"
#include "simulate/stepped_simulator.h"

namespace carom {

namespace {

constexpr std::uint8_t patience = 8;        // steps without contact, then a body leaves the crowd
constexpr double near_enough = 1e-3;        // of a radius: a gap over which fast bodies strike
constexpr int few_sweeps = 15;              // for velocities; what they leave undone the next step, which starts there,
constexpr int most_sweeps = 300;            // does; the calmer the crowd the more
constexpr int way_sweeps = 200;             // these decide on overlap
constexpr double quiet = 2e-3;              // of the speed of falling by a radius: there sweeps get nowhere,
constexpr int polishing = 400;              // but another solver does, in as many iterations
constexpr std::size_t most_polished = 200;  // pairs for which that is always worth it,
constexpr std::size_t most_parted = 2000;   // or where they are to part,
constexpr int much_polishing = 1000;        // as between light bodies and heavy ones,
constexpr std::size_t most_direct = 1000;   // and for which a third one is that gets there always
constexpr double calm = 1e-3;               // of the speed of falling by a radius: slower bodies may be at rest
constexpr double most_gain = 1e-6;          // of kinetic energy, by what is left undone
constexpr double least_slack = 1e-8;        // of a radius: by how much bodies may overlap,
constexpr double most_slack = 1e-3;         // and where that is hard to achieve, or
constexpr double shorter = 0.5;             // of a step's way is above that

}  // namespace

/// Takes body i into the crowd, from the next step on.
void SteppedSimulator::join(Entity i) {
  crowd_[i] = patience;
}

/// Body i has met one of the crowd, e: it goes along with it to the step's end, or to whom it meets on that way, and
/// keeps its own velocity for later, or the one that the crowd has given it.
void SteppedSimulator::park(Entity i, Entity e) {
  const double length = length_ - start_[i];
  const Vec3 along = in_crowd_[i] ? Vec3(Vec3::Zero()) : path_of(e, start_[i]).v;
  if (!in_crowd_[i]) end_v_[i] = v_[i];
  host_[i] = in_crowd_[i] ? i : e;  // it has stopped for good
  path_[i] = {x_[i], along, Vec3::Zero(), Vec3::Zero()};
  end_x_[i] = path_[i].position(length);
  in_crowd_[i] = 1;
  join(i);
}

/// Sees to it that a member is known to all that it can meet at this haste (m/s), whichever way.
void SteppedSimulator::look_around(Entity i, double haste) {
  path_[i] = {x_[i], Vec3(haste, haste, haste), Vec3::Zero(), Vec3::Zero()};
  stay_known(i);
}

/// Who is of the crowd in this step: those that were, and whom they may meet. The others have paths as if nobody met.
std::vector<Entity> SteppedSimulator::find_crowd() {
  std::vector<Entity> members;
  for (const Entity i : awake_)
    if (crowd_[i] > 0) members.push_back(i);
  for (const Entity i : members) {
    in_crowd_[i] = 1;
    look_around(i, v_[i].norm() + length_ * free_acceleration(i, x_[i], v_[i]).norm());
  }
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

void Crowd::clear() {
  members.clear();
  x.clear();
  v.clear();
  pull.clear();
  inverse_mass.clear();
  haste.clear();
  known.clear();
  contacts.clear();
  carried = 0;
  smallest = never;
  pulls = 0;
}

void Crowd::add(Entity i, const Vec3& at, const Vec3& velocity, const Vec3& acceleration, double mass, double radius) {
  members.push_back(i);
  x.push_back(at);
  v.push_back(velocity);
  pull.push_back(acceleration);
  inverse_mass.push_back(1 / mass);
  haste.push_back(velocity.norm());
  known.push_back(-never);
  smallest = std::min(smallest, radius);
  pulls = std::max(pulls, acceleration.norm());
}

/// Finds who may come into contact in the step, at these hastes, of those that are not known yet.
void SteppedSimulator::find_contacts(Crowd& crowd) const {
  const double drop = crowd.pulls * length_ * length_;
  const bool balls = world_.volume.empty();
  for (std::size_t k = 0; k < crowd.members.size(); ++k) {
    if (crowd.haste[k] == crowd.known[k]) continue;
    const Entity i = crowd.members[k];
    const std::size_t first = crowd.contacts.size();
    for (const Entity e : neighbours_.near(i)) {
      const bool body = world_.is_body(e);
      if (body && !crowd.part) {  // most are not in reach
        const double reach = spot_[i].reach + spot_[e].reach;
        if ((spot_[e].x - crowd.x[k]).squaredNorm() > reach * reach) continue;
      }
      const bool member = body && local_[e] < crowd.members.size() && crowd.members[local_[e]] == e;
      if (body && !member && !crowd.part) continue;
      const std::uint32_t other = member ? local_[e] : PressedPair::none;
      if (member && e < i && crowd.haste[other] != crowd.known[other]) continue;  // e has found i
      const Vec3 xe = member ? crowd.x[other] : body ? end_x_[e] : world_.fixed_position(e);
      const double way = length_ * (crowd.haste[k] + (member ? crowd.haste[other] : 0)) + drop;
      const double known = length_ * (crowd.known[k] + (member ? crowd.known[other] : 0)) + drop;
      Touch there;
      if (body && balls) {
        const Vec3 d = xe - crowd.x[k];
        const double s = world_.radius[i] + world_.radius[e], square = d.squaredNorm();
        if (square > (s + way) * (s + way)) continue;
        const double distance = std::sqrt(square);
        there = {distance - s, distance > 0 ? Vec3(d / distance) : Vec3(Vec3::UnitY()), xe, 0};
      } else {
        there = touch(world_, i, crowd.x[k], e, xe);
      }
      if (!(there.gap <= way) || there.gap <= known) continue;
      const double approach = there.normal.dot(crowd.v[k] - (member ? crowd.v[other] : Vec3(Vec3::Zero())));
      if (member && e < i)
        crowd.contacts.push_back(
            {e, i, other, static_cast<std::uint32_t>(k), Vec3(-there.normal), there.gap, approach});
      else
        crowd.contacts.push_back({i, e, static_cast<std::uint32_t>(k), other, there.normal, there.gap, approach});
    }
    // Lists of neighbours are in no order that results may depend on.
    std::sort(crowd.contacts.begin() + static_cast<std::ptrdiff_t>(first), crowd.contacts.end(),
              [](const CrowdContact& p, const CrowdContact& q) { return std::pair(p.a, p.b) < std::pair(q.a, q.b); });
  }
  crowd.known = crowd.haste;
}

/// By sweeps, and, of few pairs or where asked for, by iterations of the other solver.
bool SteppedSimulator::solve(Crowd& crowd, std::vector<Vec3>& u, int sweeps, int iterations) {
  const bool few = crowd.pairs.size() <= most_polished;
  if (few) {
    sweeps = way_sweeps;
    iterations = much_polishing;
  }
  const std::vector<Vec3> free = iterations > 0 ? u : std::vector<Vec3>{};
  if (crowd.sweeps.press_apart(crowd.inverse_mass, u, crowd.pairs, sweeps)) return true;
  if (iterations == 0) return false;
  u = free;
  if (press_apart(crowd.inverse_mass, u, crowd.pairs, iterations)) return true;
  if (crowd.pairs.size() > most_direct) return false;
  u = free;
  return press_apart_directly(crowd.inverse_mass, u, crowd.pairs);
}

/// The crowd's velocities at the step's end.
void SteppedSimulator::find_velocities(Crowd& crowd) {
  const double h = length_, slack = 2 * way_slack(crowd);
  const double tired = std::clamp(0.1 * unrest_, 1e-5, 0.05) * crowd.pulls * h;
  crowd.pairs.clear();
  crowd.which.clear();
  for (std::size_t c = 0; c < crowd.contacts.size(); ++c) {
    CrowdContact& contact = crowd.contacts[c];
    contact.restitution = pair_restitution(world_, contact.a, contact.b);
    tally_.max_overlap = std::max(tally_.max_overlap, -contact.gap);
    const bool fast =
        2 * contact.restitution * contact.approach > crowd.pulls * h && contact.approach > options_.rest_speed;
    // Farther apart than they fall in a step: whoever is pushed across that strikes in a later one.
    if (!fast && contact.gap > slack + crowd.pulls * h * h) continue;
    double target = -std::max(contact.gap - slack, 0.0) / h;
    if (fast) {
      if (contact.gap > near_enough * crowd.smallest) continue;  // it has not come yet
      contact.strikes = true;
      target = contact.restitution * contact.approach;
    }
    crowd.pairs.push_back({contact.of_a, contact.of_b, contact.normal, target,
                           tired + 1e-2 * std::max(contact.approach, 0.0), known_force(contact.a, contact.b) * h});
    crowd.which.push_back(c);
  }
  crowd.moved = crowd.v;
  for (std::size_t k = 0; k < crowd.moved.size(); ++k) crowd.moved[k] += h * crowd.pull[k];
  // In shorter steps less is to be done, as they start nearer to where they go.
  const double share = std::min(25 * h * std::sqrt(crowd.pulls / crowd.smallest), 1.0);
  const bool tell = unrest_ < quiet;
  const double sweeps = std::clamp(2 * share / unrest_, 1.0 * few_sweeps, 1.0 * most_sweeps);
  const int iterations = tell ? static_cast<int>(whole_below(std::ceil(polishing * share))) : 0;
  const std::vector<Vec3> free = crowd.moved;
  solve(crowd, crowd.moved, tell ? few_sweeps : static_cast<int>(whole_below(sweeps)), iterations);
  // Who is struck from two sides at once cannot always part from both: then nobody bounces in this step.
  bool lively = false;
  for (const CrowdContact& contact : crowd.contacts) lively = lively || (contact.strikes && contact.restitution > 1);
  double before = 0, after = 0;
  for (std::size_t k = 0; k < free.size(); ++k) {
    before += free[k].squaredNorm() / crowd.inverse_mass[k];
    after += crowd.moved[k].squaredNorm() / crowd.inverse_mass[k];
  }
  if (after > (1 + most_gain) * before && !lively) {
    crowd.moved = free;
    for (PressedPair& pair : crowd.pairs) {
      pair.target = std::min(pair.target, 0.0);
      pair.force = 0;
    }
    solve(crowd, crowd.moved, most_sweeps, iterations);
  }
  for (std::size_t c = 0; c < crowd.pairs.size(); ++c) crowd.contacts[crowd.which[c]].impulse = crowd.pairs[c].force;
}

/// m: by how much bodies may overlap, for a step or two: ever less, as long as sweeps achieve that. What gap they are
/// left with by that is as good as none.
double SteppedSimulator::way_slack(const Crowd& crowd) const {
  return slack_ * crowd.smallest;
}

/// The crowd's ways to the step's end.
void SteppedSimulator::find_ways(Crowd& crowd) {
  const double h = length_, slack = way_slack(crowd) / h;
  crowd.way.resize(crowd.v.size());
  for (std::size_t k = 0; k < crowd.v.size(); ++k) crowd.way[k] = 0.5 * (crowd.v[k] + crowd.moved[k]);
  crowd.pairs.clear();
  for (const CrowdContact& contact : crowd.contacts)
    crowd.pairs.push_back({contact.of_a, contact.of_b, contact.normal, -contact.gap / h, slack, 0});
  crowd.told = solve(crowd, crowd.way, way_sweeps, crowd.pairs.size() <= most_parted ? much_polishing : 0);
}

double SteppedSimulator::known_force(Entity a, Entity b) const {
  for (const Pressed& p : pressed_[a])
    if (p.partner == b) return p.force;
  return 0;
}

/// A step of all the crowd. Its members' paths are straight.
void SteppedSimulator::step_crowd() {
  Crowd& crowd = now_;
  for (const Entity i : find_crowd()) {
    local_[i] = static_cast<std::uint32_t>(crowd.members.size());
    crowd.add(i, x_[i], v_[i], free_acceleration(i, x_[i], v_[i]), world_.mass[i], world_.radius[i]);
  }
  const std::size_t n = crowd.members.size();
  if (n == 0) return;
  const double h = length_;
  // Pushed aside, one may go farther than was looked for others to meet: looked again, then.
  const auto look = [&] {
    for (std::size_t k = 0; k < n; ++k)
      if (crowd.haste[k] != crowd.known[k]) look_around(crowd.members[k], crowd.haste[k] + crowd.pulls * h);
    find_contacts(crowd);
  };
  for (std::size_t k = 0; k < n; ++k) crowd.haste[k] += h * crowd.pulls;  // as fast as it may become by itself
  look();
  find_velocities(crowd);
  for (std::size_t k = 0; k < n; ++k) crowd.haste[k] = std::max(crowd.haste[k], crowd.moved[k].norm());
  for (int pass = 0; pass < 4; ++pass) {
    look();
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
  crowd.pressed.assign(n, 0);
  for (const Entity i : crowd.members) pressed_[i].clear();
  for (const CrowdContact& contact : crowd.contacts) {
    if (!(contact.impulse > 0)) continue;
    crowd.pressed[contact.of_a] = 1;
    if (contact.of_b != PressedPair::none) crowd.pressed[contact.of_b] = 1;
    pressed_[contact.a].push_back({contact.b, contact.impulse / h});
  }
  record_strikes(crowd);
  double unrest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Entity i = crowd.members[k];
    Vec3 &moved = crowd.moved[k], &way = crowd.way[k];
    if (!crowd.pressed[k] && constant_) {  // stopped short at most: as fast as it has fallen
      const double fell = 2 * h * crowd.pull[k].dot(way), before = crowd.v[k].squaredNorm();
      const double after = std::max(before + fell, 0.0), now = moved.squaredNorm();
      if (now > 0) moved *= std::sqrt(after / now);
    }
    path_[i] = {x_[i], way, Vec3::Zero(), Vec3::Zero()};
    end_x_[i] = path_[i].position(h);
    end_v_[i] = moved;
    crowd_[i] = crowd.pressed[k] ? patience : static_cast<std::uint8_t>(crowd_[i] - 1);
    const double speed = std::max(way.norm(), moved.norm());
    unrest += speed / std::sqrt(crowd.pulls * world_.radius[i]);
    calm_[i] = crowd.pressed[k] && speed * speed < calm * calm * crowd.pulls * world_.radius[i] ? calm_[i] + 1 : 0;
  }
  unrest_ = crowd.pulls > 0 ? unrest / static_cast<double>(n) : 1;
  const double far = shorter * unrest_ * h * std::sqrt(crowd.pulls / crowd.smallest);
  slack_ = std::clamp((crowd.told ? 0.9 : 1.2) * slack_, std::clamp(far, least_slack, most_slack), most_slack);
  put_to_rest(crowd);
  std::vector<std::uint8_t> carried(n);
  for (const CrowdContact& c : crowd.contacts) {
    if (!carries(c)) continue;
    carried[c.of_a] = 1;
    if (c.of_b != PressedPair::none) carried[c.of_b] = 1;
  }
  crowd.carried = static_cast<std::size_t>(std::count(carried.begin(), carried.end(), 1));
  tally_.resting += crowd.carried;
}

/// The impacts of the crowd's step.
void SteppedSimulator::record_strikes(const Crowd& crowd) {
  for (const CrowdContact& c : crowd.contacts) {
    if (!c.strikes || !(c.impulse > 0)) continue;
    const bool body = c.of_b != PressedPair::none;
    const Vec3 w = (body ? crowd.moved[c.of_b] : Vec3(Vec3::Zero())) - crowd.moved[c.of_a];
    const double ma = world_.mass[c.a], mb = body ? world_.mass[c.b] : never;
    const double separation = std::max(c.normal.dot(w), 0.0);
    record({from_, body ? CollisionKind::body_body : CollisionKind::body_fixed, c.a, c.b,
            touch(world_, c.a, x_[c.a], c.b, position_of(c.b)).point, c.normal, c.approach, separation, c.restitution,
            c.impulse, impact_loss(ma, mb, c.approach, separation)});
  }
}

}  // namespace carom
