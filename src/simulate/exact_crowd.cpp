// The crowd: bodies in lasting contact with one another and with anything that is not flat, where paths have no closed
// form. It moves in steps, all of it together: a small one is followed closely (exact_follow.cpp), a large one goes in
// strides (exact_stride.cpp). Here: who belongs to it, and what impacts do to it between steps.
#include <algorithm>
#include <cmath>

#include "physics/complementarity.h"
#include "physics/restitution.h"
#include "physics/touch.h"
#include "simulate/exact_simulator.h"

namespace carom {

/// Keeps count of who rests on something.
void ExactSimulator::carry(Entity i, bool carried) {
  if (carried == (carried_[i] != 0)) return;
  carried_.write(i) = carried;
  carried ? log_.add_resting(1) : log_.remove_resting(1);
}

/// Body i belongs to the crowd from now on.
void ExactSimulator::join(Entity i) {
  if (body_[i].place == Place::asleep) wake(i);
  if (body_[i].place == Place::crowd) return;
  path_changes(i);
  body_[i].place = Place::crowd;
  pulled_.write(i) = now_;
  hastened_.write(i).setZero();
  kept_apart_.write(i) = 0;
  jostled_.write(i) = 0;
  if (contacts_[i].count > 0) {
    contacts_.write(i).count = 0;
    log_.remove_resting(1);
  }
  if (crowd_.empty()) {
    crowd_end_ = now_;
    following_ = false;
    log_.count_collapse();
  }
  if (following_) crowd_end_ = now_;
  idle_.write(i) = 0;
  needed_.write(i) = now_;
  crowd_.push_back(i);
}

/// A body of the crowd has been struck at this speed (m/s): for a while bodies are kept apart by about as much as they
/// could move at that speed until the next step.
void ExactSimulator::stir(Entity i, double approach) {
  if (body_[i].place != Place::crowd) return;
  needed_.write(i) = now_;
  kept_apart_.write(i) =
      std::max(kept_apart_[i], std::min(0.5 * approach * crowd_step_, restless_gap * world_.radius[i]));
}

/// How much of an approach (m/s) along n is there already: a stride's flights have what forces do in its rest in them.
double ExactSimulator::approach_now(double approach, const Vec3& n, Entity i, Entity e) const {
  const bool body = world_.is_body(e);
  if (following_ || approach == 0 || (body_[i].place != Place::crowd && !(body && body_[e].place == Place::crowd)))
    return approach;
  const Vec3 w = velocity_now(i, now_) - (body ? velocity_now(e, now_) : Vec3(Vec3::Zero()));
  return std::max(n.dot(w), 0.0);
}

/// A force in what is left of a stride changes body i's velocity by dv (m/s), which is in its flight from now on.
void ExactSimulator::hasten(Entity i, const Vec3& dv) {
  if (following_ || body_[i].place != Place::crowd || dv.isZero(0) || !(now_ < crowd_end_)) return;
  if (!(now_ < pulled_[i])) {
    pulled_.write(i) = crowd_end_;
    hastened_.write(i).setZero();
  }
  hastened_.write(i) += dv / (pulled_[i] - now_);
}

/// Whether body i of the crowd and e approach each other (m/s) for an impact that bounces: contact must not take it up.
/// `pull` is the greatest acceleration in the crowd (m/s^2).
bool ExactSimulator::strikes(Entity i, Entity e, double approach, double pull) const {
  const bool body = world_.is_body(e);
  const bool collapse = collapse_[i].taken_up == now_ || (body && collapse_[e].taken_up == now_);
  const double length = world_.radius[i] + (body ? world_.radius[e] : 0);
  return !collapse && pull > 0 && approach >= slow_speed(pull, length) && pair_restitution(world_, i, e) > 0;
}

/// A struck body and all that rest against one another with it are of the crowd again.
void ExactSimulator::wake(Entity i) {
  std::vector<Entity> todo{i};
  body_[i].place = Place::outside;
  while (!todo.empty()) {
    const Entity k = todo.back();
    todo.pop_back();
    carry(k, false);
    join(k);
    const Vec3 x = flight_[k].x;
    for (Entity e : known_to(k)) {
      if (!world_.is_body(e) || body_[e].place != Place::asleep) continue;
      if (touch(world_, k, x, e, flight_[e].x).gap > 1e-6 * world_.radius[k]) continue;
      body_[e].place = Place::outside;
      todo.push_back(e);
    }
  }
}

/// An impact of body i has been taken up. A body pushed to and fro between others would go on so for ever: then all of
/// those that touch one another there are struck at once. Where all is restless they part a little, lest they do so
/// again at the next rounding.
void ExactSimulator::jostle(Entity i) {
  constexpr std::uint32_t many = 3;
  constexpr double parting = 0.01;  // of the fastest approach: what those struck at once part with
  if (following_ || body_[i].place != Place::crowd || ++jostled_.write(i) <= many) return;
  std::vector<Entity> cluster{i};
  std::vector<PressedPair> pairs;
  const std::uint32_t unseen = PressedPair::none;
  const double closed = 1e-3 * kept_apart_[i];  // m, a gap that counts as contact
  local_.write(i) = 0;
  const auto at = [&](Entity k) { return flight_[k].position(now_ - flight_[k].start); };
  for (std::size_t k = 0; k < cluster.size(); ++k) {
    const Entity a = cluster[k];
    const Vec3 x = at(a);
    for (Entity e : known_to(a)) {
      const bool body = world_.is_body(e);
      if (body && body_[e].place != Place::crowd) continue;
      const Vec3 xe = body ? at(e) : world_.fixed_position(e);
      const double far = world_.radius[a] + (body ? world_.radius[e] : never) + closed;
      if ((xe - x).squaredNorm() > 1.001 * far * far) continue;
      const Touch there = touch(world_, a, x, e, xe);
      if (there.gap > closed) continue;
      if (body && local_[e] == unseen) {
        local_.write(e) = static_cast<std::uint32_t>(cluster.size());
        cluster.push_back(e);
      }
      if (!body || local_[e] > k)
        pairs.push_back({static_cast<std::uint32_t>(k), body ? local_[e] : unseen, there.normal});
    }
  }
  for (Entity a : cluster) local_.write(a) = unseen;
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
  const bool restless = kept_apart_[i] > 0.5 * restless_gap * world_.radius[i];
  for (PressedPair& p : pairs) {
    p.target = restless ? parting * approach : 0;
    p.slack = 1e-3 * approach;
  }
  after = before;
  press_apart(inverse_mass, after, pairs, 200);
  double gained = 0;
  for (std::size_t k = 0; k < cluster.size(); ++k)
    gained += world_.mass[cluster[k]] * (after[k] - before[k]).dot(after[k] + before[k]);
  if (gained > 0) {
    for (PressedPair& p : pairs) p.target = 0;
    after = before;
    press_apart(inverse_mass, after, pairs, 200);
  }
  std::vector<Entity> changed;
  for (std::size_t k = 0; k < cluster.size(); ++k) {
    const Entity a = cluster[k];
    jostled_.write(a) = 1;
    if (after[k] == before[k]) continue;
    changed.push_back(a);
    log_.lose(0.5 * world_.mass[a] * (before[k] - after[k]).dot(before[k] + after[k]));
    restart(a, at(a), after[k], {});
    flight_.accelerate(a, Vec3::Zero());
  }
  // Jostling has cost as much as a stride: the next one is due. This one was too long.
  jostled_pairs_ += pairs.size();
  if (jostled_pairs_ > 16 * crowd_.size() && now_ < crowd_end_) {
    crowd_step_ -= crowd_end_ - now_;
    crowd_end_ = now_;
    changed.push_back(i);
  }
  for (Entity a : changed) predict(a);
}

void ExactSimulator::step_crowd() {
  std::sort(crowd_.begin(), crowd_.end());
  for (Entity i : crowd_) path_changes(i);
  if (follow_crowd()) return;
  for (Entity i : crowd_) followed_.write(i).clear();
  following_ = false;
  stride();
}

}  // namespace carom
