#pragma once
// Which simulator a scene runs on.
#include <memory>
#include <string>

#include "scene/scene.h"
#include "simulate/simulator.h"

namespace carom {

struct EngineChoice {
  std::string name;  // "exact", "book"; as in summary.csv
  std::string why;   // one line, empty where the scene names the engine itself
};

/// Throws SimulationError if the scene asks for an engine that is not there.
EngineChoice choose_engine(const Simulate& simulate);

/// The scene's simulator at time 0. `scene` must outlive it. Throws SimulationError.
std::unique_ptr<Simulator> make_simulator(const Scene& scene, bool record_collisions);

/// The exact simulator, whatever engine the scene asks for: what really happens first.
std::unique_ptr<Simulator> make_oracle(const Scene& scene);

}  // namespace carom
