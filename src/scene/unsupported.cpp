#include "scene/unsupported.h"

#include <fmt/format.h>

#include "physics/force.h"

namespace carom {

bool goes_along_parabolas(const World& world, const Simulate& simulate) {
  return (simulate.engine == Engine::exact || simulate.engine == Engine::automatic) && varying_force(world) == nullptr;
}

std::vector<Unsupported> unsupported(const World& world, const Simulate& simulate) {
  std::vector<Unsupported> lacks;
  const Force *varying = varying_force(world), *open = force_without_closed_form(world);
  if (simulate.engine == Engine::exact && open != nullptr)
    lacks.push_back({"engine",
                     fmt::format("under {}`{}` paths have no closed form, which `engine: exact` follows",
                                 std::holds_alternative<Drag>(open->law) ? "quadratic " : "", name_of(open->law)),
                     "expected `engine: stepped`, or `auto`"});
  const bool in_steps = simulate.engine == Engine::stepped || open != nullptr;
  if (simulate.merge && simulate.engine != Engine::book && in_steps)
    lacks.push_back(
        {"contact",
         simulate.engine == Engine::stepped
             ? "`engine: stepped` has no `contact: merge`"
             : fmt::format("`contact: merge` is for paths in closed form, not for `{}`", name_of(open->law)),
         "expected `contact: bounce`"});
  if (simulate.tolerance && simulate.integrator == Integrator::dop853)
    lacks.push_back({"tolerance", "`integrator: dop853` has no `tolerance`: its steps are as exact as numbers allow",
                     "expected no `tolerance`, or another integrator"});
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
