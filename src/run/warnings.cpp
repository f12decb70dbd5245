// A run is doubtful where its own books tell that it is wrong, or where doubles do not resolve its motion. Each warning
// says by how much, and what to do about it. None of this changes a figure.
#include "run/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "physics/bounds.h"
#include "scene/scene.h"

namespace carom {

namespace {

constexpr double residual_share = 1e-3;      // of the energy turned over: an error of the method that shows in figures
constexpr double energy_rounding = 0x1p-40;  // of energies: a difference of theirs that is rounding
constexpr double longest_phase = 1;          // rad, of a step: forces that change faster are not followed
constexpr double place_rounding = 0x1p-53;   // of coordinates
constexpr double told_place = 1e-6;          // of the smallest size: to which places are to be told

/// Whether a method with steps of one length carries free flights.
bool has_fixed_steps(const Scene& scene, const EngineChoice& engine) {
  return engine.engine == Engine::stepped && scene.simulate.integrator != Integrator::dop853;
}

class Warnings {
 public:
  Warnings(const Scene& scene, const EngineChoice& engine, const State& end, const Summary& summary, const Tally& tally)
      : scene_(scene), engine_(engine), end_(end), summary_(summary), tally_(tally) {}

  std::vector<Warning> all() {
    if (!engine_.shortfall.empty()) add("tolerance", engine_.shortfall);
    look_at_energy();
    look_at_steps();
    look_at_contact();
    look_at_digits();
    return std::move(all_);
  }

 private:
  void add(const char* code, std::string text) { all_.push_back({code, std::move(text)}); }

  /// What to do about an error of the method.
  std::string remedy() const {
    if (has_fixed_steps(scene_, engine_)) return "use a shorter simulate.step, or `integrator: dop853`";
    if (engine_.engine == Engine::book) return "use `engine: exact` for true impacts, or a shorter simulate.step";
    if (summary_.stepped_contact > 0)
      return "lasting contact was computed in time steps, to first order: compare figures that depend on it with those "
             "of other seeds";
    return "shorten simulate.duration, or soften the attractor";
  }

  void look_at_energy() {
    const EnergyTotals& energy = summary_.energy;
    const double residual = energy.residual;
    const double least = energy_rounding * std::max(std::abs(energy.start), std::abs(energy.end));
    if (std::isfinite(residual) && std::abs(residual) <= std::max(residual_share * energy.turnover, least)) return;
    add("energy", fmt::format("the method {} {:.3g} J beyond impacts and work, {:.2g} of the energy turned over: {}",
                              residual > 0 ? "gained" : "lost", std::abs(residual),
                              std::abs(residual) / energy.turnover, remedy()));
  }

  void look_at_steps() {
    if (!(tally_.greatest_phase > longest_phase)) return;
    add("step",
        fmt::format(
            "forces turned by {:.3g} rad in a step, which resolves at most 1: use steps of at most {:.2g} s, or "
            "`integrator: dop853`",
            tally_.greatest_phase, *engine_.steps.length * 0.1 / tally_.greatest_phase));
  }

  void look_at_contact() {
    if (tally_.doubtful == 0) return;
    add("contact", fmt::format("{} contact problem{} not solved to rounding: make masses less unequal", tally_.doubtful,
                               tally_.doubtful == 1 ? " was" : "s were"));
  }

  /// Of places that are far from the origin, and of instants that are late for their speed.
  void look_at_digits() {
    const double size = smallest_size(scene_.world);
    double farthest = 0;
    for (const Vec3& x : end_.position) farthest = std::max(farthest, x.cwiseAbs().maxCoeff());
    if (place_rounding * farthest > told_place * size)
      add("place",
          fmt::format("bodies are {:.3g} m from the origin, where doubles resolve positions to {:.2g} m: shorten "
                      "simulate.duration, or move the scene nearer to the origin",
                      farthest, place_rounding * farthest));
    const double path = tally_.max_speed * summary_.duration;
    if (place_rounding * path > told_place * size)
      add("speed", fmt::format("at {:.3g} m/s the clock resolves positions to {:.2g} m: shorten simulate.duration",
                               tally_.max_speed, place_rounding * path));
  }

  const Scene& scene_;
  const EngineChoice& engine_;
  const State& end_;
  const Summary& summary_;
  const Tally& tally_;
  std::vector<Warning> all_;
};

}  // namespace

std::vector<Warning> warnings_of(const Scene& scene, const EngineChoice& engine, const State& end,
                                 const Summary& summary, const Tally& tally) {
  return Warnings(scene, engine, end, summary, tally).all();
}

}  // namespace carom
