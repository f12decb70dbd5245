// Numbers and counts all things of a scene before memory is allocated for bodies.
// The budget can thus refuse a huge group at no cost.
#include <fmt/format.h>

#include "scene/check.h"
#include "scene/decode.h"
#include "scene/member.h"
#include "yaml/values.h"

namespace carom {
namespace {

constexpr std::uint64_t most_bodies =
    // An Entity has 32 bits, and fixed things are numbered after the bodies.
    4'000'000'000;

class Census {
 public:
  Census(const Node& root, Diagnostics& diagnostics) : root_(root), diagnostics_(diagnostics) {}

  Inventory run(const Budget& budget) {
    for (std::size_t i = 0; i < root_.keys.size(); ++i) {
      const std::string& key = root_.keys[i].text;
      if (key == "balls") bodies(root_.items[i], kind_named("ball"));
      if (key == "bodies") bodies(root_.items[i], kind_named("body"));
      if (key == "groups") bodies(root_.items[i], kind_named("group"));
      if (key == "planes") fixed(root_.items[i], kind_named("plane"));
      if (key == "room") add_fixed(root_.keys[i], root_.items[i], kind_named("room"));
    }
    // Walls are numbered after all planes, and obstacles after all walls, whatever their order in the file.
    if (const Node* walls = root_.find("walls")) fixed(*walls, kind_named("wall"));
    if (const Node* obstacles = root_.find("obstacles")) fixed(*obstacles, kind_named("obstacle"));

    std::uint64_t total = 0;
    const BodyEntry* most = nullptr;
    for (BodyEntry& body : inventory_.bodies) {
      body.first = static_cast<Entity>(total);
      if (body.group) body.count = filled<GroupKeys>(body_view(root_, body)).count;
      total = body.count > most_bodies || total + body.count > most_bodies ? most_bodies + 1 : total + body.count;
      if (most == nullptr || body.count > most->count) most = &body;
    }
    check(total, most, budget);
    if (inventory_.fits) number(total);
    return std::move(inventory_);
  }

 private:
  void claim(const Key& key) {
    if (inventory_.names.emplace(key.text, Inventory::Range{0, 0}).second) return;
    diagnostics_.add(key.place, fmt::format("the name {} is taken", in_backticks(key.text)),
                     "names of bodies, groups, fixed things and the room are unique in a scene");
  }

  void bodies(const Node& node, const Kind& kind) {
    if (!node.is(Node::Kind::map)) return;
    for (std::size_t i = 0; i < node.keys.size(); ++i) {
      claim(node.keys[i]);
      inventory_.bodies.push_back({&node.keys[i], &node.items[i], &kind, kind.name == "group"});
    }
  }

  void fixed(const Node& node, const Kind& kind) {
    if (!node.is(Node::Kind::map)) return;
    for (std::size_t i = 0; i < node.keys.size(); ++i) add_fixed(node.keys[i], node.items[i], kind);
  }

  void add_fixed(const Key& key, const Node& node, const Kind& kind) {
    claim(key);
    const Entity count = kind.name == "room" ? 6 : 1;
    inventory_.fixed.push_back({&key, &node, &kind, fixed_count_, count});
    fixed_count_ += count;
  }

  void check(std::uint64_t total, const BodyEntry* most, const Budget& budget) {
    const std::uint64_t limit = budget.enforced ? std::min(budget.bodies, most_bodies) : most_bodies;
    if (total <= limit) return;
    inventory_.fits = false;
    const bool by_group = most->group;
    const View view = body_view(root_, *most);
    const std::string figure = total > most_bodies ? fmt::format("more than {}", most_bodies) : std::to_string(total);
    diagnostics_.add(by_group ? view.place("count") : most->key->place,
                     fmt::format("the scene has {} bodies; the limit is {}", figure, limit),
                     limit == most_bodies ? "expected a smaller `count`"
                                          : "expected a smaller `count`, or --force if this machine has the memory");
  }

  void number(std::uint64_t total) {
    inventory_.body_count = static_cast<Entity>(total);
    for (const BodyEntry& body : inventory_.bodies) {
      inventory_.names[body.key->text] = {body.first, static_cast<Entity>(body.count)};
    }
    static constexpr const char* sides[] = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};
    for (const FixedEntry& entry : inventory_.fixed) {
      const Entity first = inventory_.body_count + entry.first;
      inventory_.names[entry.key->text] = {first, entry.count};
      for (Entity side = 0; entry.count == 6 && side < 6; ++side) {
        inventory_.names[entry.key->text + "." + sides[side]] = {first + side, 1};
      }
    }
  }

  const Node& root_;
  Diagnostics& diagnostics_;
  Inventory inventory_;
  Entity fixed_count_ = 0;
};

}  // namespace

Inventory take_inventory(const Node& root, const Budget& budget, Diagnostics& diagnostics) {
  return Census(root, diagnostics).run(budget);
}

View scene_part(const Node& root, std::string_view key) {
  const Node* node = root.find(key);
  const Key* name = root.find_key(key);
  return View(node, kind_named(key), name == nullptr ? Place{} : name->place);
}

View body_view(const Node& root, const BodyEntry& entry) {
  return View(entry.node, *entry.kind, entry.key->place, defaults_for(root, *entry.kind));
}

View member_view(const Node& root, const View& group) {
  const Kind& kind = kind_named("member");
  return View(group.given("ball"), kind, group.place("ball"), defaults_for(root, kind));
}

View fixed_view(const Node& root, const FixedEntry& entry) {
  return View(entry.node, *entry.kind, entry.key->place, defaults_for(root, *entry.kind));
}

}  // namespace carom
