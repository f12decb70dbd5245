// The simulators have numbers of bodies, not names. The message is therefore stored in parts, and the name replaces the
// number later.
#include "simulate/simulation_error.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace carom {

namespace {

std::string joined(const std::string& before, const std::vector<Entity>& things, const std::vector<std::string>& after,
                   const std::function<std::string(Entity)>& name) {
  std::string text = before;
  for (std::size_t k = 0; k < things.size(); ++k) text += name(things[k]) + after[k];
  return text;
}

/// The name of a thing that has none.
std::string numbered(Entity e) {
  return fmt::format("body {}", e);
}

}  // namespace

SimulationError::SimulationError(const std::string& before, Entity body, const std::string& after)
    : SimulationError(before, std::vector{body}, {after}) {}

SimulationError::SimulationError(std::string before, std::vector<Entity> things, std::vector<std::string> after)
    : runtime_error(joined(before, things, after, numbered)),
      before_(std::move(before)),
      things_(std::move(things)),
      after_(std::move(after)) {}

SimulationError SimulationError::named(const std::function<std::string(Entity)>& name) const {
  return things_.empty() ? *this : SimulationError(joined(before_, things_, after_, name));
}

void fail_out_of_bounds(const Bounds& bounds, Entity body, double time, const Vec3& x, const Vec3& v,
                        const Remedies& remedies) {
  const std::string when = fmt::format("at t = {} s ", time);
  const double speed = v.norm();

  if (!std::isfinite(speed))
    throw SimulationError(when, body, fmt::format("'s speed is no longer finite: {}", remedies.speed));
  if (speed > bounds.speed)
    throw SimulationError(when, body,
                          fmt::format("'s speed is {:.4g} m/s, more than the limit of {:g} m/s: {}", speed,
                                      bounds.speed, remedies.speed));

  throw SimulationError(
      when, body,
      fmt::format(" is {:.4g} m from the origin, more than {:g} times the smallest size of the scene, where doubles no "
                  "longer resolve it: {}",
                  x.cwiseAbs().maxCoeff(), farthest_by_size, remedies.place));
}

}  // namespace carom
