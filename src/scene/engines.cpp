// One function for each engine lists what it lacks for a world, as text for a message.
// Refusing is preferred to approximating: an engine never silently ignores a part of the scene.
#include "scene/engines.h"

#include <fmt/format.h>

#include "physics/force.h"
#include "physics/world.h"
#include "scene/field.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

namespace {

using Lacks = vector<Unsupported>;

void exact_lacks(const World& world, const Simulate& simulate, Lacks& lacks) {
  if (const Force* open = force_without_closed_form(world))
    lacks.push_back(
        {"engine",
         fmt::format("under {} paths have no closed form, which `engine: exact` follows", open_force_text(*open)),
         "expected `engine: stepped`, or `auto`"});

  if (simulate.contact.merge && !world.strings.empty())
    lacks.push_back({"contact", "`contact: merge` is for parabolas and linear drag, not for `strings`",
                     "expected `contact: bounce`"});

  if (const Force* bending = bending_force(world); bending != nullptr && simulate.contact.merge)
    lacks.push_back(
        {"contact",
         fmt::format("`contact: merge` is for parabolas and linear drag, not for `{}`", name_of(bending->law)),
         "expected `contact: bounce`"});
}

void stepped_lacks(const World& world, const Simulate& simulate, Lacks& lacks) {
  if (!simulate.contact.merge) return;
  // If `auto` excludes the exact engine, name the force that is the cause.
  const Force* bending = simulate.engine == Engine::automatic ? bending_force(world) : nullptr;
  lacks.push_back({"contact",
                   bending == nullptr ? "`engine: stepped` has no `contact: merge`"
                                      : fmt::format("`contact: merge` is for parabolas and linear drag, not for `{}`",
                                                    name_of(bending->law)),
                   "expected `contact: bounce`"});
}

// The chapter's listings cover spheres, planes and walls, gravity and the impulses of the first frame.
void book_lacks(const World& world, const Simulate& simulate, Lacks& lacks) {
  const auto lack = [&](const char* at, const char* what, const char* instead) {
    lacks.push_back({at, fmt::format("`engine: book` has no {}", what), fmt::format("expected {}", instead)});
  };

  // Settings.
  if (simulate.contact.merge) lack("contact", "`contact: merge`", "`engine: exact`");
  if (simulate.tolerance) lack("tolerance", "`tolerance`", "`step`");

  // Things.
  if (!world.volume.empty()) lack("engine", "cylinders and boxes: its bodies are spheres", "`engine: exact`");
  if (!world.obstacles.empty()) lack("obstacles", "obstacles", "`engine: exact`");
  if (!world.strings.empty()) lack("strings", "strings", "`engine: exact`");
  if (world.moves()) lack("engine", "fixed things that move", "`engine: exact`");
  if (any_of(world.regions, [](const WorldRegion& region) { return region.removes; }))
    lack("regions", "regions with `action: remove`", "`engine: exact`");

  if (!world.forces.empty())
    lack("forces", "forces other than gravity",
         varying_force(world) == nullptr ? "`engine: exact`" : "`engine: stepped`");
}

}  // namespace

string_view name_of(Engine engine) {
  return parts_of(engine_names)[size_t(engine)];
}

string_view name_of(QualityLevel level) {
  return parts_of(quality_names)[size_t(level)];
}

string_view name_of(Integrator integrator) {
  return parts_of(integrator_names)[size_t(integrator)];
}

Engine engine_of(const World& world, const Simulate& simulate) {
  if (simulate.engine != Engine::automatic) return simulate.engine;
  return force_without_closed_form(world) == nullptr ? Engine::exact : Engine::stepped;
}

bool goes_along_parabolas(const World& world, const Simulate& simulate) {
  return engine_of(world, simulate) == Engine::exact && varying_force(world) == nullptr;
}

string open_force_text(const Force& force) {
  if (const Spring* spring = std::get_if<Spring>(&force.law); spring != nullptr)
    if (spring->rest_length != 0 || spring->damping != 0) return "a `spring` with a rest length or damping";
  if (const Attractor* attractor = std::get_if<Attractor>(&force.law); attractor != nullptr)
    return attractor->softening != 0 ? "a softened `attractor`" : "an `attractor` with other forces";
  return std::holds_alternative<Drag>(force.law) ? "quadratic `drag`"
                                                 : fmt::format("a `{}` with other forces", name_of(force.law));
}

Lacks unsupported(const World& world, const Simulate& simulate) {
  static constexpr void (*of_engine[])(const World&, const Simulate&, Lacks&) = {nullptr, exact_lacks, stepped_lacks,
                                                                                 book_lacks};
  Lacks lacks;
  of_engine[size_t(engine_of(world, simulate))](world, simulate, lacks);
  return lacks;
}

}  // namespace carom
