#pragma once
// Which simulator a scene runs on.
#include <memory>
#include <string>

#include "scene/scene.h"
#include "simulate/simulator.h"

namespace carom {

struct EngineChoice {
  std::string name;  // "exact", "stepped", "book"; as in summary.csv
  std::string why;   // one line, empty where the scene names the engine itself
};

EngineChoice choose_engine(const Scene& scene);

/// The scene's simulator at time 0. `scene` must outlive it. Throws SimulationError.
std::unique_ptr<Simulator> make_simulator(const Scene& scene, bool record_collisions);

/// The most exact simulator that there is for the scene, whatever engine it asks for: what really happens first.
std::unique_ptr<Simulator> make_oracle(const Scene& scene);

}  // namespace carom
