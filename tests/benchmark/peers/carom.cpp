// carom itself, by events.
#include "benchmark/peers/peer.h"
#include "scene/scene.h"
#include "simulate/exact.h"
#include "version.h"

namespace carom {
namespace {

class CaromWorld : public PeerWorld {
 public:
  CaromWorld(const Scene& scene, double step) : scene_(scene), step_(step) {}

  /// The simulator is made at the first step, so that its first predictions count as run time.
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
    ExactOptions options;
    options.duration = 1e6;  // s, long enough
    options.record_collisions = false;
    return make_exact_simulator(scene_.world, scene_.initial, options);
  }

  const Scene& scene_;
  const double step_;
  std::unique_ptr<Simulator> simulator_;
  long steps_ = 0;
};

}  // namespace

Peer carom_exact() {
  return {"carom exact", program_version, {}, 0, [](const Scene& scene, double step) {
            return std::make_unique<CaromWorld>(scene, step);
          }};
}

}  // namespace carom
