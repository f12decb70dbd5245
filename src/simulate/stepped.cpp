#include "simulate/stepped.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "physics/force.h"
#include "physics/whole.h"
#include "simulate/stepped_simulator.h"

namespace carom {

namespace {

constexpr std::size_t collision_buffer = 4096;
constexpr int steps_at_a_time = 4096;
// Where bounces are followed:
constexpr double hop = 1e-6;              // of a step: the shortest bounce that is one
constexpr std::uint32_t followed = 4096;  // impacts of a body in a step

}  // namespace

std::unique_ptr<Simulator> make_stepped_simulator(const World& world, const State& initial,
                                                  const SteppedOptions& options) {
  return std::make_unique<SteppedSimulator>(world, initial, options);
}

SteppedSimulator::SteppedSimulator(const World& world, const State& initial, const SteppedOptions& options)
    : world_(world),
      options_(options),
      bounds_(bounds_of(world)),
      x_(initial.position),
      v_(initial.velocity),
      start_(world.body_count()),
      path_(world.body_count()),
      origin_(world.body_count()),
      version_(world.body_count()),
      cluster_of_(world.body_count(), none),
      impacts_(world.body_count()),
      meetings_(world.body_count()),
      spot_(world.body_count()),
      alone_until_(world.body_count()),
      crowd_(world.body_count()),
      in_crowd_(world.body_count()),
      host_(world.body_count(), no_entity),
      calm_(world.body_count()),
      patience_(world.body_count()),
      pressed_(world.body_count()),
      is_awake_(world.body_count(), 1),
      neighbours_(world),
      local_(world.body_count(), none) {
  const Entity n = world.body_count();
  if (options.record_collisions) collisions_.reserve(collision_buffer);
  for (const Force& force : world.forces) {
    constant_ = constant_ && is_constant(force.law);
    for (const double t : {force.from, force.until})
      if (t > 0 && t < options.duration) switches_.push_back(t);
    works_ = works_ || force.from > 0 || force.until < never || !is_constant(force.law);
  }
  std::sort(switches_.begin(), switches_.end());
  if (options.closed_form) {
    shortest_hop_ = hop * options.step;
    restless_ = many_impacts_ = followed;
  }
  loaded_ = !world.gravity.isZero(0) || !world.forces.empty();
  for (Entity i = 0; i < n; ++i) {
    if (!world.impulse.empty()) v_[i] += world.impulse[i] / world.mass[i];
    tally_.max_speed = std::max(tally_.max_speed, v_[i].norm());
    path_[i] = {x_[i], v_[i], free_acceleration(i, x_[i], v_[i]), Vec3::Zero()};
    spot_[i] = {x_[i], world.radius[i]};
    awake_.push_back(i);
  }
  end_x_ = x_;
  end_v_ = v_;
  neighbours_.start(x_);
  for (Entity i = 0; i < n; ++i) {
    if (cluster_of_[i] != none) continue;
    std::vector<Entity> group{i};
    bind(group, 0, nullptr, false);
  }
}

/// s: where the step after the present one ends: at a multiple of the given step, where a force sets in or ceases, or
/// at the end.
double SteppedSimulator::next_time(double from) {
  if (!(from + options_.step > from))
    throw SimulationError(fmt::format("at t = {} s steps of {} s no longer move the clock: use a longer simulate.step",
                                      from, options_.step));
  steps_ = std::max(steps_, static_cast<std::uint64_t>(whole_below(from / options_.step)));
  while (static_cast<double>(steps_) * options_.step <= from) ++steps_;
  double next = std::min(static_cast<double>(steps_) * options_.step, options_.duration);
  const auto at = std::upper_bound(switches_.begin(), switches_.end(), from);
  if (at != switches_.end()) next = std::min(next, *at);
  return next;
}

void SteppedSimulator::advance_to(double time) {
  collisions_.clear();
  state_fresh_ = false;
  const double until = std::min(time, options_.duration);
  for (int steps = 0; to_ < until; ++steps) {
    if (steps == steps_at_a_time || collisions_.size() >= collision_buffer / 2) {
      time_ = std::max(time_, to_);
      return;
    }
    do_step();
    neighbours_.tidy();
  }
  time_ = std::max(time_, time);
}

/// What was the end of the last step becomes the beginning of the next one.
void SteppedSimulator::end_step() {
  std::size_t kept = 0;
  for (const Entity i : awake_) {
    x_[i] = end_x_[i];
    v_[i] = end_v_[i];
    start_[i] = 0;
    if (loaded_ && impacts_[i] >= restless_) join(i);
    impacts_[i] = 0;
    meetings_[i] = 0;
    in_crowd_[i] = 0;
    host_[i] = no_entity;
    origin_[i] = {};
    ++version_[i];
    is_awake_[i] = cluster_of_[i] == none || !clusters_[cluster_of_[i]].asleep;
    if (is_awake_[i]) awake_[kept++] = i;
  }
  gone_ += goes_;
  goes_ = 0;
  awake_.resize(kept);
  if (!std::is_sorted(awake_.begin(), awake_.end())) std::sort(awake_.begin(), awake_.end());
  pieces_.clear();
}

void SteppedSimulator::do_step() {
  end_step();
  from_ = to_;
  to_ = next_time(from_);
  length_ = to_ - from_;
  const bool changed = std::binary_search(switches_.begin(), switches_.end(), from_);
  std::vector<std::vector<Entity>> groups;
  for (std::uint32_t c = 0; c < clusters_.size(); ++c) {
    if (clusters_[c].members.empty() || (clusters_[c].asleep && !clusters_[c].woken && !changed)) continue;
    groups.emplace_back();
    dissolve(c, 0, groups.back());
    const auto crowded_one = [&](Entity i) { return crowd_[i] > 0; };
    if (groups.back().size() > most_members || std::any_of(groups.back().begin(), groups.back().end(), crowded_one)) {
      for (const Entity i : groups.back()) join(i);
      groups.pop_back();
    }
  }
  for (std::vector<Entity>& group : groups) {
    std::erase_if(group, [&](Entity i) { return cluster_of_[i] != none; });  // bound with a group before
    if (!group.empty()) bind(group, 0, nullptr, false);
  }
  for (const Entity i : awake_)
    if (cluster_of_[i] == none && crowd_[i] == 0) begin_path(i);
  tally_.resting -= now_.carried;
  now_.clear();
  if (std::any_of(awake_.begin(), awake_.end(), [&](Entity i) { return crowd_[i] > 0; })) {
    for (const Entity i : awake_)
      if (crowd_[i] == 0) stay_known(i);
    step_crowd();
  }
  for (Cluster& cluster : clusters_)
    if (!cluster.members.empty() && !cluster.asleep) begin_paths(cluster);
  const std::vector<Entity> moving = awake_;
  for (const Entity i : moving) stay_known(i);
  some_sleep_ = std::any_of(clusters_.begin(), clusters_.end(),
                            [](const Cluster& cluster) { return cluster.asleep && !cluster.members.empty(); });
  for (const Entity i : moving) predict(i, false);
  for (std::uint32_t c = 0; c < clusters_.size(); ++c)
    if (!clusters_[c].members.empty() && !clusters_[c].asleep) predict_releases(c);
  while (!events_.empty()) {
    const Event event = events_.top();
    events_.pop();
    process(event);
  }
  double strays = 0;  // m, what setting clusters on their surfaces adds to ways
  for (const Entity i : awake_)
    if (cluster_of_[i] != none) strays = std::max(strays, (end_x_[i] - path_[i].position(length_ - start_[i])).norm());
  goes_ += strays;
  for (const Entity i : awake_) {
    hold_to(bounds_, i, to_, end_x_[i], end_v_[i], too_fast);
    tally_.max_speed = std::max(tally_.max_speed, end_v_[i].norm());
    const double work = works_ ? book_work(i, end_x_[i], end_v_[i], length_ - start_[i]) : 0;
    // What a crowd's step does to energy, other than by forces, contact has taken.
    if (in_crowd_[i])
      lose(0.5 * world_.mass[i] * (v_[i] - end_v_[i]).dot(v_[i] + end_v_[i]) + potential(world_, i, x_[i]) -
           potential(world_, i, end_x_[i]) + work);
  }
}

void SteppedSimulator::record(const Collision& c) {
  tally_.count(c.kind, c.time);
  if (options_.record_collisions) collisions_.push_back(c);
  if (options_.max_collisions > 0 && tally_.collisions() > options_.max_collisions)
    throw SimulationError(fmt::format("more than simulate.max_collisions = {} collisions, reached at t = {} s",
                                      options_.max_collisions, c.time));
}

/// Energy (J) that a collision or a contact took.
void SteppedSimulator::lose(double energy) {
  energy_lost_.add(energy);
  tally_.energy_lost = energy_lost_.value();
}

/// Where a body is on its way since `from` (s, since the step's start) is told by taking the step once more, up to
/// there; in a cluster or a crowd by its path.
const State& SteppedSimulator::state() {
  if (state_fresh_) return state_;
  state_.time = time_;
  state_.position = end_x_;
  state_.velocity = end_v_;
  const double t = time_ - from_;
  if (time_ < to_) {
    const auto look = [&](Entity i, const Path& path, double since, const Vec3& end_v, double length, bool company) {
      Vec3 x = path.x, v = path.v;
      Path same;
      if (!company) {
        take(i, t - since, x, v, same);
      } else {
        x = path.position(t - since);
        v = path.velocity(t - since) + (t - since) / length * (end_v - path.velocity(length));
      }
      state_.position[i] = x;
      state_.velocity[i] = v;
    };
    for (const Entity i : awake_)
      if (t >= start_[i]) look(i, path_[i], start_[i], end_v_[i], length_ - start_[i], in_company(i));
    for (const Piece& p : pieces_)
      if (t >= p.from && t < p.to) look(p.body, p.path, p.from, p.end_v, p.to - p.from, p.in_company);
  }
  state_fresh_ = true;
  return state_;
}

/// The forces of contact: those at the present instant, told by taking each cluster's step up to there; in the crowd
/// those of its step.
std::span<const ContactForce> SteppedSimulator::contacts() {
  contact_forces_.clear();
  std::vector<PressedPair> pairs;
  for (const Cluster& cluster : clusters_) {
    if (cluster.members.empty()) continue;
    const double since = time_ - from_ - start_[cluster.members.front()];
    if (!cluster.asleep && since > 0) {
      Motion m = gather(cluster);
      move(cluster, since, m);
      std::vector<Vec3> a(m.x.size());
      accelerate(cluster, m.end_x, m.end_v, a, pairs);
    }
    std::size_t k = 0;
    for (const Bond& bond : cluster.bonds) {
      if (!bond.presses) continue;
      const double force = cluster.asleep || since <= 0 ? bond.force : pairs[k].force;
      ++k;
      if (force > 0) contact_forces_.push_back({bond.a, bond.b, force});
    }
  }
  for (const CrowdContact& c : now_.contacts)
    if (carries(c)) contact_forces_.push_back({c.a, c.b, c.impulse / length_});
  std::sort(contact_forces_.begin(), contact_forces_.end(),
            [](const ContactForce& p, const ContactForce& q) { return std::pair(p.a, p.b) < std::pair(q.a, q.b); });
  return contact_forces_;
}

}  // namespace carom
