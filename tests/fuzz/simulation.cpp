#include "fuzz/simulation.h"

#include <fmt/format.h>

#include <ctime>

#include "engine/engine.h"
#include "physics/body_now.h"
#include "physics/coupled_forces.h"
#include "physics/energy.h"
#include "physics/force.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "simulate/loop/exact_simulator.h"
#include "std.h"

namespace carom::fuzz {

namespace {

constexpr int instants = 16;
constexpr int most_idle = 100'000;  // calls in which a simulator may neither advance nor record
constexpr double relative_rounding = 2e-14;
constexpr double in_islands = 1e-10;
constexpr double unbalanced = 1e-8, unbalanced_in_crowds = 1e-4;
constexpr double touching = 2e-11;  // of a radius: a body appears where it overlaps others by less

class Run {
 public:
  Run(const Scene& scene, double patience, Outcome& outcome)
      : scene_(scene), world_(scene.world), patience_(patience), outcome_(outcome) {}

  void run() {
    const EngineChoice engine = choose_engine(scene_);
    outcome_.engine = name_of(engine.engine);
    exact_ = engine.engine == Engine::exact && varying_force(world_) == nullptr && !has_couplings(world_);
    balanced_ = engine.engine == Engine::exact;
    book_ = engine.engine == Engine::book;

    try {
      simulator_ = make_simulator(scene_, {.collisions = true}, engine.steps);
      const long double before = energy();
      const double stored = kinetic_energy(world_, simulator_->state()) + potential_energy(world_, simulator_->state());

      if (!go_to(0) || !check_state()) return;
      for (int k = 1; k <= instants; ++k) {
        if (!go_to(k == instants ? scene_.simulate.duration : scene_.simulate.duration * k / instants) ||
            !check_state())
          return;
      }

      const Tally& tally = simulator_->tally();
      outcome_.collisions = tally.collisions();
      if (counted_ != tally.collisions())
        fail(fmt::format("{} collisions are recorded and {} counted", counted_, tally.collisions()));
      rows(tally);
      transitions();

      if (exact_) books(static_cast<double>(energy() - before), tally);
      if (exact_) overlaps(tally);
      if (balanced_) balance(stored, tally);
    } catch (const SimulationError& error) {
      outcome_.stopped = error.what();
      if (outcome_.stopped.empty()) fail("an error without a text");
    }
  }

 private:
  /// Bodies change their modes only as the table of modes says.
  void transitions() {
    const auto* const exact = dynamic_cast<const ExactSimulator*>(simulator_.get());
    if (exact == nullptr) return;
    for (size_t from = 0; from < number_of_modes; ++from)
      for (size_t to = 0; to < number_of_modes; ++to)
        if (exact->modes().counts()[from][to] > 0 && !may_become(static_cast<Mode>(from), static_cast<Mode>(to)))
          fail(fmt::format("a body changes from mode {} to {}", from, to));
  }

  void fail(string what) {
    if (outcome_.violations.size() < 12) outcome_.violations.push_back(std::move(what));
  }

  /// FNV-1a.
  void hash(const void* bytes, size_t size) {
    for (size_t k = 0; k < size; ++k)
      outcome_.hash = (outcome_.hash ^ static_cast<const unsigned char*>(bytes)[k]) * 0x100000001b3u;
  }
  void hash(double x) { hash(&x, sizeof x); }
  void hash(const Vec3& v) { hash(v.data(), 3 * sizeof(double)); }

  double time_spent() const { return static_cast<double>(std::clock() - begin_) / CLOCKS_PER_SEC; }

  /// False: it does not reach the time.
  bool go_to(double time) {
    int idle = 0;
    do {
      const double before = simulator_->time();
      simulator_->advance_to(time);
      const double now = simulator_->time();

      if (!(now >= before) || now > time) {
        fail(fmt::format("from {} s on to {} s it gets to {} s", before, time, now));
        return false;
      }

      for (const Collision& c : simulator_->collisions()) record(c);
      idle = now > before || !simulator_->collisions().empty() ? 0 : idle + 1;
      if (idle > most_idle) {
        fail(fmt::format("time stands still at {} s", now));
        return false;
      }

      if (time_spent() > patience_) {
        fail(fmt::format("takes more than {} s of CPU time; {} s of {} s are done, with {} collisions", patience_, now,
                         scene_.simulate.duration, counted_));
        return false;
      }
    } while (simulator_->time() < time);
    return true;
  }

  bool check_state() {
    const State& state = simulator_->state();
    for (Entity i = 0; i < world_.body_count(); ++i) {
      if (!state.position[i].allFinite() || !state.velocity[i].allFinite()) {
        fail(fmt::format("body {} is nowhere at {} s", i, state.time));
        return false;
      }
      hash(state.position[i]);
      hash(state.velocity[i]);
      extent_ = std::max(extent_, state.position[i].cwiseAbs().sum() + world_.radius[i]);
    }

    if (state.time != simulator_->time()) fail("the state is of another time");
    return true;
  }

  long double energy() {
    const State& state = simulator_->state();
    long double sum = 0;
    double all = 0;
    for (Entity i = 0; i < world_.body_count(); ++i) {
      if (is_gone(state, i)) continue;
      const long double m = world_.mass[i];
      const long double kinetic = 0.5L * m * state.velocity[i].cast<long double>().squaredNorm();
      sum += kinetic + potential(world_, i, state.position[i]);
      all += static_cast<double>(kinetic) + pull(i) * extent_;
    }

    size_ = std::max(size_, all);
    return sum;
  }

  /// N, at most, of forces with a potential, when all are constant.
  double pull(Entity i) const {
    double sum = world_.mass[i] * world_.gravity.cwiseAbs().sum();
    for (const Force& f : world_.forces) {
      if (const auto* uniform = std::get_if<UniformForce>(&f.law)) sum += uniform->force.cwiseAbs().sum();
      if (const auto* uniform = std::get_if<UniformAcceleration>(&f.law))
        sum += world_.mass[i] * uniform->value.cwiseAbs().sum();
    }
    return sum;
  }

  /// Energy is lost only in collisions, except for rounding. (Merged bodies have the masses of several.)
  void books(double gain, const Tally& tally) {
    if (scene_.simulate.contact.merge) return;
    const double relative =
        relative_rounding * (1 + sqrt(static_cast<double>(counted_))) + (tally.collapses > 0 ? in_islands : 0);
    const double size = size_ + std::abs(tally.energy_lost) + std::abs(tally.work) +
                        std::abs(tally.changes.removed.energy) + std::abs(tally.changes.appeared.energy);
    if (!(std::abs(gain + tally.energy_lost + tally.method_error + tally.changes.removed.energy -
                   tally.changes.appeared.energy - tally.work) <= relative * size))
      fail(fmt::format("energy books: gains {} J, lost {} J, work {} J, of {} J", gain, tally.energy_lost, tally.work,
                       size));
  }

  /// The same under any forces.
  void balance(double stored, const Tally& tally) {
    const State& end = simulator_->state();
    const double potential = potential_energy(world_, end);
    const double gain = kinetic_energy(world_, end) + potential - stored;
    const WorldChanges& changes = tally.changes;
    const double size = size_ + std::abs(stored) + std::abs(potential) + std::abs(tally.energy_lost) +
                        std::abs(tally.work) + std::abs(changes.removed.energy) + std::abs(changes.appeared.energy);
    const double residual =
        gain + tally.energy_lost + tally.method_error + changes.removed.energy - changes.appeared.energy - tally.work;
    if (!(std::abs(residual) <= (tally.stepped_contact > 0 ? unbalanced_in_crowds : unbalanced) * size))
      fail(fmt::format("energy balance: residual {} J, gains {} J, lost {} J, work {} J, of {} J", residual, gain,
                       tally.energy_lost, tally.work, size));
  }

  /// What the records have lost, and what contact has absorbed without a record, is all that is lost.
  void rows(const Tally& tally) {
    const double off = static_cast<double>(lost_ + tally.taken_up.energy - tally.energy_lost);
    if (!(std::abs(off) <= 1e-9 * (turned_ + std::abs(tally.taken_up.energy))))
      fail(fmt::format("rows lose {} J more than the run, of {} J", off, turned_));
  }

  void overlaps(const Tally& tally) {
    double extent = extent_, largest = 0;
    for (const Wall& w : world_.walls)
      extent = std::max(extent, w.center.cwiseAbs().sum() + w.half_width + w.half_height);
    for (const Obstacle& o : world_.obstacles) extent = std::max(extent, o.center.cwiseAbs().sum() + o.volume.reach());
    for (const Plane& p : world_.planes) extent = std::max(extent, p.point.cwiseAbs().sum());
    for (const double r : world_.radius) largest = std::max(largest, r);
    const double allowed = 2 * relative_rounding * extent + (tally.collapses > 0 ? in_islands * largest : 0) +
                           (world_.appears.empty() ? 0 : touching * largest);
    if (!(tally.max_overlap <= allowed)) fail(fmt::format("bodies overlap by {} m", tally.max_overlap));
  }

  void record(const Collision& c) {
    const string what = fmt::format("record of {} and {} at {} s: ", c.a, c.b, c.time);
    if (!(c.time >= last_) || c.time < 0 || c.time > scene_.simulate.duration)
      fail(what + fmt::format("it comes after one at {} s", last_));
    last_ = std::max(last_, c.time);

    for (const double x : {c.time, c.approach_speed, c.separation_speed, c.impulse, c.energy_lost}) hash(x);
    hash(&c.a, sizeof c.a);
    hash(&c.b, sizeof c.b);
    hash(c.position);
    hash(c.normal);
    lost_ += c.energy_lost;
    turned_ += std::abs(c.energy_lost);

    if (c.kind == CollisionKind::rest) return;
    ++counted_;
    if (!c.position.allFinite() || !c.normal.allFinite() || !isfinite(c.approach_speed) ||
        !isfinite(c.separation_speed) || !isfinite(c.impulse) || !isfinite(c.energy_lost))
      return fail(what + "not finite");

    if (c.kind == CollisionKind::merge) return;
    if (std::abs(c.normal.norm() - 1) > 1e-14) fail(what + fmt::format("its normal has length {}", c.normal.norm()));
    // The chapter's program lets separating bodies collide, and its printed listings add energy.
    if (book_) return;
    if (c.approach_speed < 0) fail(what + fmt::format("they separate at {} m/s", -c.approach_speed));
    if (c.restitution <= 1 && c.energy_lost < 0)
      fail(what + fmt::format("makes {} J at {} m/s", -c.energy_lost, c.approach_speed));
  }

  const Scene& scene_;
  const World& world_;
  const double patience_;  // s
  Outcome& outcome_;
  const std::clock_t begin_ = std::clock();
  unique_ptr<Simulator> simulator_;
  bool exact_ = false, balanced_ = false, book_ = false;
  double last_ = 0;       // s, of the last record
  double extent_ = 0;     // m, of the farthest place
  double size_ = 0;       // J, without signs
  long double lost_ = 0;  // J, by the records
  double turned_ = 0;     // J, the same without signs
  uint64_t counted_ = 0;
};

}  // namespace

Outcome simulate(const Scene& scene, double patience) {
  Outcome outcome;
  Run(scene, patience, outcome).run();
  return outcome;
}

}  // namespace carom::fuzz
