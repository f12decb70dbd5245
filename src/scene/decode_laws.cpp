#include <fmt/format.h>

#include <algorithm>

#include "scene/decode.h"
#include "scene/values.h"

namespace carom {
namespace {

/// A name of `between`: a body, group, member, fixed thing, the room or one of its sides.
std::optional<Inventory::Range> find_range(const Node& name, const Inventory& inventory, Diagnostics& diagnostics) {
  if (name.bad || !name.is(Node::Kind::scalar)) return std::nullopt;
  if (const auto it = inventory.names.find(name.text); it != inventory.names.end()) return it->second;
  // gas.3
  const std::size_t dot = name.text.rfind('.');
  if (dot != std::string::npos) {
    const std::string group = name.text.substr(0, dot);
    const auto it = std::find_if(inventory.bodies.begin(), inventory.bodies.end(),
                                 [&](const BodyEntry& b) { return b.group && b.key->text == group; });
    const std::optional<std::uint64_t> member = parse_whole(std::string_view(name.text).substr(dot + 1));
    if (it != inventory.bodies.end()) {
      if (member && *member < it->count) return Inventory::Range{it->first + static_cast<Entity>(*member), 1};
      diagnostics.add(
          name.place, fmt::format("the group {} has no member {}", quoted(group), quoted(name.text.substr(dot + 1))),
          it->count == 0 ? "it has none" : fmt::format("expected {}.0 to {}.{}", group, group, it->count - 1));
      return std::nullopt;
    }
  }
  std::vector<std::string> all;
  for (const BodyEntry& body : inventory.bodies) all.push_back(body.key->text);
  for (const FixedEntry& fixed : inventory.fixed) {
    all.push_back(fixed.key->text);
    for (const char* side : {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"}) {
      if (fixed.count == 6) all.push_back(fixed.key->text + "." + side);
    }
  }
  const std::string near = nearest(name.text, std::vector<std::string_view>(all.begin(), all.end()));
  diagnostics.add(name.place, fmt::format("nothing is named {}", quoted(name.text)),
                  near.empty() ? "expected a ball, group, member (gas.3), plane, wall, room or side of it (room.y_min)"
                               : fmt::format("did you mean {}?", quoted(near)));
  return std::nullopt;
}

void decode_pair(const Node& node, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics) {
  const View pair(&node, kind_named("pair"), node.place);
  const Node* between = pair.find("between");
  const std::optional<double> value = pair.number("value");
  if (between == nullptr || between->bad || between->items.size() != 2) return;
  const auto a = find_range(between->items[0], inventory, diagnostics);
  const auto b = find_range(between->items[1], inventory, diagnostics);
  if (!a || !b || !value) return;
  if (a->first >= inventory.body_count && b->first >= inventory.body_count && a->count > 0 && b->count > 0) {
    diagnostics.add(between->place,
                    fmt::format("{} and {} never move, so they never meet", quoted(between->items[0].text),
                                quoted(between->items[1].text)),
                    "expected at least one ball or group");
    return;
  }
  if (a->first == b->first && a->count == 1 && b->count == 1) {
    diagnostics.add(between->place, fmt::format("{} does not meet itself", quoted(between->items[0].text)),
                    "expected two names");
    return;
  }
  scene.world.pairs.push_back({a->first, a->count, b->first, b->count, *value});
}

}  // namespace

void decode_laws(const Node& root, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics) {
  const View whole(&root, kind_named("scene"), Place{});
  if (const std::optional<Vec3> gravity = whole.vector("gravity")) scene.world.gravity = *gravity;

  const View laws = scene_part(root, "restitution");
  constexpr std::pair<std::string_view, Combine> rules[] = {{"average", Combine::average},
                                                            {"minimum", Combine::minimum},
                                                            {"maximum", Combine::maximum},
                                                            {"product", Combine::product},
                                                            {"geometric_mean", Combine::geometric_mean},
                                                            {"mass_weighted", Combine::mass_weighted},
                                                            {"book", Combine::book}};
  const std::string rule = laws.text("combine").value_or("average");
  for (const auto& [name, combine] : rules) {
    if (name == rule) scene.world.combine = combine;
  }
  const Node* pairs = laws.find("pairs");
  if (!inventory.fits || pairs == nullptr || !pairs->is(Node::Kind::sequence)) return;
  for (const Node& node : pairs->items) decode_pair(node, inventory, scene, diagnostics);
}

}  // namespace carom
