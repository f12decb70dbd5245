// Decodes gravity, restitution and forces.
// A force without effect (zero strength, no bodies) is left out of the world.
#include <fmt/format.h>

#include "physics/world.h"
#include "scene/decode.h"
#include "scene/events.h"
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
  if (const auto& spring = force.spring; spring && spring->anchor)
    law = Spring{*spring->anchor, spring->stiffness, spring->rest_length.value_or(0), spring->damping};
  if (force.attractor) law = *force.attractor;
  return law;
}

/// The two ends of a spring: bodies, of which one may be no_entity with its point (m) in its place.
struct SpringEnds {
  Entity a = no_entity;
  Entity b = no_entity;
  Vec3 point = Vec3::Zero();
};

optional<SpringEnds> ends_of(const SpringKeys& spring, const Inventory& inventory, Diagnostics& diagnostics) {
  if (spring.from == nullptr || spring.to == nullptr || spring.from->bad || spring.to->bad) return nullopt;
  if (spring.from->is_sequence() && spring.to->is_sequence()) {
    diagnostics.add(spring.to->place, "both ends of the spring are fixed points",
                    "expected a ball, a body or a member (gas.3) at one end at least");
    return nullopt;
  }

  // A fixed end is the second one.
  SpringEnds ends;
  const bool is_turned = spring.from->is_sequence();
  const Node& first = is_turned ? *spring.to : *spring.from;
  const Node& second = is_turned ? *spring.from : *spring.to;
  const optional<Entity> a = body_at(first, inventory, "spring", diagnostics);
  if (second.is_sequence()) {
    const optional<Vec3> point = as_vector(&second);
    if (!a || !point) return nullopt;
    return SpringEnds{*a, no_entity, *point};
  }

  const optional<Entity> b = body_at(second, inventory, "spring", diagnostics);
  if (!a || !b) return nullopt;
  if (*a == *b) {
    diagnostics.add(second.place, fmt::format("both ends of the spring are {}", in_backticks(second.text)),
                    "expected two bodies, or a point and a body");
    return nullopt;
  }
  // Both directions are the same spring.
  return SpringEnds{min(*a, *b), max(*a, *b), Vec3::Zero()};
}

/// A rest length that is the distance of the ends at time 0, until bodies are decoded.
constexpr double distance_at_start = numeric_limits<double>::quiet_NaN();

/// The ends of a force's window.
struct ForceWindow {
  WindowEnd from, until;
};

/// A spring between two ends.
void decode_spring(const ForceKeys& force, const ForceWindow& when, EventDecoder& events, const Inventory& inventory,
                   Scene& scene, Diagnostics& diagnostics) {
  const SpringKeys& keys = *force.spring;
  if (force.on != nullptr)
    diagnostics.add(force.on->place, "`on` beside `from` and `to`: the spring acts on its two ends",
                    "leave out `on`; a spring from a point to each of many bodies has an `anchor`");
  const optional<SpringEnds> ends = ends_of(keys, inventory, diagnostics);
  if (!ends || (keys.stiffness == 0 && keys.damping == 0)) return;

  const double rest_length = keys.rest_length.value_or(distance_at_start);
  World& world = scene.world;
  if (ends->b == no_entity) {
    if (!force.visible) scene.overlay.hidden_springs.push_back(world.forces.size());
    const Spring spring{ends->point, keys.stiffness, rest_length, keys.damping};
    events.wait(TriggeredEnd::Of::force, world.forces.size(), when.from, when.until);
    world.forces.push_back({spring, when.from.time, when.until.time, {ends->a}});
  } else {
    if (!force.visible) scene.overlay.hidden_body_springs.push_back(world.springs.size());
    events.wait(TriggeredEnd::Of::body_spring, world.springs.size(), when.from, when.until);
    world.springs.push_back(
        {ends->a, ends->b, keys.stiffness, rest_length, keys.damping, when.from.time, when.until.time});
  }
}

void decode_force(const Node& node, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics) {
  const View view(&node, kind_named("force"), node.place);
  const auto force = filled<ForceKeys>(view);
  EventDecoder events(inventory, scene, diagnostics);
  const ForceWindow when{events.end(view, "from", force.from), events.end(view, "until", force.until)};
  events.check(view, when.from, when.until);
  if (force.spring && (force.spring->from != nullptr || force.spring->to != nullptr))
    return decode_spring(force, when, events, inventory, scene, diagnostics);

  optional<vector<Entity>> on = find_bodies(force.on, inventory, "no force acts on it", diagnostics);
  if (on && force.gravitation && force.gravitation->constant != 0) {
    const auto [constant, softening] = *force.gravitation;
    events.wait(TriggeredEnd::Of::gravitation, scene.world.gravitations.size(), when.from, when.until);
    scene.world.gravitations.push_back({constant, softening, when.from.time, when.until.time, std::move(*on)});
    return;
  }

  const optional<ForceLaw> law = law_of(force);
  if (!law || !on || !std::visit([](const auto& any) { return has_effect(any); }, *law)) return;
  if (!force.visible) scene.overlay.hidden_springs.push_back(scene.world.forces.size());
  events.wait(TriggeredEnd::Of::force, scene.world.forces.size(), when.from, when.until);
  scene.world.forces.push_back({*law, when.from.time, when.until.time, std::move(*on)});
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

namespace {

/// Refuses a force between bodies where one of these comes later.
void refuse_later(const Scene& scene, span<const Entity> those, const Place& place, Diagnostics& diagnostics) {
  const auto later = ranges::find_if(those, [&](Entity i) { return scene.world.comes_later(i); });
  if (later == those.end()) return;
  diagnostics.add(place,
                  fmt::format("the force is on {}, which appears at {} s", in_backticks(scene.roster.name(*later)),
                              shortest(scene.world.appears[*later])),
                  "expected bodies that are there from the start; name them in `on`, or as ends");
}

/// The same for the first gravitation that has such a body.
void refuse_later_gravitation(const Node& list, const Scene& scene, Diagnostics& diagnostics) {
  vector<Entity> all(scene.world.body_count());
  for (Entity i = 0; i < all.size(); ++i) all[i] = i;
  for (const Gravitation& law : scene.world.gravitations) {
    const auto entry =
        ranges::find_if(list.items, [](const Node& node) { return node.find("gravitation") != nullptr; });
    refuse_later(scene, law.on.empty() ? all : law.on, entry->place, diagnostics);
    if (!diagnostics.empty()) return;
  }
}

}  // namespace

void decode_rest_lengths(const Node& root, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics) {
  const Node* const list = root.find("forces");
  if (list == nullptr || !list->is_sequence() || !diagnostics.empty()) return;

  if (!scene.world.appears.empty()) refuse_later_gravitation(*list, scene, diagnostics);

  // All springs are right, and stand in the order of the list.
  World& world = scene.world;
  const vector<Vec3>& x = scene.initial.position;
  auto spring = world.springs.begin();
  auto anchored = world.forces.begin();
  for (const Node& node : list->items) {
    const auto force = filled<ForceKeys>(View(&node, kind_named("force"), node.place));
    if (!force.spring || force.spring->from == nullptr) continue;
    if (force.spring->stiffness == 0 && force.spring->damping == 0) continue;
    const optional<SpringEnds> ends = ends_of(*force.spring, inventory, diagnostics);
    if (!ends) return;
    if (ends->b != no_entity) refuse_later(scene, array{ends->a, ends->b}, force.spring->from->place, diagnostics);

    double* length = nullptr;
    if (ends->b != no_entity) {
      length = &(spring++)->rest_length;
    } else if (!force.spring->rest_length) {
      const auto is_next = [](const Force& f) {
        const Spring* const law = std::get_if<Spring>(&f.law);
        return law != nullptr && std::isnan(law->rest_length);
      };
      anchored = std::find_if(anchored, world.forces.end(), is_next);
      length = &std::get<Spring>(anchored->law).rest_length;
    }
    if (force.spring->rest_length) continue;

    *length = (x[ends->a] - (ends->b == no_entity ? ends->point : x[ends->b])).norm();
    if (!scene.made_from.start) continue;
    diagnostics.add(force.spring->from->place,
                    "the spring has no `rest_length`, and its ends begin where a former run had them",
                    "expected `rest_length`: the distance at which the spring neither pulls nor pushes");
  }
}

}  // namespace carom
