// Compares with the median of all other things. With the mean, one body in other units would make all others odd.
#include "commands/sizes.h"

#include <fmt/format.h>

#include <filesystem>

#include "commands/text.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/printable.h"

namespace carom {
namespace {

constexpr double odd_ratio = 1000;

struct SizedThing {
  string name;
  double reach;                   // m, of a group the median
  const MeshUse* mesh = nullptr;  // none: its size is not that of a mesh
};

double median(vector<double> values) {
  const auto middle = values.begin() + ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

const MeshUse* volume_of(const optional<MeshUse>& mesh) {
  return mesh && mesh->is_volume ? &*mesh : nullptr;
}

/// Each ball, body, group and obstacle once, and repeated things by their first members.
vector<SizedThing> sized_things(const Scene& scene) {
  const World& world = scene.world;
  vector<SizedThing> things;
  set<string_view> known;
  for (const BodyRange& range : scene.roster.bodies) {
    if (range.count == 0 || !known.insert(range.thing()).second) continue;
    const auto first = world.radius.begin() + range.first;
    things.push_back({string(range.thing()), median({first, first + range.count}), volume_of(range.mesh)});
  }

  for (size_t i = 0; i < world.obstacles.size(); ++i) {
    const FixedLook& look = scene.roster.fixed[world.planes.size() + world.walls.size() + i];
    const string_view family = family_of(look.name);
    const string_view name = family.empty() ? string_view(look.name) : family;
    if (known.insert(name).second)
      things.push_back({string(name), world.obstacles[i].volume.reach(), volume_of(look.mesh)});
  }
  return things;
}

string sentence(const SizedThing& thing, double ratio) {
  const bool larger = ratio > 1;
  string text = fmt::format("{} is {} times {} than the rest", printable(thing.name),
                            grouped(uint64_t(std::round(larger ? ratio : 1 / ratio))), larger ? "larger" : "smaller");
  if (thing.mesh == nullptr) return text + ": lengths are in m";
  const string file = printable(std::filesystem::path(thing.mesh->file).filename().string());
  const double scale = larger ? 0.001 : 1000;
  return text + fmt::format(": `mesh: {{file: {}, scale: {}}}` makes it {} times {}", file, thing.mesh->scale * scale,
                            grouped(1000), larger ? "smaller" : "larger");
}

}  // namespace

vector<string> odd_sizes(const Scene& scene) {
  const vector<SizedThing> things = sized_things(scene);
  vector<double> sorted;
  for (const SizedThing& thing : things) sorted.push_back(thing.reach);
  ranges::sort(sorted);

  vector<string> texts;
  if (things.size() < 2) return texts;
  for (const SizedThing& thing : things) {
    const auto own = size_t(ranges::lower_bound(sorted, thing.reach) - sorted.begin());
    const auto other = [&](size_t k) { return sorted[k < own ? k : k + 1]; };
    // Of an even number of others there are two in the middle. A thing is odd to both.
    const size_t others = sorted.size() - 1;
    const double larger = thing.reach / other(others / 2), smaller = thing.reach / other((others - 1) / 2);
    if (larger >= odd_ratio) texts.push_back(sentence(thing, larger));
    if (smaller <= 1 / odd_ratio) texts.push_back(sentence(thing, smaller));
  }

  // Of two things each is odd to the other. That of a mesh is the one to change, or else the larger one.
  if (things.size() == 2 && texts.size() == 2) {
    const bool first = things[0].mesh != nullptr || (things[1].mesh == nullptr && things[0].reach > things[1].reach);
    texts.erase(texts.begin() + (first ? 1 : 0));
  }
  return texts;
}

}  // namespace carom
