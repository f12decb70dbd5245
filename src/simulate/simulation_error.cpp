// The simulators have numbers of bodies, not names. The message is therefore stored in parts, and the name replaces the
// number later.
#include "simulate/simulation_error.h"

#include <fmt/format.h>

#include "std.h"

namespace carom {

namespace {

string joined(const string& before, const vector<Entity>& things, const vector<string>& after,
              const function<string(Entity)>& name) {
  string text = before;
  for (size_t k = 0; k < things.size(); ++k) text += name(things[k]) + after[k];
  return text;
}

/// The name of a thing that has none.
string numbered(Entity e) {
  return fmt::format("body {}", e);
}

}  // namespace

SimulationError::SimulationError(const string& before, Entity body, const string& after)
    : SimulationError(before, vector{body}, {after}) {}

SimulationError::SimulationError(string before, vector<Entity> things, vector<string> after)
    : runtime_error(joined(before, things, after, numbered)),
      before_(std::move(before)),
      things_(std::move(things)),
      after_(std::move(after)) {}

SimulationError SimulationError::named(const function<string(Entity)>& name) const {
  return things_.empty() ? *this : SimulationError(joined(before_, things_, after_, name));
}

void fail_out_of_bounds(const Bounds& bounds, Entity body, double time, const Vec3& x, const Vec3& v,
                        const Remedies& remedies) {
  const string when = fmt::format("at t = {} s ", time);
  const double speed = v.norm();

  if (!isfinite(speed))
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
