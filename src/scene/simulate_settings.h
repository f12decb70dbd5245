#pragma once
// For how long a scene is simulated, and how: the keys of `simulate`.
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
  std::optional<double> tolerance;          // m; stepped only: the step is chosen for it
  std::optional<double> rest_speed;         // m/s
  std::optional<std::uint64_t> max_collisions;
  bool as_printed = false;  // book only
  bool merge = false;       // bodies that meet become one
};

}  // namespace carom
