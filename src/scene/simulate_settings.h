#pragma once
// The keys of `simulate`: how long and how a scene is simulated.

#include "physics/contact_quality.h"
#include "physics/integrator.h"
#include "std.h"

namespace carom {

enum class Engine : uint8_t { automatic, exact, stepped, book };

struct ContactSettings {
  bool merge = false;  // colliding bodies merge into one
  QualityLevel quality = QualityLevel::normal;
};

struct Simulate {
  double duration = 0;  // s
  Engine engine = Engine::automatic;
  /// Of engine stepped. The decoder sets dop853 where neither a step nor an integrator is given.
  Integrator integrator = Integrator::rk4;
  optional<double> step;  // s
  /// In m. Not of engine book: steps are chosen for this error.
  optional<double> tolerance;
  optional<double> rest_speed;  // m/s
  optional<uint64_t> max_collisions;
  bool as_printed = false;  // book only
  ContactSettings contact;
  // From `stop`; regions that stop are in the World. The run ends before its duration when all bodies are at rest, or
  // after so many collisions.
  bool stop_at_rest = false;
  optional<uint64_t> stop_collisions;
};

}  // namespace carom
