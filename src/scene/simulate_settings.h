#pragma once
// The keys of `simulate`: how long and how a scene is simulated.
#include <cstdint>
#include <optional>

#include "physics/integrator.h"

namespace carom {

enum class Engine : std::uint8_t { automatic, exact, stepped, book };

struct Simulate {
  double duration = 0;  // s
  Engine engine = Engine::automatic;
  Integrator integrator = Integrator::rk4;  // stepped only
  std::optional<double> step;               // s
  /// In m. Only of the stepped engine, which chooses its step for this error.
  std::optional<double> tolerance;
  std::optional<double> rest_speed;  // m/s
  std::optional<std::uint64_t> max_collisions;
  bool as_printed = false;  // book only
  bool merge = false;       // colliding bodies merge into one
};

}  // namespace carom
