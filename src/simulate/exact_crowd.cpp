// The crowd: bodies in lasting contact with one another and with anything that is not flat, where paths have no closed
// form. The crowd moves in steps, all of it together; between steps every body of it flies straight, so that impacts
// with and within it are found and resolved as everywhere else. At a step the velocities are those nearest to what
// gravity alone would make of them that keep every pair apart until the next step (complementarity.h): linearised at
// the nearest points, which for convex bodies on straight paths is on the safe side, so that no step can make an
// overlap. (Stewart & Trinkle, Int. J. Numer. Meth. Eng. 39 (1996) 2673, without friction and with exact impacts.)
//
// While bodies of the crowd are struck they are kept a little apart, so that the small motions a strike sets off wait
// for the next step instead of making thousands of impacts at one instant; as the crowd calms down that gap closes.
// A part of the crowd that forces hold in balance is put to rest: velocities exactly zero, no more steps, until struck.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "physics/complementarity.h"
#include "physics/touch.h"
#include "simulate/exact_simulator.h"

namespace carom {

namespace {

constexpr double step_length = 0.015;  // of the time in which a body falls freely by its own radius
constexpr double way = 0.02;           // of a radius: what the fastest body may go in a step longer than that
constexpr double restless_gap = 4e-4;  // of a radius: what bodies that have just been struck are kept apart
constexpr double calming = 0.5;        // a step leaves of that gap
constexpr std::uint8_t patience = 8;   // steps without a force, then a body leaves the crowd
constexpr double resting_gap = 1e-10;  // of a radius: what calm ones are
constexpr double balanced = 1e-11;     // of gravity: forces whose sum is less hold a body

}  // namespace

/// Keeps count of who rests on something.
void ExactSimulator::carry(Entity i, bool carried) {
  if (carried == (carried_[i] != 0)) return;
  carried_[i] = carried;
  carried ? ++tally_.resting : --tally_.resting;
}

/// Body i belongs to the crowd from now on.
void ExactSimulator::join(Entity i) {
  if (place_[i] == Place::asleep) wake(i);
  if (place_[i] == Place::crowd) return;
  place_[i] = Place::crowd;
  pulled_[i] = now_;
  jostled_[i] = 0;
  if (contacts_[i].count > 0) {
    contacts_[i].count = 0;
    --tally_.resting;
  }
  if (crowd_.empty()) {
    crowd_end_ = now_;
    following_ = false;
    ++tally_.collapses;
  }
  if (following_) crowd_end_ = now_;
  idle_[i] = 0;
  needed_[i] = now_;
  crowd_.push_back(i);
}

/// A body of the crowd has been struck at this speed (m/s): for a while bodies are kept apart by about as much as they
/// could move at that speed until the next step.
void ExactSimulator::stir(Entity i, double approach) {
  if (place_[i] != Place::crowd) return;
  needed_[i] = now_;
  kept_apart_ = std::max(kept_apart_, std::min(0.5 * approach * crowd_step_, restless_gap * world_.radius[i]));
}

/// A struck body and all that rest against one another with it are of the crowd again.
void ExactSimulator::wake(Entity i) {
  std::vector<Entity> todo{i};
  place_[i] = Place::outside;
  while (!todo.empty()) {
    const Entity k = todo.back();
    todo.pop_back();
    carry(k, false);
    join(k);
    const Vec3& x = flight_[k].x;
    for (Entity e : near_[k]) {
      if (!world_.is_body(e) || place_[e] != Place::asleep) continue;
      if (touch(world_, k, x, e, flight_[e].x).gap > 1e-6 * world_.radius[k]) continue;
      place_[e] = Place::outside;
      todo.push_back(e);
    }
  }
}

/// An impact of body i has been taken up. A body pushed to and fro between others would go on so for ever: then all of
/// those that touch one another there are struck at once, each as by e = 0.
void ExactSimulator::jostle(Entity i) {
  constexpr std::uint32_t many = 8;
  if (following_ || place_[i] != Place::crowd || ++jostled_[i] <= many) return;
  std::vector<Entity> cluster{i};
  std::vector<PressedPair> pairs;
  const std::uint32_t unseen = PressedPair::none;
  local_[i] = 0;
  const auto at = [&](Entity k) { return flight_[k].position(now_ - flight_[k].start); };
  for (std::size_t k = 0; k < cluster.size(); ++k) {
    const Entity a = cluster[k];
    const Vec3 x = at(a);
    for (Entity e : near_[a]) {
      const bool body = world_.is_body(e);
      if (body && place_[e] != Place::crowd) continue;
      const Touch there = touch(world_, a, x, e, body ? at(e) : world_.fixed_position(e));
      if (there.gap > 1e-3 * kept_apart_) continue;
      if (body && local_[e] == unseen) {
        local_[e] = static_cast<std::uint32_t>(cluster.size());
        cluster.push_back(e);
      }
      if (!body || local_[e] > k)
        pairs.push_back({static_cast<std::uint32_t>(k), body ? local_[e] : unseen, there.normal});
    }
  }
  for (Entity a : cluster) local_[a] = unseen;
  std::vector<Vec3> before(cluster.size()), after;
  std::vector<double> inverse_mass(cluster.size());
  for (std::size_t k = 0; k < cluster.size(); ++k) {
    const Flight& f = flight_[cluster[k]];
    before[k] = f.velocity(now_ - f.start);
    inverse_mass[k] = 1 / world_.mass[cluster[k]];
  }
  double approach = 0;
  for (const PressedPair& p : pairs)
    approach = std::max(approach, p.normal.dot(before[p.a] - (p.b == unseen ? Vec3(Vec3::Zero()) : before[p.b])));
  for (PressedPair& p : pairs) p.slack = 1e-3 * approach;
  after = before;
  press_apart(inverse_mass, after, pairs, 200);
  std::vector<Entity> changed;
  for (std::size_t k = 0; k < cluster.size(); ++k) {
    const Entity a = cluster[k];
    jostled_[a] = 1;
    if ((after[k] - before[k]).squaredNorm() <= 1e-10 * approach * approach) continue;
    changed.push_back(a);
    lose(0.5 * world_.mass[a] * (before[k] - after[k]).dot(before[k] + after[k]));
    restart(a, at(a), after[k], {});
  }
  for (Entity a : changed) predict(a);
}

void ExactSimulator::step_crowd() {
  std::sort(crowd_.begin(), crowd_.end());
  if (follow_crowd()) return;
  for (Entity i : crowd_) {
    followed_[i].clear();
    if (following_) pulled_[i] = now_;
  }
  following_ = false;
  stride();
}

/// A step of a large crowd.
void ExactSimulator::stride() {
  const std::size_t n = crowd_.size();
  std::vector<Vec3> x(n), v(n), moved(n);
  std::vector<double> inverse_mass(n);
  double smallest = never, fastest_pull = 0, fastest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Entity i = crowd_[k];
    local_[i] = static_cast<std::uint32_t>(k);
    const Flight& f = flight_[i];
    const double t = now_ - f.start;
    x[k] = f.position(t);
    v[k] = f.velocity(t);
    inverse_mass[k] = 1 / world_.mass[i];
    smallest = std::min(smallest, world_.radius[i]);
    fastest = std::max(fastest, v[k].norm());
    fastest_pull = std::max(fastest_pull, pull_[i].norm());
  }
  const double shortest = step_length * std::sqrt(2 * smallest / fastest_pull);
  const double h = fastest_pull == 0 ? way * smallest / std::max(fastest, 0x1p-900)
                                     : std::clamp(way * smallest / fastest, shortest, 8 * shortest);

  const double kept = kept_apart_ = std::max({kept_apart_, 1e-5 * fastest * h, resting_gap * smallest});
  crowd_step_ = h;

  // Who may press on whom before the next step.
  std::vector<PressedPair> pairs;
  std::vector<std::pair<Entity, Entity>> names;
  std::vector<double> gaps;
  for (std::size_t k = 0; k < n; ++k) {
    const Entity i = crowd_[k];
    for (Entity e : near_[i]) {
      const bool body = world_.is_body(e);
      if (body && (e < i || place_[e] != Place::crowd)) continue;
      const std::uint32_t other = body ? local_[e] : PressedPair::none;
      const Touch now = touch(world_, i, x[k], e, body ? x[other] : world_.fixed_position(e));
      const double rate = now.normal.dot((body ? v[other] : Vec3(Vec3::Zero())) - v[k]);
      if (now.gap + h * std::min(rate, 0.0) > kept + 4 * fastest_pull * h * h) continue;
      PressedPair pair{static_cast<std::uint32_t>(k), other, now.normal, -std::max(now.gap - kept, 0.0) / h,
                       0.05 * kept / h};
      for (const Pressed& p : pressed_[i])
        if (p.partner == e) pair.force = p.force * h;
      pairs.push_back(pair);
      names.emplace_back(i, e);
      gaps.push_back(now.gap);
    }
    pressed_[i].clear();
  }
  const Instant end = now_ + h;
  for (std::size_t k = 0; k < n; ++k) moved[k] = v[k] + (end - pulled_[crowd_[k]]) * pull_[crowd_[k]];
  press_apart(inverse_mass, moved, pairs, 1000);

  // Parts that press on one another.
  std::vector<std::uint32_t> part(n);
  std::iota(part.begin(), part.end(), 0u);
  const auto root = [&](std::uint32_t k) {
    while (part[k] != k) k = part[k] = part[part[k]];
    return k;
  };
  std::vector<std::uint8_t> carried(n, 0);
  for (const PressedPair& p : pairs) {
    if (p.force <= 0) continue;
    carried[p.a] = 1;
    if (p.b == PressedPair::none) continue;
    carried[p.b] = 1;
    part[root(p.a)] = root(p.b);
  }
  std::vector<double> speed(n, 0.0);
  for (std::uint32_t k = 0; k < n; ++k) speed[root(k)] = std::max(speed[root(k)], moved[k].norm());

  // At rest: what forces hold in balance, and is hardly moving.
  std::vector<std::uint8_t> rests(n, 0);
  const double still = 16 * resting_gap * smallest / h;
  bool any = false;
  for (std::uint32_t k = 0; k < n; ++k)
    if (root(k) == k && carried[k] && speed[k] <= still) any = true;
  if (any) {
    std::vector<Vec3> a(n);
    for (std::size_t k = 0; k < n; ++k) a[k] = pull_[crowd_[k]];
    std::vector<PressedPair> holding;
    std::vector<std::size_t> which;
    for (std::size_t c = 0; c < pairs.size(); ++c) {
      if (speed[root(pairs[c].a)] > still || gaps[c] > 64 * resting_gap * smallest) continue;
      holding.push_back(pairs[c]);
      holding.back().target = 0;
      holding.back().slack = 1e-13 * fastest_pull;
      holding.back().force = 0;  // from nothing: where forces are not unique, no more than needed
      which.push_back(c);
    }
    press_apart(inverse_mass, a, holding, 20000);
    std::vector<double> pull(n, 0.0);
    for (std::uint32_t k = 0; k < n; ++k) pull[root(k)] = std::max(pull[root(k)], a[k].norm());
    for (std::uint32_t k = 0; k < n; ++k)
      rests[k] = carried[root(k)] && speed[root(k)] <= still && pull[root(k)] <= balanced * fastest_pull;
    for (std::size_t c = 0; c < holding.size(); ++c)
      if (rests[holding[c].a]) pairs[which[c]].force = h * holding[c].force;
  }

  for (std::size_t c = 0; c < pairs.size(); ++c)
    if (pairs[c].force > 0) pressed_[names[c].first].push_back({names[c].second, pairs[c].force / h});
  crowd_end_ = end;
  std::vector<Entity> members;
  members.swap(crowd_);
  for (std::size_t k = 0; k < n; ++k) {
    const Entity i = members[k];
    if (rests[k]) {
      place_[i] = Place::asleep;
      carry(i, true);
      lose(0.5 * world_.mass[i] * v[k].squaredNorm());
      restart(i, x[k], Vec3::Zero(), {});
    } else if ((idle_[i] = carried[k] ? 0 : idle_[i] + 1) < patience) {
      crowd_.push_back(i);
      carry(i, carried[k]);
      pulled_[i] = end;
      jostled_[i] = 0;
      lose(0.5 * world_.mass[i] * (v[k] - moved[k]).dot(v[k] + moved[k]));
      restart(i, x[k], moved[k], {});
    } else {
      place_[i] = Place::outside;
      carry(i, false);
      restart(i, x[k], v[k], {});
    }
  }
  if (crowd_.empty()) crowd_end_ = {never, 0};
  kept_apart_ *= calming;
  for (Entity i : members) local_[i] = PressedPair::none;
  for (std::size_t k = 0; k < n; ++k) predict(members[k]);
}

}  // namespace carom
