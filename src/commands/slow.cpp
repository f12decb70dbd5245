// Ratios at which steps of constrained motion get short. Measured with a swing of 1 m, and with a chain of five light
// joints: sizes of 1e-6 m and masses of 1e-8 kg beside 1 kg are no slower than others, a size of 1e-7 m is slower by
// more than 300 times, and with 1e-9 kg rounding decides on the forces.
#include "commands/slow.h"

#include <fmt/format.h>

#include "physics/world.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/joined.h"

namespace carom {

namespace {

constexpr double least_size = 5e-7;  // of the length of a string
constexpr double least_mass = 5e-9;  // of the heaviest body on a string

}  // namespace

string slow_text(const Scene& scene) {
  const World& world = scene.world;
  double heaviest = 0;  // kg
  for (const String& string : world.strings)
    for (const Entity i : {string.body, string.other})
      if (i != no_entity) heaviest = max(heaviest, world.mass[i]);

  // The smallest and the lightest body, where they are below the limits.
  Entity small = no_entity, light = no_entity;
  double least = least_size, lightest = least_mass;
  for (const String& string : world.strings)
    for (const Entity i : {string.body, string.other}) {
      if (i == no_entity) continue;
      if (const double size = world.radius[i] / string.length; size < least) small = i, least = size;
      if (const double mass = world.mass[i] / heaviest; mass < lightest) light = i, lightest = mass;
    }

  vector<string> texts;
  if (small != no_entity)
    texts.push_back(
        fmt::format("the radius of {} is {:.1g} of the length of its string, and errors of a step are held to a "
                    "share of the radius: make it larger",
                    scene.roster.name(small), least));
  if (light != no_entity)
    texts.push_back(
        fmt::format("the mass of {} is {:.1g} of the heaviest one on strings, whose rounding is a noticeable "
                    "force on it: make it heavier",
                    scene.roster.name(light), lightest));
  return joined(texts, "; ");
}

}  // namespace carom
