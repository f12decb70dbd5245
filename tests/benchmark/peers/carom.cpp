// carom itself: from event to event, and in steps.
#include "benchmark/peers/peer.h"
#include "simulate/exact.h"
#include "simulate/stepped.h"

namespace carom {
namespace {

class CaromWorld : public PeerWorld {
 public:
  CaromWorld(const Scene& scene, double step, bool exact) : scene_(scene), step_(step), exact_(exact) {}

  /// The simulator is made at the first step, so that what it predicts then counts as time of the run.
  void advance(int steps) override {
    if (!simulator_) simulator_ = made();
    steps_ += steps;
    const double until = static_cast<double>(steps_) * step_;
    while (simulator_->time() < until) simulator_->advance_to(until);
  }

  void read(State& state) override {
    const State& now = simulator_ ? simulator_->state() : scene_.initial;
    state.position = now.position;
    state.velocity = now.velocity;
  }

  std::uint64_t collisions() const override { return simulator_ ? simulator_->tally().collisions() : 0; }

 private:
  std::unique_ptr<Simulator> made() const {
    const double long_enough = 1e6;  // s
    if (exact_) {
      ExactOptions options;
      options.duration = long_enough;
      options.record_collisions = false;
      return make_exact_simulator(scene_.world, scene_.initial, options);
    }
    SteppedOptions options;
    options.duration = long_enough;
    options.step = step_;
    options.record_collisions = false;
    return make_stepped_simulator(scene_.world, scene_.initial, options);
  }

  const Scene& scene_;
  const double step_;
  const bool exact_;
  std::unique_ptr<Simulator> simulator_;
  long steps_ = 0;
};

}  // namespace

Peer carom_exact() {
  return {"carom exact", CAROM_VERSION, {}, 0, [](const Scene& scene, double step) {
            return std::make_unique<CaromWorld>(scene, step, true);
          }};
}

Peer carom_stepped() {
  return {"carom stepped", CAROM_VERSION, {60, 240, 960, 3840}, 240, [](const Scene& scene, double step) {
            return std::make_unique<CaromWorld>(scene, step, false);
          }};
}

}  // namespace carom
