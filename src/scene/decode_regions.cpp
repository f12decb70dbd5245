// Decodes regions, and what ends a run before its duration.
// A region with an error still gets a number, so that the numbers of the others do not shift.
#include <fmt/format.h>

#include "physics/world.h"
#include "scene/decode.h"
#include "scene/expand.h"
#include "scene/fields.h"
#include "scene/member.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

optional<Volume> volume_of(const RegionKeys& region) {
  if (region.radius) return Volume::sphere(*region.radius);
  if (region.box) return Volume::box(*region.box);
  if (!region.cylinder || !region.cylinder->radius || !region.cylinder->height) return nullopt;
  return Volume::cylinder(*region.cylinder->radius, *region.cylinder->height);
}

WorldRegion decode_region(const View& view, const string& name, const Inventory& inventory, Diagnostics& diagnostics) {
  const auto keys = filled<RegionKeys>(view);
  WorldRegion region;

  // Its shape: the side of a plane, or a volume.
  if (keys.plane) {
    region.position = keys.plane->point;
    region.normal = unit(keys.plane->normal);
  } else if (const optional<Volume> volume = volume_of(keys); volume && keys.position) {
    region.position = *keys.position;
    region.volume = *volume;
    const double width = 2 * volume->half.minCoeff(), far = region.position.cwiseAbs().maxCoeff();
    if (width < least_share_of_coordinates * far)
      diagnostics.add(
          view.place("position"),
          fmt::format("{} is {} m wide and {} m from the origin", in_backticks(name), shortest(width), shortest(far)),
          "doubles do not resolve it there: bring it nearer, or make it larger");
  }

  // Whom it concerns, and what it does.
  if (auto on = find_bodies(keys.on, inventory, "it enters no region", diagnostics)) region.on = std::move(*on);
  region.removes = keys.action == RegionAction::remove;
  region.stops = keys.action == RegionAction::stop;
  return region;
}

class RegionDecoder {
 public:
  RegionDecoder(const Node& root, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics)
      : root_(root), inventory_(inventory), scene_(scene), diagnostics_(diagnostics) {}

  void decode() {
    const Node* regions = root_.find("regions");
    for (size_t i = 0; regions != nullptr && regions->is_map() && i < regions->keys.size(); ++i) {
      const Key& key = regions->keys[i];
      if (inventory_.names.contains(key.text))
        diagnostics_.add(key.place, fmt::format("the name {} is taken", in_backticks(key.text)),
                         "names of bodies, groups, fixed things, strings, the room and regions are unique in a scene");

      // What is repeated no time has no members, which would have taken its place.
      if (regions->items[i].is_map() && regions->items[i].find_key("repeat") != nullptr) continue;
      const View view(&regions->items[i], kind_named("region"), key.place);
      scene_.world.regions.push_back(decode_region(view, key.text, inventory_, diagnostics_));
      scene_.roster.regions.push_back(key.text);
    }
  }

  void decode_stops() {
    const Node* stops = scene_part(root_, "simulate").given("stop");
    if (stops == nullptr || !stops->is_sequence()) return;
    for (const Node& stop : stops->items) stop.is_map() ? take_stop(stop) : take_word(stop);
  }

 private:
  void take_word(const Node& word) {
    if (!word.bad && word.text == "rest") scene_.simulate.stop_at_rest = true;
  }

  void take_stop(const Node& node) {
    const auto [collisions, region] = filled<StopKeys>(View(&node, kind_named("stop"), node.place));
    // Of several numbers the first that is reached.
    if (collisions)
      scene_.simulate.stop_collisions = min(*collisions, scene_.simulate.stop_collisions.value_or(*collisions));
    if (region == nullptr || region->bad || !region->is_scalar()) return;

    const EntityRange found = find_regions(*region, scene_, diagnostics_).value_or(EntityRange{});
    for (Entity r = found.first; found.has(r); ++r) scene_.world.regions[r].stops = true;
  }

  const Node& root_;
  const Inventory& inventory_;
  Scene& scene_;
  Diagnostics& diagnostics_;
};

}  // namespace

optional<EntityRange> find_regions(const Node& name, const Scene& scene, Diagnostics& diagnostics) {
  const vector<string>& names = scene.roster.regions;
  EntityRange found;
  for (Entity r = 0; r < names.size(); ++r)
    // family_of is empty for what is not repeated.
    if (names[r] == name.text || (!name.text.empty() && family_of(names[r]) == name.text))
      found = {found.count == 0 ? r : found.first, found.count + 1};

  const auto is_family = [&](const EmptyFamily& family) { return family.of == "regions" && family.name == name.text; };
  if (found.count > 0 || any_of(scene.roster.empty, is_family)) return found;
  const string suggestion = suggest_name(name.text, {names.begin(), names.end()});
  diagnostics.add(name.place, fmt::format("no region is named {}", in_backticks(name.text)),
                  suggestion.empty() ? "expected `regions` with that name" : suggestion);
  return nullopt;
}

void decode_regions(const Node& root, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics) {
  RegionDecoder(root, inventory, scene, diagnostics).decode();
}

void decode_stops(const Node& root, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics) {
  RegionDecoder(root, inventory, scene, diagnostics).decode_stops();
}

}  // namespace carom
