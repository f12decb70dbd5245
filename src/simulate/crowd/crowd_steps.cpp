// A crowd's step on plain data. A kick that is mostly of the past makes energy, and so does contact that stops an
// approach as if by a steady force: both are impulses of one instant.
#include "simulate/crowd/crowd_steps.h"

#include <algorithm>
#include <utility>

#include "physics/impact.h"
#include "physics/world.h"
#include "simulate/tolerances.h"
#include "solver/contact_problem.h"

namespace carom {

namespace tol = exact_tolerance;

bool CrowdSteps::solve(Crowd& crowd) {
  strike(crowd);
  if (crowd.step.length < tol::restart * crowd.step.last_length) restart(crowd);

  before_ = crowd.v;
  for (int tries = 0;; ++tries) {
    kick(crowd);
    if (!hold(crowd)) bodies_.log.count_unsolved_step();
    const double safe = safe_length(crowd);
    if (safe >= crowd.step.length || quality_.overlap > 0 || tries == tol::most_shortenings) break;
    crowd.step.length = std::max(safe, 0.25 * crowd.step.length);
    crowd.v = before_;
  }

  const double need = crowd.step.length * greatest(crowd.v);
  if (crowd.list.gone + need <= crowd.list.reach) return true;
  crowd.v = before_;
  crowd.list.need = need;
  return false;
}

/// The share of a missing gap that a step restores: all of it in the time of falling by a radius, so that the return is
/// as slow at every length of a step.
double CrowdSteps::return_of_step(const Crowd& crowd) const {
  if (crowd.load == 0) return quality_.displacement;
  return std::min(1.0, crowd.step.length / std::sqrt(2 * crowd.smallest / crowd.load));
}

/// Impacts of pairs that would close their gap in the step, in the order of rows, until none is left.
void CrowdSteps::strike(Crowd& crowd) {
  crowd.step.speed = speed_in_contact(crowd);
  crowd.step.shell = quality_.shell * crowd.smallest;
  if (crowd.rest.closing) crowd.step.shell = 0;
  now_ = crowd.v;
  for (std::size_t k = 0; k < crowd.members.size(); ++k) add(now_[k], crowd.lag[k] * crowd.a[k]);
  const double back = return_of_step(crowd);
  const StepTarget target{crowd.step.length, crowd.taken > crowd.made ? back : 0, back,
                          tol::share_of_gap, tol::gap_rounding * crowd.smallest,  crowd.step.shell};
  const std::size_t groups = crowd.rows.groups();
  const AimResult found = kernels_.aim(crowd.rows.hot.data(), crowd.rows.change.data(), crowd.rows.state.data(), groups,
                                       now_.data(), target);
  if (found.least_gap < 0) bodies_.log.note_overlap(-found.least_gap);

  bool any = found.strikes;
  for (int sweep = 0; any && sweep < quality_.impact_sweeps; ++sweep) {
    any = false;
    unsigned which = 0;
    for (std::size_t g = 0; (g = kernels_.next_strike(crowd.rows.hot.data(), crowd.rows.state.data(), g, groups,
                                                      now_.data(), crowd.step.length, which)) < groups;
         ++g) {
      any = true;
      for (std::size_t lane = 0; lane < CrowdRows::lanes; ++lane)
        if ((which >> lane & 1) != 0) strike(crowd, g, lane);
    }
  }

  crowd.step.kinetic = kinetic_energy(crowd);
}

/// Begins anew from the velocities of this instant. In a step that is much shorter than the last one, a kick for the
/// time since the middle of that would be mostly of the past.
void CrowdSteps::restart(Crowd& crowd) const {
  std::copy_n(now_.begin(), crowd.members.size(), crowd.v.begin());
  std::fill(crowd.lag.begin(), crowd.lag.end(), 0);
}

/// The impact of one row.
void CrowdSteps::strike(Crowd& crowd, std::size_t group, std::size_t lane) {
  const RowGroup& row = crowd.rows.hot[group];
  const std::uint32_t a = row.a[lane];
  const std::uint32_t b = row.b[lane];
  const Vec3 normal = crowd.rows.normal(group, lane);
  const auto& [i, e] = crowd.rows.names[group][lane];
  const double speed = approach(crowd, group, lane);
  const double restitution = crowd.rows.state[group].e[lane];
  const double separation = restitution * speed;
  const Vec3 point = crowd.position(a) + bodies_.world.volume_of(i).support(normal) * normal;

  const Collision met =
      make_collision(bodies_.world, b < crowd.movable() ? CollisionKind::body_body : CollisionKind::body_fixed,
                     bodies_.now.hi, i, e, point, normal, speed, separation, restitution);
  bodies_.log.record(met);
  bodies_.log.lose(met.energy_lost);
  push(crowd, group, lane, met.impulse, crowd.v);
}

/// Changes the velocities of the instant, and these drifts, by an impulse (N s) of a row. Returns the work of a thing
/// that moves (J).
double CrowdSteps::push(Crowd& crowd, std::size_t group, std::size_t lane, double impulse, std::vector<Four>& drifts) {
  const RowGroup& row = crowd.rows.hot[group];
  const Vec3 normal = crowd.rows.normal(group, lane);
  for (const auto& [k, sign] : {std::pair{row.a[lane], -1.0}, std::pair{row.b[lane], 1.0}}) {
    if (k >= crowd.movable()) continue;
    const Vec3 change = sign * impulse / bodies_.world.mass[crowd.members[k]] * normal;
    add(now_[k], change);
    add(drifts[k], change);
    crowd.idle[k] = 0;
  }
  const double work = row.b[lane] < crowd.movable() ? 0 : -impulse * normal.dot(crowd.drift(row.b[lane]));
  if (work != 0) bodies_.log.add_work(work);
  return work;
}

/// The kinetic energy at the step's start (J).
double CrowdSteps::kinetic_energy(const Crowd& crowd) const {
  double sum = 0;
  for (std::size_t k = 0; k < crowd.members.size(); ++k)
    sum += 0.5 * bodies_.world.mass[crowd.members[k]] * vector_of(now_[k]).squaredNorm();
  return sum;
}

void CrowdSteps::take(Crowd& crowd, double energy) const {
  if (energy >= 0) {
    crowd.taken += energy;
    bodies_.log.absorb(energy);
  } else {
    crowd.made -= energy;
    bodies_.log.make(-energy);
  }
}

/// Changes drifts by forces, for the time from the middle of the last step to that of this one, and by the forces of
/// contacts in the last step. Linear drag is implicit, as if bodies were heavier.
void CrowdSteps::kick(Crowd& crowd) {
  for (std::size_t k = 0; k < crowd.members.size(); ++k) {
    const Entity i = crowd.members[k];
    const double seconds = 0.5 * crowd.step.length + crowd.lag[k];
    const double fade = bodies_.fade[i];
    if (fade == 0) {
      add(crowd.v[k], seconds * bodies_.applied[i]);
      continue;
    }
    const double half = 0.5 * seconds * fade;
    const Vec3 v = ((1 - half) * crowd.drift(k) + seconds * bodies_.applied[i]) / (1 + half);
    crowd.v[k] = four_of(v, crowd.v[k].at[3] / (1 + half));
  }
  free_ = crowd.v;

  for (std::size_t g = 0; g < crowd.rows.groups(); ++g)
    for (std::size_t lane = 0; lane < CrowdRows::lanes; ++lane) {
      const std::uint32_t a = crowd.rows.hot[g].a[lane];
      const double lag = a < crowd.movable() ? crowd.lag[a] : 0;
      crowd.rows.hot[g].impulse[lane] = (0.5 * crowd.step.length + lag) * crowd.rows.state[g].force[lane];
    }
  kernels_.push(crowd.rows.hot.data(), crowd.rows.groups(), crowd.v.data());
}

/// The root mean square of the relative speeds of pairs that pressed in the last step (m/s). Pairs that fly beside one
/// another do not count: they would make the forces of a heap coarse.
double CrowdSteps::speed_in_contact(const Crowd& crowd) {
  double squares = 0;
  std::size_t pressing = 0;
  crowd.rows.for_each([&](std::size_t g, std::size_t lane) {
    if (!(crowd.rows.state[g].force[lane] > 0)) return;
    const RowGroup& row = crowd.rows.hot[g];
    squares += (crowd.drift(row.b[lane]) - crowd.drift(row.a[lane])).squaredNorm();
    ++pressing;
  });
  return pressing > 0 ? std::sqrt(squares / static_cast<double>(pressing)) : 0;
}

/// What forces may leave, and how often they are improved.
CrowdSolver::Goal CrowdSteps::goal(const Crowd& crowd) const {
  const auto bodies = static_cast<double>(std::max(std::ranges::count(crowd.pressed, 1), std::ptrdiff_t{1}));
  const double gained = crowd.load * crowd.step.length;
  const double rounding = tol::gap_rounding * std::max(gained, greatest(before_));
  const double left = quality_.accuracy * std::max(std::min(gained, tol::force_of_speed * crowd.step.speed),
                                                   tol::least_force * crowd.step.speed) +
                      rounding;
  return {crowd.step.length, left * left * bodies, quality_.sweeps};
}

/// Finds the impulses that keep all pairs apart. Returns whether they are as accurate as the goal.
bool CrowdSteps::hold(Crowd& crowd) {
  const bool solved = solver_.hold(crowd.rows, crowd.v, goal(crowd));
  // Forces as a whole then do no work but that of their targets, whatever the sweeps have left. Without this the errors
  // of many steps add up to energy.
  solver_.scale(crowd.rows, crowd.v, free_, crowd.step.length);
  if (quality_.overlap > 0) return solved;
  for (int more = 0; solved && more < tol::more_sweeps && safe_length(crowd) < crowd.step.length; more += 4)
    solver_.sweep(crowd.rows, crowd.v, crowd.step.length, 4);
  return solved || (crowd.unequal && solve_exactly(crowd));
}

/// The longest drift (s) after which no two overlap, but for rounding.
double CrowdSteps::safe_length(const Crowd& crowd) const {
  return kernels_.safe_drift(crowd.rows.hot.data(), crowd.rows.state.data(), crowd.rows.groups(), crowd.v.data(),
                             tol::gap_rounding * crowd.smallest);
}

/// The same impulses by the contact solver, where sweeps converge too slowly because masses are unequal.
bool CrowdSteps::solve_exactly(Crowd& crowd) const {
  std::vector<Vec3> motion;
  std::vector<double> inverse_mass;
  for (std::size_t k = 0; k < crowd.members.size(); ++k) {
    motion.push_back(vector_of(free_[k]));
    inverse_mass.push_back(free_[k].at[3]);
  }

  std::vector<ContactConstraint> pairs;
  crowd.rows.for_each([&](std::size_t g, std::size_t lane) {
    const RowGroup& row = crowd.rows.hot[g];
    const bool body = row.b[lane] < crowd.movable();
    ContactConstraint pair{row.a[lane], body ? row.b[lane] : ContactConstraint::fixed, crowd.rows.normal(g, lane),
                           -row.base[lane] / crowd.step.length};
    pair.force = row.impulse[lane];
    if (!body) pair.surface = pair.normal.dot(crowd.drift(row.b[lane]));
    pairs.push_back(pair);
  });
  const Certificate certificate = carom::solve({inverse_mass, motion, pairs});

  auto pair = pairs.cbegin();
  crowd.rows.for_each([&](std::size_t g, std::size_t lane) { crowd.rows.hot[g].impulse[lane] = pair++->force; });
  for (std::size_t k = 0; k < motion.size(); ++k)
    for (int axis = 0; axis < 3; ++axis) crowd.v[k].at[axis] = motion[k][axis];
  return certificate.solved();
}

/// The speed of approach of a row at this instant (m/s).
double CrowdSteps::approach(const Crowd& crowd, std::size_t group, std::size_t lane) const {
  const RowGroup& row = crowd.rows.hot[group];
  return crowd.rows.normal(group, lane).dot(vector_of(now_[row.a[lane]]) - vector_of(now_[row.b[lane]]));
}

/// Takes away the approaches of pairs that begin to press, and those that impacts have left, as impacts of this instant
/// without a rebound. What is left of their impulses is force.
void CrowdSteps::absorb_approaches(Crowd& crowd) {
  const double rounding = tol::drift * greatest(now_);
  std::vector<std::pair<std::size_t, std::size_t>> closing;
  for (std::size_t g = 0; g < crowd.rows.groups(); ++g)
    for (std::size_t lane = 0; lane < CrowdRows::lanes; ++lane) {
      if (!(crowd.rows.hot[g].impulse[lane] > 0)) continue;
      const RowState& state = crowd.rows.state[g];
      if (state.force[lane] == 0 || approach(crowd, g, lane) > std::max(state.slow[lane], rounding))
        closing.emplace_back(g, lane);
    }
  if (closing.empty()) return;

  // One after the other, until nothing is left or all of an impulse is used.
  double work = 0;  // J
  bool any = true;
  for (int sweep = 0; any && sweep < quality_.impact_sweeps; ++sweep) {
    any = false;
    for (const auto& [g, lane] : closing) {
      RowGroup& row = crowd.rows.hot[g];
      const double speed = approach(crowd, g, lane);

      const double impulse = std::min(row.impulse[lane], speed * row.share[lane]);
      if (!(speed > rounding && impulse > 0)) continue;
      work += push(crowd, g, lane, impulse, before_);
      row.impulse[lane] -= impulse;
      if (sweep == 0) bodies_.log.take_up(speed, 0);
      any = true;
    }
  }

  const double before = crowd.step.kinetic;
  crowd.step.kinetic = kinetic_energy(crowd);
  take(crowd, before + work - crowd.step.kinetic);
}

void CrowdSteps::finish(Crowd& crowd) {
  absorb_approaches(crowd);

  std::fill(crowd.pressed.begin(), crowd.pressed.end(), 0);
  for (std::size_t g = 0; g < crowd.rows.groups(); ++g) {
    const RowGroup& row = crowd.rows.hot[g];
    RowState& state = crowd.rows.state[g];
    for (std::size_t lane = 0; lane < CrowdRows::lanes; ++lane) {
      const std::uint32_t a = row.a[lane];
      const std::uint32_t b = row.b[lane];
      const double lag = a < crowd.movable() ? crowd.lag[a] : 0;
      state.carried[lane] = state.force[lane] * lag;
      state.force[lane] = row.impulse[lane] / (0.5 * crowd.step.length + lag);

      if (!(row.impulse[lane] > 0)) continue;
      crowd.pressed[a] = 1;
      if (b < crowd.movable()) crowd.pressed[b] = 1;
    }
  }

  for (std::size_t k = 0; k < crowd.members.size(); ++k) {
    crowd.v[k].at[3] = 1 / bodies_.world.mass[crowd.members[k]];
    crowd.a[k] = (crowd.drift(k) - vector_of(before_[k])) / (0.5 * crowd.step.length + crowd.lag[k]);
    crowd.idle[k] = crowd.pressed[k] != 0 ? 0 : static_cast<std::uint8_t>(std::min(crowd.idle[k] + 1, 255));
  }
}

}  // namespace carom
