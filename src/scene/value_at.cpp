// Follows a path through the views of the tree, which know defaults. settings.cpp follows paths to change the tree.
#include "scene/value_at.h"

#include <fmt/format.h>

#include "scene/check.h"
#include "scene/fields.h"
#include "scene/scene_values.h"
#include "scene/view.h"
#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/values.h"

namespace carom {
namespace {

/// The place of a path's start in the tree, advanced by steps.
class PathWalk {
 public:
  explicit PathWalk(const Node& root)
      : root_(root), view_(std::in_place, &root, kind_named("scene"), Place{}), node_(&root) {}

  /// Returns false, with a problem and a remedy in `found`, if the step leads nowhere.
  bool step(string_view step, ValueAtPath& found) {
    found_ = &found;
    const bool moved = view_ ? to_key(step) : into_value(step);
    before_ = step;
    return moved;
  }

  bool at_map() const {
    return view_ || (field_ != nullptr && (field_->type == Type::named || field_->type == Type::list)) ||
           (node_ != nullptr && node_->is_map());
  }
  const Node* node() const { return node_; }

 private:
  bool fail(string problem, string remedy = "") {
    found_->problem = std::move(problem);
    found_->remedy = std::move(remedy);
    return false;
  }

  bool to_key(string_view step) {
    const Field* field = find_field(view_->kind(), step);
    if (field == nullptr)
      return fail(fmt::format("unknown key {} in {}", in_backticks(step),
                              view_->kind().name == "scene" ? "the scene" : in_backticks(view_->kind().name)),
                  suggest_key(step, view_->kind()));
    field_ = field;
    node_ = view_->find(*field);
    const bool absent = node_ == nullptr || !node_->is_map();
    if (holds_map(*field) && !(absent && facts_of(field->type).or_value)) return to_part(*field, absent);
    view_.reset();
    return node_ != nullptr || fail(fmt::format("{} has no value in this scene", in_backticks(step)));
  }

  bool to_part(const Field& field, bool absent) {
    const Kind& kind = *field.held;
    const bool needs = any_of(kind.fields, [](const Field& f) { return f.needed; });
    const bool wanted = field.type == Type::part_or_flag ? view_->wants(field.key) : field.type == Type::part && !needs;
    if (absent && !wanted) return fail(fmt::format("this scene has no {}", in_backticks(field.key)));
    const View part = view_->part(field);
    // A ball of a group has the defaults of balls. Of other parts, View::part knows the layers.
    view_ = kind.defaults.empty() ? part : View(node_, kind, part.where(), defaults_for(root_, kind));
    return true;
  }

  bool into_value(string_view step) {
    if (field_->type == Type::named || field_->type == Type::list) return to_entry(step);
    if ((field_->type == Type::values || field_->type == Type::texts) && node_->is_map()) return to_number(step);
    const bool numbers = node_->is_sequence();
    for (const auto& names : {vector<string_view>{"x", "y", "z"}, {"width", "height"}}) {
      if (!numbers || names.size() != node_->items.size()) continue;
      const auto at = ranges::find(names, step);
      if (at == names.end()) break;
      node_ = &node_->items[size_t(at - names.begin())];
      return true;
    }
    return fail(fmt::format("{} has no part {}", in_backticks(before_), in_backticks(step)), "end the path before it");
  }

  /// A number with a name.
  bool to_number(string_view step) {
    const Node* number = node_->find(step);
    if (number == nullptr) return fail(fmt::format("{} has no {}", in_backticks(before_), in_backticks(step)));
    node_ = number;
    return true;
  }

  bool to_entry(string_view step) {
    const Kind& kind = *field_->held;
    const Node* entry = nullptr;

    if (field_->type == Type::named) {
      // Members stand in the tree as `row.0`, two steps of the path.
      const string family = exchange(family_, {});
      const string name = family.empty() ? string(step) : fmt::format("{}.{}", family, step);
      entry = node_->find(name);
      if (entry == nullptr && !family.empty())
        return fail(fmt::format("{} has no member {}", in_backticks(family), in_backticks(step)),
                    fmt::format("its members are {}.0 and so on", family));
      if (entry == nullptr && node_->find_key(name + ".0") != nullptr) {
        family_ = name;
        return true;
      }
    } else if (const auto index = parse_index(step); index && *index < node_->items.size()) {
      entry = &node_->items[size_t(*index)];
    }

    if (entry == nullptr) {
      vector<string_view> names;
      for (const Key& key : node_->keys) names.push_back(key.text);
      return fail(fmt::format("there is no {} {}", kind.name, in_backticks(step)), suggest_name(step, names));
    }

    node_ = entry;
    field_ = nullptr;
    if (kind.also != nullptr && step == kind.also->key)
      field_ = kind.also;
    else
      view_.emplace(entry, kind, entry->place, defaults_for(root_, kind));
    return true;
  }

  const Node& root_;
  /// The map that the path has reached. None: it has reached the value node_ of field_.
  optional<View> view_;
  const Node* node_;
  const Field* field_ = nullptr;
  string family_;  // the repeated thing whose member the next step names
  string before_ = "the scene";
  ValueAtPath* found_ = nullptr;
};

}  // namespace

ValueAtPath value_at(const Node& root, string_view path) {
  ValueAtPath found;
  PathWalk walk(root);

  for (size_t i = 0; i <= path.size();) {
    const size_t end = min(path.find('.', i), path.size());
    if (!walk.step(path.substr(i, end - i), found)) return found;
    i = end + 1;
  }

  if (walk.at_map()) {
    found.problem = fmt::format("{} holds several values", in_backticks(path));
    found.remedy = "name one of them";
  } else if (walk.node()->bad) {
    found.text = "?";  // an error was reported at its own place
  } else {
    found.text = text_of_value(*walk.node());
  }
  return found;
}

}  // namespace carom
