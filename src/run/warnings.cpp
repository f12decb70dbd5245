// A run is doubtful if its own totals show an error, or if doubles do not resolve its motion.
// Each warning gives the size of the error and the remedy. Warnings change no result.
#include "run/warnings.h"

#include <fmt/format.h>

#include <variant>

#include "physics/bounds.h"
#include "physics/force.h"
#include "physics/stability.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

namespace {

/// Of the energy turned over. A larger residual is an error of the method that shows in results.
constexpr double residual_share = 1e-3;
/// Of the steps of crowds. More of them without accurate forces show in results.
constexpr double unsolved_share = 0.01;
/// Of energies. A smaller difference is rounding.
constexpr double energy_rounding = 0x1p-40;
/// In rad, of a step. Forces that turn faster are not resolved.
constexpr double longest_phase = 1;
constexpr double accurate_phase = 0.1;  // rad, of a step that is proposed
/// A ratio of masses that makes contact problems hard. Below it the advice is another one.
constexpr double unequal_masses = 100;
constexpr double place_rounding = 0x1p-53;  // of coordinates
/// Of the smallest size. The resolution that positions must have.
constexpr double place_resolution = 1e-6;

/// Whether free flights are integrated with fixed steps.
bool has_fixed_steps(const Scene& scene, const EngineChoice& engine) {
  return engine.engine == Engine::stepped && scene.simulate.integrator != Integrator::dop853;
}

class Warnings {
 public:
  Warnings(const Scene& scene, const EngineChoice& engine, const State& end, const Summary& summary, const Tally& tally)
      : scene_(scene), engine_(engine), end_(end), summary_(summary), tally_(tally) {}

  vector<Warning> all() {
    if (!engine_.shortfall.empty()) add("tolerance", engine_.shortfall);
    check_energy();
    check_steps();
    check_contact();
    check_crowds();
    check_rest();
    check_digits();
    return std::move(all_);
  }

 private:
  void add(const char* code, string text) { all_.push_back({code, std::move(text)}); }

  /// The remedy for an error of the method.
  string remedy() const {
    if (has_fixed_steps(scene_, engine_)) return "use a shorter simulate.step, or `integrator: dop853`";
    if (engine_.engine == Engine::book) return "use `engine: exact` for true impacts, or a shorter simulate.step";
    if (summary_.stepped_contact > 0)
      return "lasting contact of many bodies was computed in steps: use a finer simulate.contact.quality, and compare "
             "dependent figures across several seeds";
    const vector<Force>& forces = scene_.world.forces;
    const bool attracts =
        any_of(forces, [](const Force& force) { return std::holds_alternative<Attractor>(force.law); });
    if (!scene_.world.gravitations.empty()) return "shorten simulate.duration, or soften `gravitation`";
    return attracts ? "shorten simulate.duration, or soften the attractor" : "shorten simulate.duration";
  }

  void check_energy() {
    const EnergyTotals& energy = summary_.energy;
    const double residual = energy.residual;
    const double least = energy_rounding * max(std::abs(energy.start), std::abs(energy.end));
    if (isfinite(residual) && std::abs(residual) <= max(residual_share * energy.turnover, least)) return;
    add("energy", fmt::format("the method {} {:.3g} J beyond impacts and work, {:.2g} of the energy turned over: {}",
                              residual > 0 ? "gained" : "lost", std::abs(residual),
                              std::abs(residual) / energy.turnover, remedy()));
  }

  /// Steps in which forces turn by more than a radian. The text has the stable step, which may be longer: rk4 then
  /// takes the energy.
  void check_steps() {
    const StiffStep& step = tally_.doubts.stiffest;
    if (!(step.phase > longest_phase)) return;

    // The stable step, and what the method leaves of an amplitude.
    const Integrator method = scene_.simulate.integrator;
    LinearMode mode;
    const double stable = stable_step(method, force_jacobian(scene_.world, step.body, step.time, step.x, step.v), mode);

    string text = fmt::format("forces turned by {:.3g} rad in a step of {:.3g} s", step.phase, step.length);
    if (const string stiff = stiffest_force(step); !stiff.empty())
      text += fmt::format(", most by {} on `{}`", stiff, scene_.roster.name(step.body));
    const double left = growth(method, mode, step.length);
    if (step.length > stable)
      text += fmt::format(", beyond stability: {} is stable up to {:.3g} s", name_of(method), stable);
    else if (mode.damping == 0 && left < 0.995)
      text += fmt::format(", stable up to {:.3g} s, but {} leaves {:.2g} of an amplitude in each step", stable,
                          name_of(method), left);

    add("step", text + fmt::format(": use steps of at most {:.2g} s, or `integrator: dop853`",
                                   step.length * accurate_phase / step.phase));
  }

  /// The path in the scene of the force that changes fastest in a step; empty: none acts.
  string stiffest_force(const StiffStep& step) const {
    const World& world = scene_.world;
    double greatest = 0;
    string name;

    for (size_t k = 0; k < world.forces.size(); ++k) {
      if (!acts(world.forces[k], step.body, step.time)) continue;
      const double rate = std::visit(
          [&](const auto& law) {
            return law.rate({step.x, step.v, world.mass[step.body]});
          },
          world.forces[k].law);
      if (rate > greatest) greatest = rate, name = fmt::format("forces.{}.{}", k, name_of(world.forces[k].law));
    }
    return name;
  }

  void check_contact() {
    if (tally_.doubts.contacts == 0) return;
    const auto [least, most] = std::minmax_element(scene_.world.mass.begin(), scene_.world.mass.end());
    const bool unequal = least != scene_.world.mass.end() && *most > unequal_masses * *least;
    add("contact",
        fmt::format("{} contact problem{} not solved to rounding: {}", tally_.doubts.contacts,
                    tally_.doubts.contacts == 1 ? " was" : "s were",
                    unequal ? fmt::format("make masses less unequal, which are from {:.3g} to {:.3g} kg", *least, *most)
                            : "compare dependent figures with those of a start that differs slightly"));
  }

  /// Warns of crowds whose errors made energy, and of many steps with forces less accurate than they should be.
  void check_crowds() {
    const Doubts& doubts = tally_.doubts;
    if (doubts.contact_made > residual_share * summary_.energy.turnover)
      add("contact", fmt::format("errors of lasting contact made {:.3g} J, {:.2g} of the energy turned over: {}",
                                 doubts.contact_made, doubts.contact_made / summary_.energy.turnover, remedy()));
    const auto unsolved = double(doubts.unsolved_steps);
    if (!(unsolved > unsolved_share * double(doubts.crowd_steps))) return;
    add("contact", fmt::format("forces were not as accurate as they should be in {} of {} steps of lasting contact: {}",
                               doubts.unsolved_steps, doubts.crowd_steps, remedy()));
  }

  /// Warns of a body that fell asleep in balance although forces would have moved it noticeably.
  void check_rest() {
    const Unbalanced& left = tally_.doubts.unbalanced;
    if (!(left.way > place_resolution * smallest_size(scene_.world))) return;
    add("rest", fmt::format("forces that count as balanced leave `{}`, at rest, an acceleration of {:.2g} m/s^2, which "
                            "could move it by {:.2g} m in the rest of the run: make masses less unequal, or shorten "
                            "simulate.duration",
                            scene_.roster.name(left.body), left.acceleration, left.way));
  }

  /// Warns of positions far from the origin, and of clock times too coarse for the speeds.
  void check_digits() {
    const double size = smallest_size(scene_.world);
    double farthest = 0;
    for (const Vec3& x : end_.position) farthest = max(farthest, x.cwiseAbs().maxCoeff());
    if (place_rounding * farthest > place_resolution * size)
      add("place",
          fmt::format("bodies are {:.3g} m from the origin, where doubles resolve positions to {:.2g} m: shorten "
                      "simulate.duration, or move the scene nearer to the origin",
                      farthest, place_rounding * farthest));
    const double path = tally_.fastest.speed * summary_.duration;
    if (place_rounding * path > place_resolution * size)
      add("speed", fmt::format("at {:.3g} m/s the clock resolves positions to {:.2g} m: shorten simulate.duration",
                               tally_.fastest.speed, place_rounding * path));
  }

  const Scene& scene_;
  const EngineChoice& engine_;
  const State& end_;
  const Summary& summary_;
  const Tally& tally_;
  vector<Warning> all_;
};

}  // namespace

vector<Warning> warnings_of(const Scene& scene, const EngineChoice& engine, const State& end, const Summary& summary,
                            const Tally& tally) {
  return Warnings(scene, engine, end, summary, tally).all();
}

}  // namespace carom
