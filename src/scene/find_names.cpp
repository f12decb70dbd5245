// Names of things in a scene file to their numbers.
#include <fmt/format.h>

#include "scene/decode.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

/// The number of members of a repeated thing. A repeated group has more bodies than members.
Entity members_of(const Inventory& inventory, const string& family) {
  Entity count = 0;
  while (inventory.names.contains(fmt::format("{}.{}", family, count))) ++count;
  return count;
}

}  // namespace

optional<Inventory::Range> find_range(const Node& name, const Inventory& inventory, Sought sought,
                                      Diagnostics& diagnostics) {
  if (name.bad || !name.is_scalar()) return nullopt;
  if (const auto it = inventory.names.find(name.text); it != inventory.names.end()) return it->second;
  // A group's member such as gas.3.
  const size_t dot = name.text.rfind('.');
  if (dot != string::npos) {
    const string group = name.text.substr(0, dot);
    const auto it =
        ranges::find_if(inventory.bodies, [&](const BodyEntry& b) { return b.group && b.key->text == group; });
    const optional<uint64_t> member = parse_index(string_view(name.text).substr(dot + 1));

    if (it != inventory.bodies.end()) {
      if (member && *member < it->count) return Inventory::Range{it->first + Entity(*member), 1};
      diagnostics.add(
          name.place,
          fmt::format("the group {} has no member {}", in_backticks(group), in_backticks(name.text.substr(dot + 1))),
          it->count == 0 ? "it has none" : fmt::format("expected {}.0 to {}.{}", group, group, it->count - 1));
      return nullopt;
    }
  }

  // A member of a repeated thing.
  if (const auto family = inventory.families.find(string(family_of(name.text))); family != inventory.families.end()) {
    const Entity count = members_of(inventory, family->first);
    if (count == 0 && !diagnostics.empty()) return nullopt;  // perhaps its `repeat` is wrong
    diagnostics.add(
        name.place,
        fmt::format("there is no {}: {} has {} member{}", in_backticks(name.text), in_backticks(family->first), count,
                    count == 1 ? "" : "s"),
        count == 0 ? "its `repeat` is 0" : fmt::format("expected {0}.0 to {0}.{1}", family->first, count - 1));
    return nullopt;
  }

  // Nothing has this name: list what has one.
  const string message = fmt::format("nothing is named {}", in_backticks(name.text));
  if (diagnostics.add_member(name.place, message)) return nullopt;
  vector<string> all;
  const auto add = [&](const string& thing) {
    const string_view family = family_of(thing);
    const string_view shown = family.empty() ? string_view(thing) : family;
    if (all.empty() || all.back() != shown) all.emplace_back(shown);
  };

  for (const BodyEntry& body : inventory.bodies) add(body.key->text);
  const bool bodies_alone = sought == Sought::bodies;
  for (const FixedEntry& fixed : inventory.fixed) {
    if (bodies_alone) break;
    add(fixed.key->text);
    for (const string_view part : fixed.parts) all.push_back(fixed.key->text + "." + string(part));
  }

  const string suggestion = suggest_name(name.text, {all.begin(), all.end()});
  const string kinds = bodies_alone ? "expected a ball, body, group or member (gas.3)"
                                    : "expected a ball, body, group, member (gas.3) or fixed thing, such as room.y_min";

  diagnostics.add(name.place, message,
                  suggestion.starts_with("did") ? suggestion
                  : suggestion.empty()          ? kinds
                                                : fmt::format("{}\n{}", kinds, suggestion));
  return nullopt;
}

optional<vector<Entity>> find_bodies(const Node* on, const Inventory& inventory, string_view use,
                                     Diagnostics& diagnostics) {
  if (on == nullptr) return vector<Entity>{};
  if (on->bad) return nullopt;

  vector<Entity> bodies;
  bool good = true;
  for (const Node& item : on->items) {
    const auto range = find_range(item, inventory, Sought::bodies, diagnostics);
    good = good && range;
    if (!range) continue;

    if (range->first >= inventory.body_count && range->count > 0) {
      diagnostics.add(item.place, fmt::format("{} is {}: {}", in_backticks(item.text), inventory.word_for(*range), use),
                      "expected balls, bodies, groups or members (gas.3)");
      good = false;
      continue;
    }
    for (Entity i = 0; i < range->count; ++i) bodies.push_back(range->first + i);
  }

  ranges::sort(bodies);
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  return good && !bodies.empty() ? optional(std::move(bodies)) : nullopt;
}

}  // namespace carom
