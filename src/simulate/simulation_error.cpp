// The simulators have numbers of bodies, not names. The message is therefore stored in parts, and the name replaces the
// number later.
#include "simulate/simulation_error.h"

#include <fmt/format.h>

#include <cmath>

namespace carom {

SimulationError::SimulationError(const std::string& before, Entity body, const std::string& after)
    : runtime_error(fmt::format("{}body {}{}", before, body, after)), about_{{before, body, after}} {}

SimulationError SimulationError::named(const std::function<std::string(Entity)>& name) const {
  return about_ ? SimulationError(about_->before + name(about_->body) + about_->after) : *this;
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
