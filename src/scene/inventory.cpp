// Numbers and counts all things of a scene before memory is allocated for bodies.
// The budget can thus refuse a huge group at no cost.
#include <fmt/format.h>

#include "scene/check.h"
#include "scene/decode.h"
#include "scene/fields.h"
#include "scene/hollow.h"
#include "scene/member.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

constexpr uint64_t most_bodies =
    // An Entity has 32 bits, and fixed things and strings are numbered after the bodies.
    4'000'000'000;

class Census {
 public:
  Census(const Node& root, Diagnostics& diagnostics) : root_(root), diagnostics_(diagnostics) {}

  Inventory run(const Budget& budget) {
    for (size_t i = 0; i < root_.keys.size(); ++i) {
      const string& key = root_.keys[i].text;
      if (key == "balls") bodies(root_.items[i], kind_named("ball"));
      if (key == "bodies") bodies(root_.items[i], kind_named("body"));
      if (key == "groups") bodies(root_.items[i], kind_named("group"));
      if (key == "planes") fixed(root_.items[i], kind_named("plane"));
      if (key == "room") add_fixed(root_.keys[i], root_.items[i], kind_named("room"));
    }
    // Walls are numbered after all planes, and obstacles after all walls, whatever their order in the file.
    if (const Node* walls = root_.find("walls")) fixed(*walls, kind_named("wall"));
    if (const Node* obstacles = root_.find("obstacles")) fixed(*obstacles, kind_named("obstacle"));

    if (const Node* strings = root_.find("strings")) add_strings(*strings);

    uint64_t total = 0;
    const BodyEntry* most = nullptr;
    for (BodyEntry& body : inventory_.bodies) {
      body.first = Entity(total);
      if (body.group) body.count = count_of(filled<GroupKeys>(body.view));
      total = body.count > most_bodies || total + body.count > most_bodies ? most_bodies + 1 : total + body.count;
      if (most == nullptr || body.count > most->count) most = &body;
    }
    check(total, most, budget);
    if (inventory_.fits) number(total);
    return std::move(inventory_);
  }

 private:
  /// The number of a group's balls. With a rate: those due from `from` until just before `until`.
  uint64_t count_of(const GroupKeys& group) const {
    if (!group.rate) return group.count;
    const double duration = scene_part(root_, "simulate").number("duration").value_or(0);
    const double until = min(group.until.value_or(duration), duration);
    const double from = group.from.value_or(0);
    if (!(until > from)) return 0;
    double count = ceil((until - from) * *group.rate);
    if (!(count <= double(most_bodies))) return most_bodies + 1;
    while (count > 0 && from + (count - 1) / *group.rate >= until) --count;
    return uint64_t(count);
  }

  void claim(const Key& key) {
    if (inventory_.names.emplace(key.text, Inventory::Range{0, 0}).second) return;
    diagnostics_.add(key.place, fmt::format("the name {} is taken", in_backticks(key.text)),
                     "names of bodies, groups, fixed things, strings and the room are unique in a scene");
  }

  /// Claims a thing's name, and that of the repeated thing with its first member. False: it is repeated no time.
  bool claim_thing(const Key& key, const Node& node) {
    claim(key);
    if (key.text.ends_with(".0")) claim({string(family_of(key.text)), key.place});
    return !node.is_map() || node.find_key("repeat") == nullptr;
  }

  void bodies(const Node& node, const Kind& kind) {
    if (!node.is_map()) return;
    for (size_t i = 0; i < node.keys.size(); ++i) {
      if (!claim_thing(node.keys[i], node.items[i])) {
        empty_.push_back({&node.keys[i], inventory_.bodies.size(), true});
        continue;
      }
      const View view = thing_view(root_, node.keys[i], node.items[i], kind);
      const bool group = kind.name == "group";
      inventory_.bodies.push_back({&node.keys[i], view, group ? member_view(root_, view) : view, group});
    }
  }

  void fixed(const Node& node, const Kind& kind) {
    if (!node.is_map()) return;
    for (size_t i = 0; i < node.keys.size(); ++i) add_fixed(node.keys[i], node.items[i], kind);
  }

  void add_fixed(const Key& key, const Node& node, const Kind& kind) {
    if (!claim_thing(key, node)) {
      empty_.push_back({&key, fixed_count_, false});
      return;
    }
    const View view = thing_view(root_, key, node, kind);
    vector<string_view> parts = part_names(view);
    const auto count = max<Entity>(Entity(parts.size()), 1);
    inventory_.fixed.push_back({&key, view, fixed_count_, count, std::move(parts)});
    fixed_count_ += count;
  }

  void add_strings(const Node& node) {
    if (!node.is_map()) return;
    const Kind& kind = kind_named("string");
    for (size_t i = 0; i < node.keys.size(); ++i) {
      if (claim_thing(node.keys[i], node.items[i]))
        inventory_.strings.push_back({&node.keys[i], thing_view(root_, node.keys[i], node.items[i], kind)});
      else
        empty_.push_back({&node.keys[i], fixed_count_ + inventory_.strings.size(), false});
    }
  }

  void check(uint64_t total, const BodyEntry* most, const Budget& budget) {
    const uint64_t limit = budget.enforced ? min(budget.bodies, most_bodies) : most_bodies;
    if (total <= limit) return;
    inventory_.fits = false;
    const bool by_group = most->group;
    const View& view = most->view;
    const string figure = total > most_bodies ? fmt::format("more than {}", most_bodies) : to_string(total);
    diagnostics_.add(by_group ? view.place("count") : most->key->place,
                     fmt::format("the scene has {} bodies; the limit is {}", figure, limit),
                     fmt::format("expected {}{}", by_group ? "a smaller `count`" : "fewer",
                                 limit == most_bodies ? "" : ", or --force if this machine has the memory"));
  }

  void number(uint64_t total) {
    inventory_.body_count = Entity(total);
    inventory_.fixed_count = fixed_count_;
    inventory_.names.reserve(inventory_.bodies.size() + 7 * inventory_.fixed.size() + inventory_.strings.size());

    for (const BodyEntry& body : inventory_.bodies) add(body.key->text, {body.first, Entity(body.count)});

    for (const FixedEntry& entry : inventory_.fixed) {
      const Entity first = inventory_.body_count + entry.first;
      add(entry.key->text, {first, entry.count});
      for (Entity part = 0; part < entry.parts.size(); ++part)
        inventory_.names[entry.key->text + "." + string(entry.parts[part])] = {first + part, 1};
    }

    for (size_t i = 0; i < inventory_.strings.size(); ++i)
      add(inventory_.strings[i].key->text, {inventory_.body_count + fixed_count_ + Entity(i), 1});
    for (const auto& [name, range] : inventory_.families) inventory_.names[name] = range;

    // What is repeated no time has a place among the others.
    for (const Empty& none : empty_) {
      const bool last = none.before == inventory_.bodies.size();
      const Entity first = !none.is_body ? inventory_.body_count + Entity(none.before)
                           : last        ? inventory_.body_count
                                         : inventory_.bodies[none.before].first;
      inventory_.names[none.key->text] = inventory_.families[none.key->text] = {first, 0};
    }
  }

  /// A thing by its name, and as a member of a repeated thing.
  void add(const string& name, Inventory::Range range) {
    inventory_.names[name] = range;
    const string_view family = family_of(name);
    if (family.empty()) return;
    const auto [whole, fresh] = inventory_.families.try_emplace(string(family), range);
    if (!fresh) whole->second.count += range.count;
  }

  /// A thing that is repeated no time.
  struct Empty {
    const Key* key;
    size_t before;  // entries, or fixed things and strings, before it
    bool is_body;
  };

  const Node& root_;
  Diagnostics& diagnostics_;
  Inventory inventory_;
  vector<Empty> empty_;
  Entity fixed_count_ = 0;
};

}  // namespace

Inventory take_inventory(const Node& root, const Budget& budget, Diagnostics& diagnostics) {
  return Census(root, diagnostics).run(budget);
}

View scene_part(const Node& root, string_view key) {
  const Node* node = root.find(key);
  const Key* name = root.find_key(key);
  return View(node, kind_named(key), name == nullptr ? Place{} : name->place);
}

View thing_view(const Node& root, const Key& key, const Node& thing, const Kind& kind) {
  return View(&thing, kind, key.place, defaults_for(root, kind));
}

View member_view(const Node& root, const View& group) {
  const Kind& kind = kind_named("member");
  return View(group.given("ball"), kind, group.place("ball"), defaults_for(root, kind));
}

}  // namespace carom
