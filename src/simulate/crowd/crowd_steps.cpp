// A crowd's step on plain data. A kick that is mostly of the past makes energy, and so does contact that stops an
// approach as if by a steady force: both are impulses of one instant.
#include "simulate/crowd/crowd_steps.h"

#include "physics/impact.h"
#include "physics/world.h"
#include "simulate/tolerances.h"
#include "solver/contact_problem.h"
#include "std.h"

namespace carom {

namespace tol = exact_tolerance;

CrowdSteps::CrowdSteps(ExactBodies& bodies, const ContactQuality& quality, CrowdThreads& threads)
    : bodies_(bodies),
      quality_(quality),
      threads_(threads),
      shells_(any_of(bodies.world.obstacles, [](const Obstacle& o) { return o.hollow != Hollow::none; })),
      solver_(threads) {}

bool CrowdSteps::solve(Crowd& crowd) {
  if (!strike(crowd)) return false;
  shorten(crowd, longest(crowd));
  restart_if_short(crowd);
  before_ = crowd.v;
  for (int tries = 0;; ++tries) {
    kick(crowd);
    bend(crowd);
    crowd.step.solved = balance(crowd);

    // The contact solver's forces depend on the order of bodies: mirror images with one slab have the same.
    double safe = safe_length(crowd);
    if (safe < crowd.step.length && tries == 1 && crowd.rows.slabs() == 1 && solve_exactly(crowd)) {
      crowd.step.solved = true;
      safe = safe_length(crowd);
    }
    if (safe >= crowd.step.length || tries == tol::most_shortenings) break;
    crowd.v = before_;
    shorten(crowd, max(safe, 0.25 * crowd.step.length));
    restart_if_short(crowd);
    before_ = crowd.v;
  }

  const double need = crowd.step.length * greatest(crowd.v);
  const bool listed = crowd.list.gone + need <= crowd.list.reach;
  if (listed && !presses_on_sleepers(crowd)) return true;
  crowd.v = before_;
  if (!listed) crowd.list.need = need;
  return false;
}

/// Lets the step end sooner (s). What it restores of missing gaps is less too: the return must not be faster.
void CrowdSteps::shorten(Crowd& crowd, double length) {
  if (!(length < crowd.step.length)) return;
  unbend(crowd);
  const double share = length / crowd.step.length;
  for (RowGroup& group : crowd.rows.hot)
    for (double& base : group.base) base *= base < 0 ? share : 1;
  crowd.step.length = length;
  drift_things(crowd);
}

void CrowdSteps::drift_things(Crowd& crowd) const {
  if (!bodies_.moving.any()) return;
  const Instant end = bodies_.now + crowd.step.length;
  for (size_t k = 0; k < crowd.things.size(); ++k) {
    if (bodies_.world.swing(crowd.things[k]) == nullptr) continue;
    const Vec3 way = bodies_.fixed_position(crowd.things[k], end) - bodies_.fixed_position(crowd.things[k]);
    crowd.v[crowd.movable() + k] = four_of(way / (end - bodies_.now), 0);
  }
}

/// The longest step that the velocities of this instant allow (s). Impacts have made some of them greater.
double CrowdSteps::longest(const Crowd& crowd) const {
  const double fastest = greatest(now_);
  return fastest > 0 ? min(crowd.step.length, quality_.displacement * crowd.smallest / fastest) : crowd.step.length;
}

/// The share of a missing gap that a step restores: all of it in the time of falling by a radius, so that the return is
/// as slow at every length of a step.
double CrowdSteps::return_of_step(const Crowd& crowd) const {
  if (crowd.load == 0) return quality_.displacement;
  return min(1.0, crowd.step.length / sqrt(2 * crowd.smallest / crowd.load));
}

/// Whether missing gaps return in this step. It costs energy, of which contacts must have taken more. Where bodies just
/// fit between walls, forces are so great that this makes a share of all that the crowd turns over, or that its members
/// gain in a fall by a radius. Gaps then stay as they are. Overlaps that the quality allows always return.
bool CrowdSteps::may_return(const Crowd& crowd) const {
  const auto& [taken, made, lost] = crowd.balance;
  if (!(made < taken) || crowd.step.waits > 0) return false;
  if (quality_.overlap > 0 || made <= tol::made_with_returns * (taken + lost)) return true;

  const World& world = bodies_.world;
  const double fall = crowd.sum([&](size_t k) {
    const Entity i = crowd.members[k];
    return world.mass[i] * crowd.load * world.radius[i];
  });
  return made <= tol::made_with_returns * (taken + lost + fall);
}

/// Finds the velocities of this instant, and what rows aim at. Returns whether a row has an impact in the step.
bool CrowdSteps::aim(Crowd& crowd) {
  crowd.step.speed = speed_in_contact(crowd);
  crowd.step.shell = crowd.rest.closing ? 0 : quality_.shell * crowd.smallest;
  now_ = crowd.v;
  for (size_t k = 0; k < crowd.members.size(); ++k) add(now_[k], crowd.lag[k] * crowd.a[k]);

  bends_.clear();
  bases_.clear();
  const double back = return_of_step(crowd);
  StepTarget target;
  target.length = crowd.step.length;
  target.push = may_return(crowd) ? back : 0;
  target.back = min(1.0, tol::quick_return * back);
  target.share = tol::share_of_gap;
  target.below = tol::share_below;
  target.least = tol::gap_rounding * crowd.smallest;
  target.shell = crowd.step.shell;
  // Each of the two goes no farther than the quality lets it (`longest`).
  target.way = 2 * quality_.displacement * crowd.smallest;
  may_strike_.resize(crowd.rows.groups());

  CrowdRows& rows = crowd.rows;
  vector<AimResult> found(rows.parts.size());
  threads_.each(rows, [&](size_t p) {
    const auto& [begin, balls, end] = rows.parts[p];
    found[p] = kernels_.aim(rows.hot.data() + begin, rows.change.data() + begin, rows.state.data() + begin, end - begin,
                            now_.data(), target, may_strike_.data() + begin);
  });

  bool strikes = false;
  for (const AimResult& of : found) {
    if (of.least_gap < 0) bodies_.log.note_overlap(-of.least_gap);
    strikes = strikes || of.strikes;
  }
  return strikes;
}

/// Along the inside of a shell a straight drift leads out of it. The gaps and targets of such rows are narrower by what
/// the present drift would lose so in the step. Normals stay those of the step's start, through the shell's axis: a
/// sliding ball thus keeps its speed, and its moment about the axis.
void CrowdSteps::bend(Crowd& crowd) {
  if (!shells_) return;
  const World& world = bodies_.world;
  unbend(crowd);
  bends_.resize(CrowdRows::lanes * crowd.rows.groups(), 0);
  bases_.resize(bends_.size(), 0);

  threads_.each(crowd.rows, [&](size_t p) {
    const auto& [begin, balls, end] = crowd.rows.parts[p];
    crowd.rows.for_each({balls, balls, end}, [&](size_t g, size_t lane) {
      const auto& [i, e] = crowd.rows.names[g][lane];
      if (!world.is_shell(e)) return;
      RowGroup& row = crowd.rows.hot[g];
      const uint32_t a = row.a[lane], b = row.b[lane];
      const Vec3 way = crowd.step.length * crowd.drift(a), of_shell = crowd.step.length * crowd.drift(b);
      const Touch then = touch(world, i, crowd.position(a) + way, e, crowd.position(b) + of_shell);
      double& gap = crowd.rows.state[g].gap[lane];
      const double straight = gap + crowd.rows.normal(g, lane).dot(of_shell - way);

      const double bent = min(then.gap - straight, 0.0);
      bends_[CrowdRows::lanes * g + lane] = bent;
      // Contact forces change the drift, and with it the bend. Where there is no shell to take that, the aim has room.
      const double aim = gap < 0.5 * crowd.step.shell ? tol::bent_aim * bent : bent;
      gap += bent;
      bases_[CrowdRows::lanes * g + lane] = aim;
      row.base[lane] += aim;
    });
  });
}

/// Takes that back.
void CrowdSteps::unbend(Crowd& crowd) {
  for (size_t k = 0; k < bends_.size(); ++k) {
    const size_t g = k / CrowdRows::lanes, lane = k % CrowdRows::lanes;
    crowd.rows.state[g].gap[lane] -= bends_[k];
    crowd.rows.hot[g].base[lane] -= bases_[k];
  }
  bends_.clear();
  bases_.clear();
}

/// Impacts of pairs that would close their gap in the step, in the order of rows, until none is left. False: one of
/// them is a sleeping body's, which must wake first.
bool CrowdSteps::strike(Crowd& crowd) {
  bool any = aim(crowd);
  vector<Strikes> strikes(crowd.rows.parts.size());
  for (int sweep = 0; any && sweep < quality_.impact_sweeps; ++sweep) {
    const double within = longest(crowd);
    threads_.in_phases(crowd.rows, [&](size_t p) { strike(crowd, p, within, strikes[p]); });

    any = false;
    crowd.balance.lost += crowd.rows.sum([&](size_t p) { return strikes[p].lost; });
    for (Strikes& of_part : strikes) {
      any = any || !of_part.met.empty();
      book(of_part);
      if (of_part.struck.a != no_entity) crowd.struck.push_back(of_part.struck);
      of_part = {};
    }
    if (!crowd.struck.empty()) return false;
  }

  crowd.step.kinetic = kinetic_energy(crowd);
  return true;
}

/// Those of a part in one round, up to one of a sleeping body.
void CrowdSteps::strike(Crowd& crowd, size_t part, double within, Strikes& strikes) {
  const auto& [begin, balls, end] = crowd.rows.parts[part];
  unsigned which = 0;
  for (size_t g = begin; (g = kernels_.next_strike(crowd.rows.hot.data(), crowd.rows.state.data(), g, end, now_.data(),
                                                   within, may_strike_.data(), which)) < end;
       ++g)
    for (size_t lane = 0; lane < CrowdRows::lanes; ++lane) {
      if ((which >> lane & 1) == 0) continue;
      strike(crowd, g, lane, strikes);
      if (strikes.struck.a != no_entity) return;
    }
}

void CrowdSteps::book(const Strikes& strikes) const {
  for (const Collision& met : strikes.met) {
    bodies_.log.record(met);
    bodies_.log.lose(met.energy_lost);
    bodies_.contact_work.impulses.strike(bodies_.now, met.a, met.b, met.impulse);
  }
  if (strikes.work != 0) bodies_.log.add_work(strikes.work);
}

/// Whether a row with a sleeping body has an impulse. It is to wake.
bool CrowdSteps::presses_on_sleepers(const Crowd& crowd) const {
  if (none_of(crowd.things, [&](Entity e) { return bodies_.world.is_body(e); })) return false;
  bool any = false;
  crowd.rows.for_each([&](size_t g, size_t lane) { any = any || crowd.presses_on_sleeper(g, lane, bodies_.world); });
  return any;
}

/// Begins anew from the velocities of this instant, if the step is much shorter than the last one. A kick for the time
/// since the middle of that would be mostly of the past.
void CrowdSteps::restart_if_short(Crowd& crowd) const {
  if (!(crowd.step.length < tol::restart * crowd.step.last_length)) return;
  std::copy_n(now_.begin(), crowd.members.size(), crowd.v.begin());
  ranges::fill(crowd.lag, 0);
  ranges::fill(crowd.lent, 0);
}

/// The impact of one row.
void CrowdSteps::strike(Crowd& crowd, size_t group, size_t lane, Strikes& strikes) {
  const RowGroup& row = crowd.rows.hot[group];
  const uint32_t a = row.a[lane];
  const bool body = row.b[lane] < crowd.movable();
  const Vec3 normal = crowd.rows.normal(group, lane);
  const auto& [i, e] = crowd.rows.names[group][lane];
  if (!body && bodies_.world.is_body(e)) {
    strikes.struck = crowd.rows.names[group][lane];
    return;
  }

  const double speed = approach(crowd, group, lane);
  const double restitution = crowd.rows.state[group].e[lane];
  const double separation = restitution * speed;
  const Vec3 point = crowd.position(a) + bodies_.world.volume_of(i).support(normal) * normal;
  strikes.met.push_back(with_effect(bodies_.world, {bodies_.now.hi, impact_kind(bodies_.world, e), i, e, point, normal,
                                                    speed, separation, restitution}));
  strikes.lost += strikes.met.back().energy_lost;
  strikes.work += push(crowd, group, lane, strikes.met.back().impulse, crowd.v);
}

/// Changes the velocities of the instant, and these drifts, by an impulse (N s) of a row. Returns the work of a thing
/// that moves (J).
double CrowdSteps::push(Crowd& crowd, size_t group, size_t lane, double impulse, vector<Four>& drifts) {
  const RowGroup& row = crowd.rows.hot[group];
  const Vec3 normal = crowd.rows.normal(group, lane);
  for (const auto& [k, sign] : {pair{row.a[lane], -1.0}, pair{row.b[lane], 1.0}}) {
    if (k >= crowd.movable()) continue;
    const Vec3 change = sign * impulse / bodies_.world.mass[crowd.members[k]] * normal;
    add(now_[k], change);
    add(drifts[k], change);
    crowd.idle[k] = 0;
  }
  return row.b[lane] < crowd.movable() ? 0 : -impulse * normal.dot(crowd.drift(row.b[lane]));
}

/// The kinetic energy at the step's start (J).
double CrowdSteps::kinetic_energy(const Crowd& crowd) const {
  return crowd.sum(
      [&](size_t k) { return 0.5 * bodies_.world.mass[crowd.members[k]] * vector_of(now_[k]).squaredNorm(); });
}

double CrowdSteps::lent(const Crowd& crowd, size_t k, double age) const {
  const Entity i = crowd.members[k];
  const double ahead = min(age, crowd.lag[k]);
  const Vec3 forces = bodies_.applied[i] - bodies_.fade[i] * crowd.drift(k);
  const double beyond = crowd.a[k].squaredNorm() - forces.squaredNorm();
  return 0.5 * bodies_.world.mass[i] * ahead * ahead * max(beyond, 0.0);
}

void CrowdSteps::take(Crowd& crowd, double energy, double lent) const {
  bodies_.log.absorb(lent);
  energy -= lent;
  if (energy >= 0) {
    crowd.balance.taken += energy;
    bodies_.log.absorb(energy);
  } else {
    crowd.balance.made -= energy;
    bodies_.log.make(-energy);
  }
}

/// Changes drifts by forces, for the time from the middle of the last step to that of this one, and by the forces of
/// contacts in the last step. Linear drag is implicit, as if bodies were heavier.
void CrowdSteps::kick(Crowd& crowd) {
  for (size_t k = 0; k < crowd.members.size(); ++k) {
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
  start_warm(crowd);
}

/// Begins with the forces of contacts in the last step.
void CrowdSteps::start_warm(Crowd& crowd) {
  CrowdRows& rows = crowd.rows;
  threads_.in_phases(rows, [&](size_t p) {
    const auto& [begin, balls, end] = rows.parts[p];
    for (size_t g = begin; g < end; ++g)
      for (size_t lane = 0; lane < CrowdRows::lanes; ++lane) {
        const uint32_t a = rows.hot[g].a[lane];
        const double lag = a < crowd.movable() ? crowd.lag[a] : 0;
        rows.hot[g].impulse[lane] = (0.5 * crowd.step.length + lag) * rows.state[g].force[lane];
      }
    kernels_.push(rows.hot.data() + begin, end - begin, crowd.v.data());
  });
}

/// The root mean square of the relative speeds of bodies that pressed on each other in the last step (m/s). Pairs that
/// fly beside one another, and slides along fixed things, would make the forces of a heap coarse.
double CrowdSteps::speed_in_contact(const Crowd& crowd) {
  const CrowdRows& rows = crowd.rows;
  vector<Agitation> found(rows.parts.size());
  threads_.each(rows, [&](size_t p) {
    const auto& [begin, balls, end] = rows.parts[p];
    found[p] = kernels_.agitation(rows.hot.data() + begin, rows.state.data() + begin, end - begin, crowd.v.data(),
                                  crowd.movable());
  });

  size_t pressing = 0;
  for (const Agitation& of : found) pressing += of.pressing;
  const double squares = rows.sum([&](size_t p) { return found[p].squares; });
  return pressing > 0 ? sqrt(squares / double(pressing)) : 0;
}

/// What forces may leave, and how often they are improved.
CrowdSolver::Goal CrowdSteps::goal(const Crowd& crowd) const {
  const auto bodies = double(max(ranges::count(crowd.pressed, 1), ptrdiff_t{1}));
  const double gained = crowd.load * crowd.step.length;
  const double rounding = tol::gap_rounding * max(gained, greatest(before_));
  // Slower bodies rest by the contact solver's forces.
  const double still = tol::tremor * sqrt(crowd.load * crowd.smallest);
  const double speed = max(crowd.step.speed, still);
  const double left =
      quality_.accuracy * max(min(gained, tol::force_of_speed * speed), tol::least_force * speed) + rounding;
  return {crowd.step.length, left * left * bodies, gained * crowd.step.length, quality_.sweeps};
}

/// Finds the impulses that keep all pairs apart. Returns whether they are as accurate as the goal.
bool CrowdSteps::balance(Crowd& crowd) {
  const CrowdSolver::Goal aim = goal(crowd);
  SweepResult found = solver_.balance(crowd.rows, crowd.v, aim);
  if (found.is_short && give_up_returns(crowd)) {
    crowd.step.waited = clamp(2 * crowd.step.waited, 1, tol::longest_wait);
    crowd.step.waits = crowd.step.waited + 1;
    crowd.v = free_;
    start_warm(crowd);
    found = solver_.balance(crowd.rows, crowd.v, aim);
  }
  // Forces as a whole then do no work but that of their targets, whatever the sweeps have left. Without this the errors
  // of many steps add up to energy.
  solver_.scale(crowd.rows, crowd.v, free_, crowd.step.length);
  if (!shells_ && safe_length(crowd) < crowd.step.length) keep_apart(crowd, 0);
  // Each change of drifts changes how far shells bend.
  if (shells_) {
    bend(crowd);
    const double rounding = tol::gap_rounding * crowd.smallest;
    for (int round = 0; round < tol::bent_rounds && keep_apart(crowd, rounding); ++round) bend(crowd);
  }
  if (found.change <= aim.change) return true;
  give_up_returns(crowd);
  return crowd.members.size() <= tol::exact_members && solve_exactly(crowd);
}

/// Lets pairs keep the gaps that they have. Bodies that just fit between walls cannot all have more, and the forces
/// that should give it to them would grow without end. Returns whether there are such pairs.
bool CrowdSteps::give_up_returns(Crowd& crowd) {
  bool any = false;
  crowd.rows.for_each([&](size_t g, size_t lane) {
    double& base = crowd.rows.hot[g].base[lane];
    if (!(base < 0)) return;
    base = 0;
    any = true;
  });
  return any;
}

/// Sweeps over the pairs that would overlap by more than rounding (m), and those that overlap because of that. Others
/// have slack. Returns whether there were some.
bool CrowdSteps::keep_apart(Crowd& crowd, double rounding) {
  vector<uint8_t> marks(crowd.rows.groups(), 0);
  for (int sweep = 0; sweep < tol::more_sweeps; ++sweep) {
    bool any = false;

    crowd.rows.for_each([&](size_t g, size_t lane) {
      const RowGroup& row = crowd.rows.hot[g];
      const double speed = crowd.rows.normal(g, lane).dot(crowd.drift(row.b[lane]) - crowd.drift(row.a[lane]));
      if (crowd.rows.state[g].gap[lane] + crowd.step.length * speed >= -rounding) return;
      any = true;
      marks[g] = 1;
    });
    if (!any) return sweep > 0;
    solver_.sweep(crowd.rows, crowd.v, crowd.step.length, marks, 4);
  }
  return true;
}

/// The longest drift (s) after which no two overlap by more than is allowed.
double CrowdSteps::safe_length(const Crowd& crowd) {
  const double allowed = max(tol::gap_rounding, quality_.overlap) * crowd.smallest;
  vector<double> found(crowd.rows.parts.size());
  threads_.each(crowd.rows, [&](size_t p) {
    const auto& [begin, balls, end] = crowd.rows.parts[p];
    found[p] = kernels_.safe_drift(crowd.rows.hot.data() + begin, crowd.rows.state.data() + begin, end - begin,
                                   crowd.v.data(), allowed);
  });
  return ranges::min(found);
}

/// The same impulses by the contact solver, where sweeps converge too slowly: masses are unequal, or bodies are jammed.
bool CrowdSteps::solve_exactly(Crowd& crowd) const {
  vector<Vec3> motion;
  vector<double> inverse_mass;
  for (size_t k = 0; k < crowd.members.size(); ++k) {
    motion.push_back(vector_of(free_[k]));
    inverse_mass.push_back(free_[k].at[3]);
  }

  // Rows as contacts that may close their gaps in the step.
  vector<ContactConstraint> pairs;
  crowd.rows.for_each([&](size_t g, size_t lane) {
    const RowGroup& row = crowd.rows.hot[g];
    const bool body = row.b[lane] < crowd.movable();
    ContactConstraint pair{row.a[lane], body ? row.b[lane] : ContactConstraint::fixed, crowd.rows.normal(g, lane),
                           -row.base[lane] / crowd.step.length};
    pair.force = row.impulse[lane];
    if (!body) pair.surface = pair.normal.dot(crowd.drift(row.b[lane]));
    pairs.push_back(pair);
  });
  if (!carom::solve({inverse_mass, motion, pairs}).solved()) return false;

  // The answer's impulses and drifts.
  auto pair = pairs.cbegin();
  crowd.rows.for_each([&](size_t g, size_t lane) { crowd.rows.hot[g].impulse[lane] = pair++->force; });
  for (size_t k = 0; k < motion.size(); ++k)
    for (int axis = 0; axis < 3; ++axis) crowd.v[k].at[axis] = motion[k][axis];
  return true;
}

/// The speed of approach of a row at this instant (m/s).
double CrowdSteps::approach(const Crowd& crowd, size_t group, size_t lane) const {
  const RowGroup& row = crowd.rows.hot[group];
  return crowd.rows.normal(group, lane).dot(vector_of(now_[row.a[lane]]) - vector_of(now_[row.b[lane]]));
}

/// The rows that begin to press, or that impacts have left with an approach, in order.
vector<RowPlace> CrowdSteps::closing_rows(const Crowd& crowd, double rounding) {
  vector<vector<RowPlace>> found(crowd.rows.parts.size());
  threads_.each(crowd.rows, [&](size_t p) {
    crowd.rows.for_each(crowd.rows.parts[p], [&](size_t g, size_t lane) {
      if (!(crowd.rows.hot[g].impulse[lane] > 0)) return;
      const RowState& state = crowd.rows.state[g];
      if (state.force[lane] == 0 || approach(crowd, g, lane) > max(state.slow[lane], rounding))
        found[p].push_back({g, lane});
    });
  });

  vector<RowPlace> all;
  for (const vector<RowPlace>& of_part : found) all.insert(all.end(), of_part.begin(), of_part.end());
  return all;
}

/// Takes away the approaches of pairs that begin to press, and those that impacts have left, as impacts of this instant
/// without a rebound. What is left of their impulses is force.
void CrowdSteps::absorb_approaches(Crowd& crowd) {
  const double rounding = tol::drift * greatest(now_);
  const vector<RowPlace> closing = closing_rows(crowd, rounding);
  if (closing.empty()) return;

  // One after the other, until nothing is left or all of an impulse is used.
  double work = 0;  // J
  bool any = true;
  for (int sweep = 0; any && sweep < quality_.impact_sweeps; ++sweep) {
    any = false;
    for (const auto& [g, lane] : closing) {
      RowGroup& row = crowd.rows.hot[g];
      const double speed = approach(crowd, g, lane);

      const double impulse = min(row.impulse[lane], speed * row.share[lane]);
      if (!(speed > rounding && impulse > 0)) continue;
      work += push(crowd, g, lane, impulse, before_);
      const auto& [a, e] = crowd.rows.names[g][lane];
      bodies_.contact_work.impulses.strike(bodies_.now, a, e, impulse);
      row.impulse[lane] -= impulse;
      if (sweep == 0) bodies_.log.take_up(speed, 0);
      any = true;
    }
  }

  if (work != 0) bodies_.log.add_work(work);
  const double before = crowd.step.kinetic;
  crowd.step.kinetic = kinetic_energy(crowd);
  take(crowd, before + work - crowd.step.kinetic, 0);
}

/// Finds the forces of a part of the rows in the step, and which members they press.
void CrowdSteps::find_forces(Crowd& crowd, size_t part) const {
  const auto& [begin, balls, end] = crowd.rows.parts[part];
  for (size_t g = begin; g < end; ++g) {
    const RowGroup& row = crowd.rows.hot[g];
    RowState& state = crowd.rows.state[g];
    for (size_t lane = 0; lane < CrowdRows::lanes; ++lane) {
      const uint32_t a = row.a[lane];
      const uint32_t b = row.b[lane];
      const double lag = a < crowd.movable() ? crowd.lag[a] : 0;
      state.carried[lane] = state.force[lane] * lag;
      state.force[lane] = row.impulse[lane] / (0.5 * crowd.step.length + lag);

      if (!(row.impulse[lane] > 0)) continue;
      crowd.pressed[a] = 1;
      if (b < crowd.movable()) crowd.pressed[b] = 1;
    }
  }
}

void CrowdSteps::finish(Crowd& crowd) {
  if (crowd.step.waits == 0) crowd.step.waited = 0;
  crowd.step.waits = max(crowd.step.waits - 1, 0);
  bodies_.log.count_crowd_step(crowd.step.solved);
  absorb_approaches(crowd);
  ranges::fill(crowd.pressed, 0);
  threads_.in_phases(crowd.rows, [&](size_t p) { find_forces(crowd, p); });

  for (size_t k = 0; k < crowd.members.size(); ++k) {
    crowd.v[k].at[3] = 1 / bodies_.world.mass[crowd.members[k]];
    crowd.a[k] = (crowd.drift(k) - vector_of(before_[k])) / (0.5 * crowd.step.length + crowd.lag[k]);
    crowd.idle[k] = crowd.pressed[k] != 0 ? 0 : uint8_t(min(crowd.idle[k] + 1, 255));
  }
}

}  // namespace carom
