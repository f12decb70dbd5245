// One function for each engine lists what it lacks for a world, as text for a message.
// Refusing is preferred to approximating: an engine never silently ignores a part of the scene.
#include "scene/engines.h"

#include <fmt/format.h>

#include "physics/coupled_forces.h"
#include "physics/force.h"
#include "physics/world.h"
#include "scene/field.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

namespace {

using Lacks = vector<Unsupported>;

/// The first of the forces between bodies, in words.
string_view coupling_text(const World& world) {
  return world.springs.empty() ? "`gravitation`" : "springs between bodies";
}

/// Joint bodies have the forces on all their parts. Not all laws are the same for the sum.
void merge_lacks(const World& world, Lacks& lacks) {
  for (const Force& force : world.forces) {
    if (!bends(force.law) || std::holds_alternative<Attractor>(force.law)) continue;
    lacks.push_back(
        {"contact",
         fmt::format("`contact: merge` is for constant forces, linear drag, attractors and forces between "
                     "bodies, not for {}",
                     std::holds_alternative<Drag>(force.law) ? "quadratic `drag`" : "a `spring` from a fixed point"),
         "expected `contact: bounce`"});
    return;
  }
}

void exact_lacks(const World& world, const Simulate& simulate, Lacks& lacks) {
  if (const Force* open = force_without_closed_form(world))
    lacks.push_back(
        {"engine",
         fmt::format("under {} paths have no closed form, which `engine: exact` follows", open_force_text(*open)),
         "expected `engine: stepped`, or `auto`"});

  if (simulate.contact.merge && !world.strings.empty())
    lacks.push_back({"contact", "`contact: merge` is for parabolas and linear drag, not for `strings`",
                     "expected `contact: bounce`"});

  if (simulate.contact.merge) merge_lacks(world, lacks);
}

void stepped_lacks(const World& world, const Simulate& simulate, Lacks& lacks) {
  // Steps of one length are those of each body by itself.
  if (simulate.integrator != Integrator::dop853) {
    const auto lack = [&](const char* at, string_view what) {
      lacks.push_back({at, fmt::format("`integrator: {}` has no {}", name_of(simulate.integrator), what),
                       "expected `integrator: dop853`, or `engine: exact`"});
    };
    if (has_couplings(world)) lack("forces", coupling_text(world));
    if (simulate.contact.merge) lack("contact", "`contact: merge`");
  } else if (simulate.contact.merge) {
    merge_lacks(world, lacks);
    if (!world.strings.empty())
      lacks.push_back({"contact", "`contact: merge` has no `strings`", "expected `contact: bounce`"});
  }
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

  if (!world.forces.empty() || has_couplings(world))
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
  return engine_of(world, simulate) == Engine::exact && varying_force(world) == nullptr && !has_couplings(world);
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
