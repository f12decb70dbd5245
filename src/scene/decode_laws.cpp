// Decodes gravity, restitution and forces.
// A force without effect (zero strength, no bodies) is left out of the world.
#include <fmt/format.h>

#include "physics/world.h"
#include "scene/decode.h"
#include "scene/fields.h"
#include "scene/member.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

void decode_pair(const Node& node, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics) {
  const auto [between, value] = filled<PairKeys>(View(&node, kind_named("pair"), node.place));
  if (between == nullptr || between->bad || between->items.size() != 2) return;

  const auto a = find_range(between->items[0], inventory, Sought::anything, diagnostics);
  const auto b = find_range(between->items[1], inventory, Sought::anything, diagnostics);
  if (!a || !b || value == nullptr || value->bad) return;

  // Two things that can meet.
  for (const auto& [range, name] : {pair(*a, between->items.front()), pair(*b, between->items.back())}) {
    if (!inventory.is_string(range)) continue;
    diagnostics.add(name.place, fmt::format("{} is a string: it meets no other thing", in_backticks(name.text)),
                    "its coefficient is its own `restitution`");
    return;
  }
  if (a->first >= inventory.body_count && b->first >= inventory.body_count && a->count > 0 && b->count > 0) {
    diagnostics.add(between->place,
                    fmt::format("{} and {} are fixed things, which never meet", in_backticks(between->items[0].text),
                                in_backticks(between->items[1].text)),
                    "expected at least one ball, body or group");
    return;
  }

  if (a->first == b->first && a->count == 1 && b->count == 1) {
    diagnostics.add(between->place, fmt::format("{} does not meet itself", in_backticks(between->items[0].text)),
                    "expected two names");
    return;
  }

  scene.world.pairs.push_back({a->first, a->count, b->first, b->count, as_number(value)});
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

optional<ForceLaw> law_of(const ForceKeys& force) {
  optional<ForceLaw> law;
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
  optional<vector<Entity>> on = find_bodies(force.on, inventory, "no force acts on it", diagnostics);
  const optional<ForceLaw> law = law_of(force);
  if (!law || !on || !std::visit([](const auto& any) { return has_effect(any); }, *law)) return;
  if (!force.visible) scene.overlay.hidden_springs.push_back(scene.world.forces.size());
  scene.world.forces.push_back({*law, force.from, force.until, std::move(*on)});
}

}  // namespace

void decode_laws(const Node& root, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics) {
  const View whole(&root, kind_named("scene"), Place{});
  if (const optional<Vec3> gravity = whole.vector("gravity")) scene.world.gravity = *gravity;

  const View laws = scene_part(root, "restitution");
  scene.world.combine = filled<RestitutionKeys>(laws).combine;
  if (!inventory.fits) return;
  const auto each = [](const Node* list, const auto& decode) {
    if (list == nullptr || !list->is_sequence()) return;
    for (const Node& node : list->items) {
      if (node.is_map() && node.find_key("repeat") == nullptr) decode(node);
    }
  };
  each(laws.find("pairs"), [&](const Node& node) { decode_pair(node, inventory, scene, diagnostics); });
  each(root.find("forces"), [&](const Node& node) { decode_force(node, inventory, scene, diagnostics); });
}

}  // namespace carom
