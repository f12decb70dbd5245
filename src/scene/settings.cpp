// Applies --set by walking its path through the tree and the table of fields together.
// Missing maps on the way are created from defaults, so that a part such as position.x can be set by itself.
// The checks run after all settings, on the changed tree, so that a setting is checked as the file is.
#include "scene/settings.h"

#include <fmt/format.h>

#include "scene/check.h"
#include "scene/fields.h"
#include "scene/view.h"
#include "std.h"
#include "yaml/source.h"
#include "yaml/values.h"

namespace carom {
namespace {

struct Step {
  string text;
  Place place;
};

vector<Step> split_path(string_view path, uint32_t index) {
  vector<Step> steps;
  for (size_t i = 0; i <= path.size();) {
    const size_t end = min(path.find('.', i), path.size());
    const size_t length = end - i;
    steps.push_back({string(path.substr(i, length)), {index, uint32_t(i), uint32_t(max<size_t>(length, 1))}});
    i = end + 1;
  }
  return steps;
}

vector<string_view> names_in(const Node& node) {
  vector<string_view> names;
  for (const Key& key : node.keys) names.push_back(key.text);
  return names;
}

void erase(Node& map, string_view key) {
  for (size_t i = 0; i < map.keys.size(); ++i) {
    if (map.keys[i].text != key) continue;
    map.keys.erase(map.keys.begin() + ptrdiff_t(i));
    map.items.erase(map.items.begin() + ptrdiff_t(i));
    return;
  }
}

/// Walks down one path. Each step either advances `node` or adds an error and returns false.
class Walk {
 public:
  Walk(Node& root, Diagnostics& diagnostics)
      : root_(root), node_(&root), kind_(&kind_named("scene")), diagnostics_(diagnostics) {}

  Node& node() { return *node_; }

  bool step(const Step& step, bool last) {
    if (done_) return refuse(step, fmt::format("{} has no parts", in_backticks(before_)), "end the path before it");
    if (step.text.empty())
      return refuse(step, "a name is missing in the path", "expected names with single dots between them");
    const bool moved = kind_ != nullptr ? into_key(step, last) : into_value(step);
    if (moved && last && !family_.empty())
      return refuse(step, fmt::format("{} has several members", in_backticks(step.text)),
                    fmt::format("name one of them, such as {}.0", step.text));
    before_ = step.text;
    return moved;
  }

 private:
  /// Takes back what was changed on the way, so that the checks do not complain about it.
  bool refuse(const Step& step, string message, string remedy) {
    if (changed_ != nullptr) {
      erase(*changed_, new_key_);
      for (auto& [key, value] : replaced_) {
        changed_->keys.push_back(std::move(key));
        changed_->items.push_back(std::move(value));
      }
    }
    diagnostics_.add(step.place, std::move(message), std::move(remedy));
    return false;
  }

  /// A step to a key of a map of kind_.
  bool into_key(const Step& step, bool last) {
    if (!node_->is_map()) {
      // A list is not a map, so the step fails. A flag or an absent value is replaced by a map.
      if (node_->is_sequence())
        return refuse(step, fmt::format("{} is a list", in_backticks(before_)), "expected a map of keys");
      const Node value = exchange(*node_, Node{});
      node_->kind = Node::Kind::map;
      node_->place = value.place;
      // The path of a mesh becomes the map's `file`.
      if (field_ != nullptr && field_->type == Type::file_or_part && value.is_scalar()) set_key(*node_, "file", value);
    }

    const Field* field = find_field(*kind_, step.text);
    if (field == nullptr && into_plain_list(step)) return true;
    if (field == nullptr) {
      return refuse(step,
                    fmt::format("unknown key {} in {}", in_backticks(step.text),
                                kind_->name == "scene" ? "the scene" : in_backticks(kind_->name)),
                    suggest_key(step.text, *kind_));
    }

    // Take the place of rivals, and stand in the map.
    for (const string_view rival : rivals(*field)) replace(rival, *field);
    Node* child = node_->find(field->key);
    if (child == nullptr) {
      if (changed_ == nullptr) changed_ = node_;
      if (changed_ == node_) new_key_ = step.text;
      node_->keys.push_back({step.text, step.place});
      node_->items.push_back(last ? Node{} : fallback(*field));
      child = &node_->items.back();
      child->place = step.place;
    } else if (last) {
      for (Key& key : node_->keys) {
        if (key.text == field->key) key.place = step.place;
      }
    }

    node_ = child;
    field_ = field;
    kind_ = holds_map(*field) ? field->held : nullptr;
    return true;
  }

  /// Erases a key that `by` excludes, and those that stood beside it and have no place beside `by`.
  void replace(string_view key, const Field& by) {
    if (node_->find_key(key) == nullptr) return;
    take_out(key);
    for (const Field& other : kind_->fields) {
      if (other.with.empty()) continue;
      vector<string_view> companions = parts_of(other.spared_by);
      companions.push_back(other.with);
      const bool stood = contains(companions, key);
      const bool stays = any_of(companions, [&](string_view companion) {
        return companion == by.key || node_->find_key(companion) != nullptr;
      });
      if (stood && !stays) take_out(other.key);
    }
  }

  void take_out(string_view key) {
    if (node_->find_key(key) == nullptr) return;
    if (changed_ == nullptr) changed_ = node_;
    if (changed_ == node_) replaced_.emplace_back(*node_->find_key(key), *node_->find(key));
    erase(*node_, key);
  }

  /// The initial value of a missing value that is set in part: that of the defaults, of the table, or nothing.
  Node fallback(const Field& field) const {
    const Node* defaults = defaults_for(root_, *kind_);
    if (defaults != nullptr && defaults != node_) {
      if (const Node* node = defaults->find(field.key)) return *node;
    }
    return field.initial.empty() ? Node{} : *field.member.initial_node;
  }

  /// A step to a part of a value of field_.
  bool into_value(const Step& step) {
    const TypeFacts& facts = facts_of(field_->type);
    switch (facts.inside) {
      case Inside::named:
        return into_named(step);
      case Inside::list:
        return into_list(step);
      case Inside::numbers:
        return into_numbers(step, parts_of(facts.components));

      case Inside::values:
      case Inside::counts: {
        Node* child = node_->is_map() ? node_->find(step.text) : nullptr;
        if (child == nullptr)
          return refuse_name(step, fmt::format("{} has no {}", in_backticks(before_), in_backticks(step.text)));
        node_ = child;
        done_ = true;
        return true;
      }
      default:
        return refuse(step, fmt::format("{} has no parts", in_backticks(before_)), "end the path before it");
    }
  }

  /// A step to an entry of the list that may stand in place of this map (Field::plain).
  bool into_plain_list(const Step& step) {
    if (field_ == nullptr || field_->plain.empty() || !parse_index(step.text)) return false;
    Node* const list = node_->find(field_->plain);
    const Field* const plain = find_field(*kind_, field_->plain);
    if (list == nullptr || plain->type != Type::list) return false;
    node_ = list;
    field_ = plain;
    return into_list(step);
  }

  bool into_list(const Step& step) {
    const optional<uint64_t> i = parse_index(step.text);
    if (!i || *i >= node_->items.size() || !node_->is_sequence()) {
      const size_t count = node_->items.size();
      return refuse(step, fmt::format("{} has no entry {}", in_backticks(before_), in_backticks(step.text)),
                    count == 0   ? fmt::format("it has none: set all of {}", in_backticks(before_))
                    : count == 1 ? "its only entry is 0"
                                 : fmt::format("its entries are 0 to {}", count - 1));
    }
    node_ = &node_->items[size_t(*i)];
    kind_ = field_->held;
    return true;
  }

  bool refuse_name(const Step& step, string message) {
    const string suggestion = suggest_name(step.text, names_in(*node_));
    constexpr string_view rule = "--set changes existing entries and adds none";
    return refuse(step, std::move(message),
                  suggestion.starts_with("did") ? suggestion
                  : suggestion.empty()          ? string(rule)
                                                : fmt::format("{}\n{}", suggestion, rule));
  }

  /// Members stand in a file as `row.0`, two steps of the path. The first of them is kept in family_ until the second.
  Node* member(const Step& step) {
    if (!node_->is_map()) return nullptr;
    if (!family_.empty()) {
      const string name = family_ + "." + step.text;
      family_.clear();
      return node_->find(name);
    }
    if (node_->find_key(step.text + ".0") != nullptr) family_ = step.text;
    return nullptr;
  }

  bool into_named(const Step& step) {
    const Kind& kind = *field_->held;
    Node* child = node_->is_map() ? node_->find(step.text) : nullptr;
    const string family = family_;
    if (child == nullptr) child = member(step);

    if (child == nullptr && !family_.empty()) return true;
    if (child == nullptr && !family.empty())
      return refuse(step, fmt::format("{} has no member {}", in_backticks(family), in_backticks(step.text)),
                    fmt::format("its members are {}.0 and so on", family));
    if (child == nullptr)
      return refuse_name(step, fmt::format("there is no {} {}", kind.name, in_backticks(step.text)));

    node_ = child;
    if (kind.also != nullptr && step.text == kind.also->key) {
      done_ = true;
    } else {
      kind_ = &kind;
    }
    return true;
  }

  bool into_numbers(const Step& step, const vector<string_view>& names) {
    for (size_t i = 0; i < names.size(); ++i) {
      if (step.text != names[i]) continue;
      if (!node_->is_sequence() || node_->items.size() != names.size()) {
        return refuse(step, fmt::format("{} has no numbers yet", in_backticks(before_)),
                      fmt::format("set all of {}", in_backticks(before_)));
      }
      node_ = &node_->items[i];
      done_ = true;
      return true;
    }
    return refuse(step, fmt::format("{} has no {}", in_backticks(before_), in_backticks(step.text)),
                  "expected " + listed(names));
  }

  const Node& root_;
  Node* node_;
  /// The kind of the map that node_ is. Null: node_ is a value of field_.
  const Kind* kind_;
  const Field* field_ = nullptr;
  bool done_ = false;  // node_ has no parts
  string family_;      // see member()
  string before_ = "scene";
  /// The first map that a step changed, the key that it got, and those that this key replaced. Null: no step did.
  Node* changed_ = nullptr;
  string new_key_;
  vector<pair<Key, Node>> replaced_;
  Diagnostics& diagnostics_;
};

}  // namespace

void apply_setting(Node& root, vector<Source>& sources, uint32_t index, Diagnostics& diagnostics) {
  const string& text = sources[index].text;
  const size_t equals = text.find('=');
  if (equals == string::npos || equals == 0) {
    diagnostics.add({index, 0, uint32_t(max<size_t>(text.size(), 1))}, "this sets nothing",
                    "expected path=value, such as simulate.duration=2");
    return;
  }

  const Place value_place{index, uint32_t(min(equals + 1, text.size())), 1};
  if (!check_text(sources[index], index, diagnostics)) return;

  optional<Node> value;
  if (text.compare(equals + 1, 1, "#") == 0) {
    // In a file an unquoted # begins a comment. Here it can only begin a colour.
    value = Node{};
    value->kind = Node::Kind::scalar;
    value->text = text.substr(equals + 1);
    value->place = {index, value_place.offset, uint32_t(value->text.size())};
  } else {
    value = parse_document(sources, index, equals + 1, diagnostics);
  }

  if (!value) return;
  if (value->is_null()) {
    diagnostics.add(value_place, "there is no value", "expected path=value");
    return;
  }

  const vector<Step> steps = split_path(string_view(text).substr(0, equals), index);
  Walk walk(root, diagnostics);
  for (size_t i = 0; i < steps.size(); ++i) {
    if (!walk.step(steps[i], i + 1 == steps.size())) return;
  }
  walk.node() = std::move(*value);
}

}  // namespace carom
