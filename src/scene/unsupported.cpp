#include "scene/unsupported.h"

#include <fmt/format.h>

#include "physics/force.h"

namespace carom {

bool goes_along_parabolas(const World& world, const Simulate& simulate) {
  return (simulate.engine == Engine::exact || simulate.engine == Engine::automatic) && varying_force(world) == nullptr;
}

std::string open_force_text(const Force& force) {
  if (const Spring* spring = std::get_if<Spring>(&force.law); spring != nullptr)
    if (spring->rest_length != 0 || spring->damping != 0) return "a `spring` with a rest length or damping";
  if (const Attractor* attractor = std::get_if<Attractor>(&force.law); attractor != nullptr)
    return attractor->softening != 0 ? "a softened `attractor`" : "an `attractor` beside other forces";
  return std::holds_alternative<Drag>(force.law) ? "quadratic `drag`"
                                                 : fmt::format("a `{}` beside other forces", name_of(force.law));
}

std::vector<Unsupported> unsupported(const World& world, const Simulate& simulate) {
  std::vector<Unsupported> lacks;
  const Force *varying = varying_force(world), *open = force_without_closed_form(world);
  if (simulate.engine == Engine::exact && open != nullptr)
    lacks.push_back(
        {"engine",
         fmt::format("under {} paths have no closed form, which `engine: exact` follows", open_force_text(*open)),
         "expected `engine: stepped`, or `auto`"});
  const Force* bending = bending_force(world);
  const bool in_steps = simulate.engine == Engine::stepped || bending != nullptr;
  if (simulate.merge && simulate.engine != Engine::book && in_steps)
    lacks.push_back(
        {"contact",
         simulate.engine == Engine::stepped
             ? "`engine: stepped` has no `contact: merge`"
             : fmt::format("`contact: merge` is for parabolas and linear drag, not for `{}`", name_of(bending->law)),
         "expected `contact: bounce`"});
  if (simulate.engine != Engine::book) return lacks;
  // The chapter's listings know spheres, planes and walls, gravity and the impulses of the first frame.
  const auto lack = [&](const char* at, const char* what, const char* instead) {
    lacks.push_back({at, fmt::format("`engine: book` has no {}", what), fmt::format("expected {}", instead)});
  };
  if (simulate.merge) lack("contact", "`contact: merge`", "`engine: exact`");
  if (simulate.tolerance) lack("tolerance", "`tolerance`", "`step`");
  if (!world.volume.empty()) lack("engine", "cylinders and boxes: its bodies are spheres", "`engine: exact`");
  if (!world.obstacles.empty()) lack("obstacles", "obstacles", "`engine: exact`");
  if (!world.forces.empty())
    lack("forces", "forces beside gravity", varying == nullptr ? "`engine: exact`" : "`engine: stepped`");
  return lacks;
}

}  // namespace carom
