// Walks the tree along the table of fields, which determines where numbers and names stand. Texts are never evaluated.
// The map of a repeated thing is a template: for each member its expressions are evaluated in place, and it is copied.
// Members are written out because everything that reads the tree then knows single things alone.
#include "scene/expand.h"

#include <fmt/format.h>

#include "scene/expressions.h"
#include "scene/fields.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

/// As many values as a file may have (document.cpp).
constexpr double most_values = 6e6;
/// Bytes of all expressions of repeated things, times their members. A second evaluates 40 million bytes of sines.
constexpr double most_work = 2e8;
/// Of things that are not repeated. Each is read by itself, in 10 microseconds.
constexpr size_t most_expressions = 200'000;
constexpr size_t most_indices = 8;
/// Of expressions that a manifest lists.
constexpr size_t most_texts = 10'000;

constexpr string_view repeat_key = "repeat";

/// Whether the tree has anything to expand.
bool has_shorthands(const Node& node) {
  if (is_expression(node) || has_braces(node)) return true;
  for (const Key& key : node.keys)
    if (key.text == repeat_key || key.text == "let") return true;
  return any_of(node.items, has_shorthands);
}

size_t count_values(const Node& node) {
  size_t count = 1;
  for (const Node& item : node.items) count += count_values(item);
  return count;
}

/// Whether values of this field hold neither numbers nor names of things.
bool is_text(const Field& field) {
  if (field.range.min == field.range.max) return true;  // the version of the format
  const Inside inside = facts_of(field.type).inside;
  if (inside == Inside::text || inside == Inside::counts || inside == Inside::values) return true;
  if (field.type != Type::choice) return false;
  const vector<string_view> all = choices(field);
  return none_of(all, [](string_view one) { return parse_number(one).has_value(); });
}

/// The last step of the path of a number in a list of them.
string step_of(const Field& field, size_t i) {
  const vector<string_view> components = parts_of(facts_of(field.type).components);
  return i < components.size() ? string(components[i]) : to_string(i);
}

/// The parts of a path before and after the number of a member: "bodies.bricks" and ".mass" of "bodies.bricks.3.mass".
/// The first is empty if the path has none.
pair<string, string> without_member(string_view path) {
  const size_t name = path.find('.'), number = path.find('.', name + 1);
  if (name == string_view::npos || number == string_view::npos) return {};
  const size_t end = min(path.find('.', number + 1), path.size());
  if (!parse_index(path.substr(number + 1, end - number - 1))) return {};
  return {string(path.substr(0, number)), string(path.substr(end))};
}

class Expander {
 public:
  Expander(optional<uint64_t> seed, const Budget& budget, Diagnostics& diagnostics)
      : seed_(seed), budget_(budget), diagnostics_(diagnostics) {}

  ExpressionTexts run(Node& root) {
    values_ = double(count_values(root));
    numbers_.seed = seed_;
    if (Node* let = root.find("let"); let != nullptr && let->is_map()) {
      for (size_t i = 0; i < let->keys.size(); ++i) note("let." + let->keys[i].text, let->items[i]);
      numbers_ = read_let(*let, seed_, diagnostics_);
    }
    map(root, kind_named("scene"), "");
    note_defaults(root);
    if (texts_.size() > most_texts) texts_.clear();
    return std::move(texts_);
  }

 private:
  /// What to do with an expression: evaluate it, add it to those of a template, or mark it so that nothing reads it.
  enum class Mode : uint8_t { evaluate, collect, mark };

  struct Counts {
    vector<string> names;  // of indices
    vector<double> counts;
    double members = 1;
  };

  void map(Node& node, const Kind& kind, const string& path) {
    if (!node.is_map()) return;
    for (size_t i = 0; i < node.keys.size(); ++i) {
      const Field* field = find_field(kind, node.keys[i].text);
      if (field != nullptr && !is_text(*field))
        value(node.items[i], *field, path.empty() ? node.keys[i].text : path + "." + node.keys[i].text);
    }
  }

  void value(Node& node, const Field& field, const string& path) {
    if (field.type == Type::named) return named(node, *field.held, path);
    if (field.type == Type::list) return list(node, *field.held, path);
    if (node.is_map()) {
      if (holds_map(field)) map(node, *field.held, path);
      return;
    }
    if (field.type == Type::file_or_part) return;
    scalar(node, path);
    if (!node.is_sequence()) return;
    for (size_t i = 0; i < node.items.size(); ++i)
      if (is_expression(node.items[i]) || has_braces(node.items[i]))
        scalar(node.items[i], path + "." + step_of(field, i));
  }

  void note(const string& path, const Node& node) {
    if (is_expression(node) && !in_list_ && texts_.size() <= most_texts) texts_.emplace(path, node.text);
  }

  void note_repeat(const string& path, const Node& repeat) {
    string text;
    bool any = is_expression(repeat);
    for (const Node& item : repeat.items) {
      any = any || is_expression(item);
      text += item.text + ";";
    }
    if (any && !in_list_) texts_.emplace(path + ".repeat", repeat.text + text);
  }

  /// Notes the expressions of defaults once more for each thing that uses them.
  void note_defaults(const Node& root) {
    if (texts_.lower_bound("defaults.") == texts_.lower_bound("defaults/")) return;
    for (const Field& field : kind_named("scene").fields) {
      const Node* things = field.type == Type::named ? root.find(field.key) : nullptr;
      if (things == nullptr || !things->is_map()) continue;

      const Kind& kind = *field.held;
      for (size_t i = 0; i < things->keys.size(); ++i) {
        const string_view family = family_of(things->keys[i].text);
        const string path =
            fmt::format("{}.{}", field.key, family.empty() ? string_view(things->keys[i].text) : family);
        note_defaults_of(things->items[i], kind, path);

        // A part may have defaults of its own: the ball of a group.
        for (const Field& part : kind.fields)
          if (part.type == Type::part && things->items[i].find(part.key) != nullptr)
            note_defaults_of(*things->items[i].find(part.key), *part.held, fmt::format("{}.{}", path, part.key));
      }
    }
  }

  void note_defaults_of(const Node& thing, const Kind& kind, const string& path) {
    if (kind.defaults.empty()) return;
    const string start = fmt::format("defaults.{}.", kind.defaults);
    for (auto text = texts_.lower_bound(start); text != texts_.end() && text->first.starts_with(start); ++text) {
      const string rest = text->first.substr(start.size());
      const Field* field = find_field(kind, string_view(rest).substr(0, rest.find('.')));
      if (field == nullptr || thing.find_key(field->key) != nullptr || texts_.size() > most_texts) continue;
      const vector<string_view> others = rivals(*field);
      if (none_of(others, [&](auto key) { return thing.find_key(key) != nullptr; }))
        texts_.emplace(path + "." + rest, text->second);
    }
  }

  void scalar(Node& node, const string& path) {
    if (node.bad || !(is_expression(node) || has_braces(node))) return;
    if (mode_ == Mode::mark) {
      node.bad = true;
      return;
    }
    note(path, node);

    if (mode_ == Mode::evaluate && ++evaluated_ > most_expressions) {
      if (evaluated_ == most_expressions + 1)
        diagnostics_.add(node.place, fmt::format("more than {} expressions", most_expressions),
                         "things of one kind are made by `repeat`");
      node.bad = true;
      return;
    }

    optional<Slot> slot = Slot::of(node, numbers_, diagnostics_);
    if (!slot) return;
    if (mode_ == Mode::evaluate)
      slot->fill(numbers_, diagnostics_);
    else
      slots_.push_back(std::move(*slot));
  }

  static bool is_repeated(const Node& node, const Kind& kind) {
    return node.is_map() && node.find_key(repeat_key) != nullptr && find_field(kind, repeat_key) != nullptr;
  }

  void named(Node& node, const Kind& kind, const string& path) {
    if (!node.is_map()) return;

    bool repeats = false;
    for (size_t i = 0; i < node.keys.size(); ++i) {
      if (kind.also != nullptr && node.keys[i].text == kind.also->key)
        value(node.items[i], *kind.also, path + "." + node.keys[i].text);
      else if (is_repeated(node.items[i], kind))
        repeats = true;
      else
        map(node.items[i], kind, path + "." + node.keys[i].text);
    }

    if (!repeats) return;
    Node whole = std::move(node);
    vector<Node> made;
    node = Node{};
    node.kind = whole.kind;
    node.place = whole.place;

    // Members take the place of the thing that they repeat.
    for (size_t i = 0; i < whole.keys.size(); ++i) {
      const Key& key = whole.keys[i];
      made.clear();
      if (!is_repeated(whole.items[i], kind) ||
          !members(whole.items[i], key.place, kind, path + "." + key.text, made)) {
        node.keys.push_back(key);
        node.items.push_back(std::move(whole.items[i]));
        continue;
      }

      for (size_t k = 0; k < made.size(); ++k) {
        node.keys.push_back({fmt::format("{}.{}", key.text, k), key.place});
        node.items.push_back(std::move(made[k]));
      }
    }
  }

  void list(Node& node, const Kind& kind, const string& path) {
    if (!node.is_sequence()) return;
    vector<Node> made;
    for (Node& item : node.items) {
      if (is_repeated(item, kind)) {
        in_list_ = true;
        const bool good = members(item, item.place, kind, path, made);
        in_list_ = false;
        if (good) continue;
      } else {
        map(item, kind, fmt::format("{}.{}", path, made.size()));
      }

      made.push_back(std::move(item));
    }
    node.items = std::move(made);
  }

  /// Adds the members of a repeated thing to `made`. False: it has none, and stays as it is.
  bool members(Node& thing, Place where, const Kind& kind, const string& path, vector<Node>& made) {
    const size_t errors = diagnostics_.added(), before = numbers_.names.size(), first = made.size();
    note_repeat(path, *thing.find(repeat_key));
    const optional<Counts> counts = read_counts(*thing.find(repeat_key), where);

    bool good = counts && counts->members > 0;
    if (good) {
      for (const string& name : counts->names) numbers_.add(name, 0);
      diagnostics_.mark_repeated(where);
      mark_repeated(thing);
      good = make(thing, *counts, kind, path, made) && diagnostics_.added() == errors;
      numbers_.names.resize(before);
      numbers_.values.resize(before);
      numbers_.known.resize(before);
    }
    if (good) return true;

    // It stays as it is, and nothing reads its expressions.
    made.resize(first);
    mode_ = Mode::mark;
    map(thing, kind, path);
    mode_ = Mode::evaluate;
    return false;
  }

  void mark_repeated(const Node& node) {
    diagnostics_.mark_repeated(node.place);
    for (const Key& key : node.keys) diagnostics_.mark_repeated(key.place);
    for (const Node& item : node.items) mark_repeated(item);
  }

  bool make(Node& thing, const Counts& counts, const Kind& kind, const string& path, vector<Node>& made) {
    const auto at = thing.find_key(repeat_key) - thing.keys.data();
    const Place where = thing.keys[size_t(at)].place;

    // The template is the thing without `repeat`.
    Node pattern = thing;
    pattern.keys.erase(pattern.keys.begin() + at);
    pattern.items.erase(pattern.items.begin() + at);

    slots_.clear();
    mode_ = Mode::collect;
    map(pattern, kind, path);
    mode_ = Mode::evaluate;

    // What its members cost.
    const size_t count_of_values = count_values(pattern);
    double work = 0;
    for (const Slot& slot : slots_) work += double(slot.length()) * counts.members;
    const double values = values_ + double(count_of_values) * counts.members;

    if (values > most_values || work_ + work > most_work) {
      diagnostics_.add(where,
                       values > most_values ? fmt::format("with these members the scene has {} values; the limit is {}",
                                                          values, most_values)
                                            : "evaluating the expressions of so many members takes too long",
                       "expected a smaller `repeat`; many balls of one kind are a group: `groups`");
      return false;
    }

    work_ += work;
    values_ = values;
    made.reserve(made.size() + size_t(counts.members));
    return fill(pattern, counts, made);
  }

  bool fill(const Node& pattern, const Counts& counts, vector<Node>& made) {
    const size_t indices = counts.names.size(), first = numbers_.names.size() - indices;
    for (uint64_t member = 0; member < uint64_t(counts.members); ++member) {
      uint64_t rest = member;

      // The indices of this member: the last one varies fastest.
      for (size_t k = indices; k-- > 0;) {
        const auto count = uint64_t(counts.counts[k]);
        numbers_.values[first + k] = double(rest % count);
        rest /= count;
      }

      for (Slot& slot : slots_)
        if (!slot.fill(numbers_, diagnostics_)) return false;
      made.push_back(pattern);
    }
    return true;
  }

  /// The value of a count. None: an error was added.
  optional<double> read_count(Node& node, const string& name) {
    const size_t errors = diagnostics_.added();
    const Place place = node.place;
    if (is_expression(node)) {
      optional<Slot> slot = Slot::of(node, numbers_, diagnostics_);
      if (!slot || !slot->fill(numbers_, diagnostics_)) return nullopt;
    }

    const bool is_number = node.is_scalar() && !node.quoted;
    const optional<double> value = is_number ? parse_number(node.text) : nullopt;
    if (value && *value >= 0 && floor(*value) == *value) return value;

    node.bad = true;
    if (diagnostics_.added() == errors)
      diagnostics_.add(place,
                       fmt::format("{} is {}", name,
                                   node.is_null()     ? "empty"
                                   : node.is_scalar() ? in_backticks(node.text)
                                   : node.is_map()    ? "a map of keys"
                                                      : "a list"),
                       "expected a whole number of at least 0");
    return nullopt;
  }

  optional<Counts> read_counts(Node& node, Place where) {
    Counts counts;
    bool good = true;

    if (node.is_map()) {
      if (node.items.empty() || node.items.size() > most_indices) {
        diagnostics_.add(node.place, fmt::format("`repeat` has {} indices", node.items.size()),
                         fmt::format("expected 1 to {}, such as {{i: 6, j: 4}}", most_indices));
        return nullopt;
      }

      for (size_t i = 0; i < node.keys.size(); ++i) {
        good = check_index(node.keys[i], node.keys[i].place, node) && good;
        const optional<double> count = read_count(node.items[i], in_backticks(node.keys[i].text));
        good = good && count;
        counts.names.push_back(node.keys[i].text);
        counts.counts.push_back(count.value_or(0));
        counts.members *= counts.counts.back();
      }

    } else {
      good = check_index({"i", {}}, node.place, node);
      const optional<double> count = read_count(node, "`repeat`");
      good = good && count;
      counts = {{"i"}, {count.value_or(0)}, count.value_or(0)};
    }

    if (!good) return nullopt;
    if (budget_.enforced && counts.members > double(budget_.bodies)) {
      diagnostics_.add(place_of_repeat(node, where),
                       fmt::format("`repeat` makes {} members; the limit is {}", counts.members, budget_.bodies),
                       "expected a smaller `repeat`");
      return nullopt;
    }

    // Nothing reads the indices of a thing without members.
    if (counts.members == 0) {
      const Place place = node.place;
      node = Node{};
      node.kind = Node::Kind::scalar;
      node.text = "0";
      node.place = place;
    }
    return counts;
  }

  static Place place_of_repeat(const Node& node, Place where) { return node.is_null() ? where : node.place; }

  /// A letter that is neither a name of `let` nor an index of this `repeat`.
  string free_index(const Node& repeat) const {
    for (const char c : string_view("kjnmabcdefghlopqrstuvwxyz"))
      if (const string name(1, c); !numbers_.has(name) && repeat.find_key(name) == nullptr) return name;
    return "number";
  }

  /// `repeat`: the value that has the index.
  bool check_index(const Key& key, Place where, const Node& repeat) {
    const string shown = in_backticks(key.text);
    if (!is_name(key.text) || key.text.find('-') != string::npos) {
      diagnostics_.add(where, fmt::format("{} is not a name for an index", shown),
                       "expected letters, digits and _, a letter or _ first");
    } else if (is_formula_word(key.text)) {
      diagnostics_.add(where, fmt::format("{} is a {} of expressions", shown, key.text == "pi" ? "number" : "function"),
                       "expected another name for the index");

    } else if (numbers_.has(key.text)) {
      diagnostics_.add(
          where, fmt::format("the index {} is a name of `let`, too", shown),
          fmt::format("name the index otherwise, such as `repeat: {{{}: 7}}`, or the number", free_index(repeat)));
    } else {
      return true;
    }
    return false;
  }

  const optional<uint64_t> seed_;
  const Budget& budget_;
  Diagnostics& diagnostics_;
  NamedNumbers numbers_;
  Mode mode_ = Mode::evaluate;
  vector<Slot> slots_;  // of the template that is read
  ExpressionTexts texts_;
  bool in_list_ = false;  // in a repeated entry of a list
  size_t evaluated_ = 0;
  double values_ = 0, work_ = 0;
};

}  // namespace

namespace {

/// None: it is an expression.
optional<uint64_t> seed_of(const Node& root) {
  const Node* seed = root.find("seed");
  if (seed != nullptr && is_expression(*seed)) return nullopt;
  // The check refuses one that is no number.
  return as_whole(seed).value_or(0);
}

/// Gives groups without a `ball` an empty one, which then has the values of `defaults: {ball: ..}`.
void write_out_balls(Node& root) {
  const Node* defaults = root.find("defaults");
  const Node* ball = defaults == nullptr ? nullptr : defaults->find("ball");
  const Node* group = defaults == nullptr ? nullptr : defaults->find("group");
  const Node* common = group == nullptr ? nullptr : group->find("ball");
  if (ball == nullptr || ball->keys.empty() || (common != nullptr && common->is_map())) return;

  Node* groups = root.find("groups");
  for (size_t i = 0; groups != nullptr && i < groups->keys.size(); ++i) {
    Node& each = groups->items[i];
    if (!each.is_map() || each.find("ball") != nullptr) continue;
    const Place where = groups->keys[i].place;
    each.keys.push_back({"ball", where});
    Node& empty = each.items.emplace_back();
    empty.kind = Node::Kind::map;
    empty.place = where;
  }
}

}  // namespace

void write_out(Node& part, const Kind& kind) {
  for (const Field& field : kind.fields) {
    if (!part.is_map()) return;
    Node* value = field.held == nullptr ? nullptr : part.find(field.key);
    if (value == nullptr) continue;
    if (field.type == Type::named && value->is_map())
      for (Node& entry : value->items) write_out(entry, *field.held);
    if (field.type != Type::part && field.type != Type::part_or_flag) continue;
    if (value->is_map()) write_out(*value, *field.held);

    // A list stands for a list, and any other plain value for one.
    if (field.plain.empty()) continue;
    const Type plain = find_field(*field.held, field.plain)->type;
    const bool list = plain == Type::list || plain == Type::names;
    if (!(list ? value->is_sequence() : value->is_scalar())) continue;
    Node whole;
    whole.kind = Node::Kind::map;
    whole.place = value->place;
    whole.keys.push_back({string(field.plain), value->place});
    whole.items.push_back(std::move(*value));
    *value = std::move(whole);
  }
}

const string* expression_at(const ExpressionTexts& texts, string_view path) {
  if (const auto found = texts.find(string(path)); found != texts.end()) return &found->second;
  const auto [family, rest] = without_member(path);
  const auto found = family.empty() ? texts.end() : texts.find(family + rest);
  return found == texts.end() ? nullptr : &found->second;
}

const string* repeat_of(const ExpressionTexts& texts, string_view path) {
  const string family = without_member(path).first;
  const auto found = family.empty() ? texts.end() : texts.find(family + ".repeat");
  return found == texts.end() ? nullptr : &found->second;
}

ExpressionTexts expand(Node& root, optional<uint64_t> seed, const Budget& budget, Diagnostics& diagnostics) {
  write_out_balls(root);
  if (!has_shorthands(root)) return {};
  return Expander(seed ? seed : seed_of(root), budget, diagnostics).run(root);
}

}  // namespace carom
