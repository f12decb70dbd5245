// Decodes gravity, restitution and forces.
// A force without effect (zero strength, no bodies) is left out of the world.
#include <fmt/format.h>

#include <algorithm>

#include "physics/world.h"
#include "scene/decode.h"
#include "scene/member.h"
#include "scene/scene.h"
#include "yaml/values.h"

namespace carom {

std::optional<Inventory::Range> find_range(const Node& name, const Inventory& inventory, Diagnostics& diagnostics) {
  if (name.bad || !name.is(Node::Kind::scalar)) return std::nullopt;
  if (const auto it = inventory.names.find(name.text); it != inventory.names.end()) return it->second;
  // A group's member such as gas.3.
  const std::size_t dot = name.text.rfind('.');
  if (dot != std::string::npos) {
    const std::string group = name.text.substr(0, dot);
    const auto it = std::find_if(inventory.bodies.begin(), inventory.bodies.end(),
                                 [&](const BodyEntry& b) { return b.group && b.key->text == group; });
    const std::optional<std::uint64_t> member = parse_index(std::string_view(name.text).substr(dot + 1));
    if (it != inventory.bodies.end()) {
      if (member && *member < it->count) return Inventory::Range{it->first + static_cast<Entity>(*member), 1};
      diagnostics.add(
          name.place,
          fmt::format("the group {} has no member {}", in_backticks(group), in_backticks(name.text.substr(dot + 1))),
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
  diagnostics.add(name.place, fmt::format("nothing is named {}", in_backticks(name.text)),
                  near.empty() ? "expected a ball, body, group, member (gas.3) or fixed thing, such as room.y_min"
                               : fmt::format("did you mean {}?", in_backticks(near)));
  return std::nullopt;
}

namespace {

void decode_pair(const Node& node, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics) {
  const auto [between, value] = filled<PairKeys>(View(&node, kind_named("pair"), node.place));
  if (between == nullptr || between->bad || between->items.size() != 2) return;
  const auto a = find_range(between->items[0], inventory, diagnostics);
  const auto b = find_range(between->items[1], inventory, diagnostics);
  if (!a || !b || !value) return;
  if (a->first >= inventory.body_count && b->first >= inventory.body_count && a->count > 0 && b->count > 0) {
    diagnostics.add(between->place,
                    fmt::format("{} and {} never move, so they never meet", in_backticks(between->items[0].text),
                                in_backticks(between->items[1].text)),
                    "expected at least one ball, body or group");
    return;
  }
  if (a->first == b->first && a->count == 1 && b->count == 1) {
    diagnostics.add(between->place, fmt::format("{} does not meet itself", in_backticks(between->items[0].text)),
                    "expected two names");
    return;
  }
  scene.world.pairs.push_back({a->first, a->count, b->first, b->count, *value});
}

/// The bodies that a force acts on. An empty list: all bodies. None: no body at all, or an error was reported.
std::optional<std::vector<Entity>> decode_on(const Node* on, const Inventory& inventory, Diagnostics& diagnostics) {
  if (on == nullptr) return std::vector<Entity>{};
  if (on->bad) return std::nullopt;
  std::vector<Entity> bodies;
  bool good = true;
  for (const Node& item : on->items) {
    const auto range = find_range(item, inventory, diagnostics);
    good = good && range;
    if (!range) continue;
    if (range->first >= inventory.body_count && range->count > 0) {
      diagnostics.add(item.place, fmt::format("{} never moves: no force acts on it", in_backticks(item.text)),
                      "expected balls, bodies, groups or members (gas.3)");
      good = false;
      continue;
    }
    for (Entity i = 0; i < range->count; ++i) bodies.push_back(range->first + i);
  }
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  return good && !bodies.empty() ? std::optional(std::move(bodies)) : std::nullopt;
}

bool has_effect(const UniformForce& law) {
  return !law.force.isZero(0);
}
bool has_effect(const UniformAcceleration& law) {
  return !law.value.isZero(0);
}
bool has_effect(const Drag& law) {
  return law.linear != 0 || law.quadratic != 0;
}
bool has_effect(const Spring& law) {
  return law.stiffness != 0 || law.damping != 0;
}
bool has_effect(const Attractor& law) {
  return law.strength != 0;
}

std::optional<ForceLaw> law_of(const ForceKeys& force) {
  std::optional<ForceLaw> law;
  if (force.uniform) law = UniformForce{*force.uniform};
  if (force.acceleration) law = UniformAcceleration{*force.acceleration};
  if (force.drag) law = *force.drag;
  if (force.spring) law = *force.spring;
  if (force.attractor) law = *force.attractor;
  return law;
}

void decode_force(const Node& node, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics) {
  const View view(&node, kind_named("force"), node.place);
  const auto force = filled<ForceKeys>(view);
  if (force.until <= force.from) {
    diagnostics.add(view.place("until"),
                    fmt::format("`until` is {} but `from` is {}", shortest(force.until), shortest(force.from)),
                    "expected from < until");
  }
  std::optional<std::vector<Entity>> on = decode_on(force.on, inventory, diagnostics);
  const std::optional<ForceLaw> law = law_of(force);
  if (!law || !on || !std::visit([](const auto& any) { return has_effect(any); }, *law)) return;
  scene.world.forces.push_back({*law, force.from, force.until, std::move(*on)});
}

}  // namespace

void decode_laws(const Node& root, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics) {
  const View whole(&root, kind_named("scene"), Place{});
  if (const std::optional<Vec3> gravity = whole.vector("gravity")) scene.world.gravity = *gravity;

  const View laws = scene_part(root, "restitution");
  scene.world.combine = filled<RestitutionKeys>(laws).combine;
  if (!inventory.fits) return;
  const auto each = [](const Node* list, const auto& decode) {
    if (list == nullptr || !list->is(Node::Kind::sequence)) return;
    for (const Node& node : list->items) {
      if (node.is(Node::Kind::map)) decode(node);
    }
  };
  each(laws.find("pairs"), [&](const Node& node) { decode_pair(node, inventory, scene, diagnostics); });
  each(root.find("forces"), [&](const Node& node) { decode_force(node, inventory, scene, diagnostics); });
}

}  // namespace carom
