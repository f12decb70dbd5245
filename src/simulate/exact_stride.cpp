// Strides: steps of a large crowd. Between two of them whoever is carried flies straight and the others fall freely, so
// that impacts with and within it are found and resolved as everywhere else. At a step slow approaches are taken up at
// once; fast ones are left to be impacts. Then the velocities are those nearest to what gravity alone would make of
// them that keep every pair apart until the next step (complementarity.h): linearised at the nearest points, which for
// convex bodies on straight paths is on the safe side. (Stewart & Trinkle, Int. J. Numer. Meth. Eng. 39 (1996) 2673,
// without friction and with exact impacts.) An impact meets the velocities that bodies have by then, not those that the
// step has given them for its end. A step that ends early gives back what forces would have done in its rest.
//
// While bodies of the crowd are struck they are kept a little apart, so that the small motions a strike sets off wait
// for the next step instead of making thousands of impacts at one instant; as the crowd calms down that gap closes.
// Bodies that touch inside that gap part a little, as far as what slow approaches have lost pays for it.
// A part of the crowd that forces hold in balance is put to rest: velocities exactly zero, no more steps, until struck.
#include <algorithm>
#include <cmath>

#include "physics/complementarity.h"
#include "physics/restitution.h"
#include "physics/touch.h"
#include "simulate/exact_simulator.h"
#include "simulate/parts.h"

namespace carom {

namespace {

constexpr double step_length = 0.04;  // of the time in which a body falls freely by its own radius
constexpr double way = 0.04;          // of a radius: what the fastest body may go in a step longer than that
constexpr double longest = 25;        // of the shortest step
constexpr double fast = 8;            // times slow_speed: at what approach bodies are left to strike each other
constexpr double calming = 0.5;       // a step leaves of the gap that bodies are kept apart
constexpr std::uint8_t patience = 8;  // steps without a force, then a body leaves the crowd
constexpr double nearby = 1e-3;       // of a radius: bodies no farther apart may press before a step ends
constexpr double apart = 1e-3;        // of the way that bodies go in a step: what they are kept apart for it,
constexpr double exactly = 0.05;      // but for this much of that
constexpr double restless = 1e-3;     // of a radius: bodies kept farther apart than this part where they touch
constexpr double quiet = 5e-4;        // of a radius: a crowd that moves less in a step, on average, is told exactly
constexpr std::size_t most_direct = 4000;  // bodies; the cost grows as their square
constexpr double resting_gap = 1e-10;      // of a radius: what calm bodies are kept apart
constexpr double touching = 3e-8;          // of a radius: bodies at rest that are no farther apart may press
constexpr double balanced = 1e-11;         // of gravity: forces whose sum is less hold a body;
constexpr double nearly_balanced = 1e-6;   // more than this, by forces found roughly, and there are none that do
constexpr double sliding = 1e-3;           // of the speed of falling by a radius: strides leave it to slow sliders
constexpr std::uint32_t many_stuck = 8;    // strides on end that jostling ends at once: the slow ones are jammed

/// Whether any of the pairs falls short of its target at these velocities.
bool approaching(const std::vector<Vec3>& v, const std::vector<PressedPair>& pairs) {
  return std::any_of(pairs.begin(), pairs.end(), [&](const PressedPair& p) {
    const Vec3 w = (p.b == PressedPair::none ? Vec3(Vec3::Zero()) : v[p.b]) - v[p.a];
    return p.normal.dot(w) < p.target - p.slack;
  });
}

}  // namespace

/// A step of a large crowd, in numbers of its own: member k is body crowd_[k].
struct ExactSimulator::Stride {
  double length = 0;                             // s
  double smallest = never, pull = 0;             // m, m/s^2: the least radius, the greatest acceleration
  std::vector<Vec3> x, v, moved;                 // m, m/s: now, and velocities from now on; in between:
  std::vector<Vec3> settled;                     // m/s: what contact takes up at once is gone
  std::vector<double> haste;                     // m/s: half of what each member may be moved by
  std::vector<double> inverse_mass;              // 1/kg
  std::vector<PressedPair> pairs;                // who may press on whom before the step ends,
  std::vector<std::pair<Entity, Entity>> names;  // by their names,
  std::vector<double> gaps;                      // m, and how far they are apart now;
  std::vector<std::uint8_t> struck;              // whether contact takes up an approach of theirs at once
  std::vector<std::uint32_t> part;               // by member: one of those that press on one another with it
  std::vector<std::uint8_t> carried, rests;      // by member: something presses on it; it is at rest
};

void ExactSimulator::stride() {
  const std::size_t n = crowd_.size();
  Stride step;
  double fastest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Entity i = crowd_[k];
    local_.write(i) = static_cast<std::uint32_t>(k);
    const Flight& f = flight_[i];
    const double t = now_ - f.start;
    step.x.push_back(f.position(t));
    step.v.push_back(f.velocity(t));
    if (now_ < pulled_[i])  // the last step ends early: what forces do in the time that it had left is to come
      step.v[k] -= (pulled_[i] - now_) * hastened_[i];
    pulled_.write(i) = now_;
    step.inverse_mass.push_back(1 / world_.mass[i]);
    step.smallest = std::min(step.smallest, world_.radius[i]);
    step.pull = std::max(step.pull, pull_[i].norm());
    fastest = std::max(fastest, step.v[k].norm());
  }
  const double shortest = step.pull == 0 ? 0 : step_length * std::sqrt(2 * step.smallest / step.pull);
  stuck_ = crowd_step_ < 0.01 * shortest ? stuck_ + 1 : 0;
  step.length = way * step.smallest / std::max(fastest, 0x1p-900);
  if (step.pull > 0)
    step.length = std::clamp(step.length, shortest, std::clamp(2 * crowd_step_, shortest, longest * shortest));
  step.haste.resize(n);
  for (std::size_t k = 0; k < n; ++k) step.haste[k] = step.v[k].norm();
  for (;;) {
    move_apart(step);
    fastest = 0;
    double way_of_all = 0;
    bool farther = false;  // than was looked for others to meet
    for (std::size_t k = 0; k < n; ++k) {
      const double speed = step.moved[k].norm();
      // A change of speed may take a body less far than speed: impacts find it done from the start.
      fastest = std::max({fastest, speed, 8 * (step.moved[k] - step.settled[k]).norm()});
      way_of_all += step.length * speed;
      if (speed <= 2 * step.haste[k] || 4 * step.length * speed <= nearby * step.smallest) continue;
      step.haste[k] = speed;
      farther = true;
    }
    if (step.pull > 0 && step.length > shortest && fastest * step.length > 2 * way * step.smallest)
      step.length = std::max(0.5 * step.length, shortest);
    else if (!farther || way_of_all > quiet * step.smallest * static_cast<double>(n))
      break;
  }
  find_parts(step);
  put_to_rest(step);
  take_stride(step);
}

/// Who may press on whom before the step ends, and how fast they must part, or may approach, for it.
void ExactSimulator::find_pairs(Stride& step) {
  const std::size_t n = crowd_.size();
  const double h = step.length;
  const auto kept_gap = [&](std::size_t k) {
    return std::max({kept_apart_[crowd_[k]], apart * h * step.v[k].norm(), resting_gap * step.smallest});
  };
  step.pairs.clear();
  step.names.clear();
  step.gaps.clear();
  for (std::size_t k = 0; k < n; ++k) {
    const Entity i = crowd_[k];
    for (Entity e : known_to(i)) {
      const bool asleep = world_.is_body(e) && body_[e].place == Place::asleep;  // as if fixed; if pressed on, it wakes
      const bool body = world_.is_body(e) && !asleep;
      if (body && (e < i || body_[e].place != Place::crowd)) continue;
      const std::uint32_t other = body ? local_[e] : PressedPair::none;
      const Vec3 xe = body ? step.x[other] : asleep ? flight_[e].x : world_.fixed_position(e);
      const Touch there = touch(world_, i, step.x[k], e, xe);
      const double rate = there.normal.dot((body ? step.v[other] : Vec3(Vec3::Zero())) - step.v[k]);
      if (strikes(i, e, -rate / fast, step.pull)) continue;
      const double kept = body ? std::max(kept_gap(k), kept_gap(other)) : kept_gap(k);
      const double haste = step.haste[k] + (body ? step.haste[other] : 0);
      const double reach = std::min(4 * step.pull * h * h, std::max(4 * h * haste, nearby * step.smallest));
      if (there.gap + h * std::min(rate, 0.0) > kept + reach) continue;
      PressedPair pair{static_cast<std::uint32_t>(k),
                       other,
                       there.normal,
                       -std::max(there.gap - kept, 0.0) / h,
                       exactly * kept / h,
                       0};
      // Where all is restless, whom the slack would let strike at once part by as much.
      if (step.pull > 0 && kept > restless * step.smallest && there.gap < exactly * kept &&
          pair_restitution(world_, i, e) < 1)
        pair.target = (exactly * kept - std::max(there.gap, 0.0)) / h;
      for (const Pressed& p : pressed_[i])
        if (p.partner == e) pair.force = p.force * h;
      step.pairs.push_back(pair);
      step.names.emplace_back(i, e);
      step.gaps.push_back(there.gap);
    }
  }
}

/// The velocities that keep every pair apart until the step ends: well enough while all is in motion, for impacts are
/// found in any case, but never so that energy is made.
void ExactSimulator::move_apart(Stride& step) {
  find_pairs(step);
  const std::size_t n = crowd_.size();
  const double h = step.length;
  step.settled = step.v;
  step.struck.assign(step.pairs.size(), 0);
  if (std::vector<PressedPair> impacts = step.pairs; step.pull > 0 && approaching(step.v, impacts)) {
    for (PressedPair& p : impacts) {
      p.target = std::min(p.target, 0.0);
      p.force = 0;
    }
    press_apart(step.inverse_mass, step.settled, impacts, 300);
    for (std::size_t c = 0; c < impacts.size(); ++c) step.struck[c] = impacts[c].force > 0;
  }
  std::vector<Vec3> pulled = step.settled;
  for (std::size_t k = 0; k < n; ++k) pulled[k] += h * pull_[crowd_[k]];
  bool part = std::any_of(step.pairs.begin(), step.pairs.end(), [](const PressedPair& p) { return p.target > 0; });
  for (int attempt = 0; attempt < 8; ++attempt) {
    step.moved = pulled;
    const bool done = press_apart(step.inverse_mass, step.moved, step.pairs, 300);
    if (done && !part) return;
    double before = 0, after = 0, made = 0, lost = 0;  // m, m: the way of all; J, J: now, and by settling
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3 &v = step.settled[k], &moved = step.moved[k];
      before += h * v.norm();
      after += h * moved.norm();
      made += (0.5 * (moved - v).dot(moved + v) - (pulled[k] - v).dot(moved)) / step.inverse_mass[k];
      lost += 0.5 * (step.v[k] - v).dot(step.v[k] + v) / step.inverse_mass[k];
    }
    const bool much = std::min(before, after) > quiet * step.smallest * static_cast<double>(n);
    double parting = 0;  // J
    for (const PressedPair& p : step.pairs) parting += p.force * std::max(p.target, 0.0);
    if (made <= 0 && parting <= lost && (done || much)) return;
    for (PressedPair& p : step.pairs) p.target = std::min(p.target, 0.0);  // the wedged cannot part
    part = false;
  }
  if (n > most_direct) return;
  step.moved = pulled;
  press_apart_directly(step.inverse_mass, step.moved, step.pairs);
}

/// Members that press on one another are a part of the crowd. The faster one of its bodies is, the farther its bodies
/// are kept apart.
void ExactSimulator::find_parts(Stride& step) {
  const std::size_t n = crowd_.size();
  Parts parts(n);
  step.carried.assign(n, 0);
  for (std::size_t c = 0; c < step.pairs.size(); ++c) {
    const PressedPair& p = step.pairs[c];
    if (p.force <= 0 && !step.struck[c]) continue;
    step.carried[p.a] = 1;
    if (p.b == PressedPair::none) continue;
    step.carried[p.b] = 1;
    parts.join(p.a, p.b);
  }
  std::vector<std::uint32_t>& part = step.part;
  part.resize(n);
  for (std::uint32_t k = 0; k < n; ++k) part[k] = parts.root(k);
  std::vector<double> kept(n, resting_gap * step.smallest);
  const auto keep = [&](std::uint32_t k, double gap) { kept[part[k]] = std::max(kept[part[k]], gap); };
  for (std::uint32_t k = 0; k < n; ++k) {
    keep(k, calming * kept_apart_[crowd_[k]]);
    keep(k, apart * step.length * step.moved[k].norm());
  }
  for (const PressedPair& p : step.pairs) {
    const Vec3 w = (p.b == PressedPair::none ? Vec3(Vec3::Zero()) : step.moved[p.b]) - step.moved[p.a];
    const double short_of = step.length * (p.target - p.normal.dot(w));
    if (short_of > 0) keep(p.a, std::min(2 * short_of, restless_gap * step.smallest));
  }
  for (std::uint32_t k = 0; k < n; ++k) kept_apart_.write(crowd_[k]) = kept[part[k]];
}

/// At rest are those parts that hardly move and that forces hold in balance. Slow sliders stop, and whoever is slow
/// where all is jammed.
void ExactSimulator::put_to_rest(Stride& step) {
  const std::size_t n = crowd_.size();
  step.rests.assign(n, 0);
  std::vector<std::uint32_t> members(n, 0);  // by part
  for (std::uint32_t k : step.part) ++members[k];
  std::vector<std::uint8_t> still(n);  // by part
  for (std::uint32_t k = 0; k < n; ++k) still[k] = step.part[k] == k;
  const double unit = std::sqrt(step.pull * step.smallest);
  const double slow = std::max(hardly_moving * unit, 16 * resting_gap * step.smallest / step.length);
  for (std::uint32_t k = 0; k < n; ++k) {
    Vec3& moved = step.moved[k];
    const bool steady = (moved - step.settled[k]).norm() <= 1e-3 * step.length * step.pull;
    const bool alone = members[step.part[k]] == 1;
    if (((steady && alone) || stuck_ > many_stuck) && step.carried[k] && moved.norm() <= sliding * unit)
      moved.setZero();
    if (!step.carried[k] || moved.norm() > slow) still[step.part[k]] = 0;
  }
  if (std::find(still.begin(), still.end(), 1) == still.end()) return;
  std::vector<Vec3> pull(n), a;
  for (std::size_t k = 0; k < n; ++k) pull[k] = pull_[crowd_[k]];
  std::vector<PressedPair> holding;
  std::vector<std::size_t> which;
  // Their forces, from none: where these are not unique, no more than needed.
  const auto press = [&](int iterations) {
    holding.clear();
    which.clear();
    for (std::size_t c = 0; c < step.pairs.size(); ++c) {
      const PressedPair& p = step.pairs[c];
      if (!still[step.part[p.a]] || step.gaps[c] > touching * step.smallest) continue;
      holding.push_back({p.a, p.b, p.normal, 0, 1e-13 * step.pull, 0});
      which.push_back(c);
    }
    a = pull;
    return press_apart(step.inverse_mass, a, holding, iterations);
  };
  const auto keep_balanced = [&](double within) {
    for (std::uint32_t k = 0; k < n; ++k)
      if (!(a[k].norm() <= within * step.pull)) still[step.part[k]] = 0;
  };
  if (!press(300)) {
    if (n <= most_direct) {
      a = pull;
      press_apart_directly(step.inverse_mass, a, holding);
      keep_balanced(nearly_balanced);
    }
    press(20000);
  }
  keep_balanced(balanced);
  for (std::uint32_t k = 0; k < n; ++k) step.rests[k] = still[step.part[k]];
  for (PressedPair& p : step.pairs)
    if (step.rests[p.a]) p.force = 0;
  for (std::size_t c = 0; c < holding.size(); ++c)
    if (step.rests[holding[c].a]) step.pairs[which[c]].force = step.length * holding[c].force;
}

/// The members' flights until the step's end.
void ExactSimulator::take_stride(const Stride& step) {
  const double h = step.length;
  const Instant end = now_ + h;
  for (Entity i : crowd_) pressed_.write(i).clear();
  for (std::size_t c = 0; c < step.pairs.size(); ++c)
    if (step.pairs[c].force > 0)
      pressed_.write(step.names[c].first).push_back({step.names[c].second, step.pairs[c].force / h});
  crowd_step_ = h;
  jostled_pairs_ = 0;
  crowd_end_ = end;
  std::vector<Entity> members;
  members.swap(crowd_);
  for (std::size_t k = 0; k < members.size(); ++k) {
    const Entity i = members[k];
    const Vec3 &x = step.x[k], &v = step.settled[k], &moved = step.moved[k];
    const Vec3 before = flight_[i].velocity(now_ - flight_[i].start);
    const auto go_on = [&](const Vec3& velocity) {
      log_.lose(0.5 * world_.mass[i] * (before - velocity).dot(before + velocity));
      restart(i, x, velocity, {});
    };
    if (step.rests[k]) {
      body_[i].place = Place::asleep;
      carry(i, true);
      go_on(Vec3::Zero());
    } else if ((idle_.write(i) = step.carried[k] ? 0 : idle_[i] + 1) < patience) {
      crowd_.push_back(i);
      carry(i, step.carried[k]);
      jostled_.write(i) = 0;
      if (step.carried[k]) {
        pulled_.write(i) = end;
        hastened_.write(i) = step.pull > 0 ? Vec3((moved - v) / h) : Vec3(Vec3::Zero());
        go_on(moved);
      } else {  // flies as those outside
        pulled_.write(i) = now_;
        hastened_.write(i).setZero();
        go_on(v);
        flight_.accelerate(i, pull_[i]);
      }
    } else {
      body_[i].place = Place::outside;
      carry(i, false);
      go_on(v);
    }
  }
  for (std::size_t c = 0; c < step.pairs.size(); ++c) {
    const auto [i, e] = step.names[c];
    if (step.pairs[c].b != PressedPair::none || !world_.is_body(e) || body_[e].place != Place::asleep) continue;
    if (step.pairs[c].force > 0 && body_[i].place == Place::crowd) wake(e);
  }
  if (crowd_.empty()) crowd_end_ = {never, 0};
  for (Entity i : members) local_.write(i) = PressedPair::none;
  for (Entity i : members) predict(i);
}

}  // namespace carom
