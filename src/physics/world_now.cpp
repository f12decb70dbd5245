// Windows of motions are kept beside the legs that are made of them, so that any number of their ends can be set.
#include "physics/world_now.h"

namespace carom {

namespace {

/// The time that an event sets.
double& end_of(World& world, const TriggeredEnd& end) {
  using Of = TriggeredEnd::Of;
  const auto pick = [&](auto& window) -> double& { return end.ends ? window.until : window.from; };

  if (end.of == Of::force) return pick(world.forces[end.index]);
  if (end.of == Of::body_spring) return pick(world.springs[end.index]);
  if (end.of == Of::gravitation) return pick(world.gravitations[end.index]);
  if (end.of == Of::motion) return pick(world.motions[end.index].windows[end.window]);
  return world.strings[end.index].until;
}

}  // namespace

void set_off(World& world, uint32_t trigger, double time) {
  for (const TriggeredEnd& end : world.triggers.ends) {
    if (end.trigger != trigger) continue;
    end_of(world, end) = time + end.after;
    if (end.of == TriggeredEnd::Of::motion) world.motions[end.index].follow_windows();
  }
}

void set_off(World& world, span<const double> fired) {
  for (uint32_t k = 0; k < fired.size(); ++k)
    if (fired[k] < not_yet) set_off(world, k, fired[k]);
}

vector<double> fired_by(span<const double> fired, double time) {
  vector<double> by(fired.begin(), fired.end());
  for (double& each : by)
    if (each > time) each = not_yet;
  return by;
}

WorldNow::WorldNow(const World& given)
    : given_(given), own_(given.triggers.all.empty() ? nullptr : make_unique<World>(given)) {}
WorldNow::WorldNow(WorldNow&&) noexcept = default;
WorldNow::~WorldNow() = default;

const World& WorldNow::at(span<const double> fired) {
  if (own_ == nullptr) return given_;
  for (uint32_t k = 0; k < fired.size(); ++k)
    if (fired[k] < not_yet && (fired_.empty() || fired_[k] == not_yet)) set_off(*own_, k, fired[k]);
  fired_.assign(fired.begin(), fired.end());
  return *own_;
}

}  // namespace carom
