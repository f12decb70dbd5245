// Walks the tree and the table of fields together, one function for each type of map.
// Errors mark values bad instead of ending the walk, so that one run reports all of them.
// A key that is probably a misspelt field yields one error and not a second one for the missing field.
#include "scene/check.h"

#include <fmt/format.h>

#include <tuple>

#include "scene/absent_words.h"
#include "scene/check_values.h"
#include "scene/fields.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "std.h"
#include "yaml/joined.h"
#include "yaml/letters.h"
#include "yaml/lookalikes.h"
#include "yaml/other_case.h"
#include "yaml/printable.h"
#include "yaml/values.h"

namespace carom {
namespace {

// Beyond this number of errors, which exceeds those shown, no time is spent on near names.
constexpr size_t most_suggestions = 200;

vector<string_view> keys_of(const Kind& kind) {
  vector<string_view> keys;
  for (const Field& field : kind.fields) {
    keys.push_back(field.key);
  }
  if (kind.also != nullptr) keys.push_back(kind.also->key);
  return keys;
}

bool is_before(const Place& a, const Place& b) {
  return tie(a.source, a.offset) < tie(b.source, b.offset);
}

class Checker : ValueChecker {
 public:
  Checker(const Node& root, const string& folder, Diagnostics& diagnostics)
      : ValueChecker(diagnostics), root_(root), folder_(folder) {}

  /// Checks a map of `kind`. `what` is its name in messages, `where` its key. `partial`: no key has to be present.
  void map(Node& node, const Kind& kind, const string& what, Place where, bool partial) {
    if (!node.is_map()) {
      wrong_type(node, what, "expected a map of keys");
      return;
    }
    if (!kind.defaults.empty()) mark_cancelled(node, kind);

    // What the defaults cancel is known before the things that may need it, wherever the file has them.
    for (const bool defaults_now : {true, false})
      for (size_t i = 0; i < node.keys.size(); ++i)
        if ((node.keys[i].text == "defaults") == defaults_now)
          entry(node.keys[i], node.items[i], node, kind, what, partial);
    if (partial) return;

    const Node* defaults = defaults_for(root_, kind);
    needed(node, defaults, kind, what, where);
    needed_beside(View(&node, kind, where, defaults), node, what);
    one_of_any(node, kind, what, where);
    // A part that comes from the defaults alone must be complete, too.
    for (const Field& field : kind.fields) {
      if (field.type != Type::part || node.find_key(field.key) != nullptr || defaults == nullptr) continue;
      const Node* part = defaults->find(field.key);
      if (part == nullptr || !part->is_map() || field.held->defaults.empty()) continue;
      Node whole = *part;
      needed(whole, defaults_for(root_, *field.held), *field.held, in_backticks(field.key), where);
    }
  }

 private:
  void needed(Node& node, const Node* defaults, const Kind& kind, const string& what, Place where) {
    for (const Field& field : kind.fields) {
      if (!field.needed || has_any(node, defaults, field)) continue;
      node.bad = true;
      if (!is_misspelt_in(node, kind, field)) missing(node, defaults, kind, field, what, where);
    }
  }

  /// Checks Field::with.
  void needed_beside(const View& view, Node& node, const string& what) {
    for (const Field& field : view.kind().fields) {
      if (field.with.empty() || view.given(field.key) == nullptr || view.given(field.with) != nullptr) continue;
      // A map without a needed key has an error about that already.
      const Field& with = *find_field(view.kind(), field.with);
      const vector<string_view> sparing = parts_of(field.spared_by), others = substitutes(with);
      if (with.needed && none_of(others, [&](auto key) { return view.given(key) != nullptr; })) continue;
      if (any_of(sparing, [&](auto key) { return view.given(key) != nullptr; })) continue;
      const Key* key = node.find_key(field.key);
      node.bad = true;
      diagnostics_.add(key == nullptr ? view.where() : key->place,
                       fmt::format("{} has {} but no {}", what, in_backticks(field.key), in_backticks(field.with)),
                       fmt::format("expected {}: {}", in_backticks(field.with), expected(with)));
    }
  }

  /// Checks Kind::any_of.
  void one_of_any(Node& node, const Kind& kind, const string& what, Place where) {
    const vector<string_view> keys = parts_of(kind.any_of);
    if (keys.empty() || any_of(keys, [&](auto key) { return node.find_key(key) != nullptr; })) return;
    string message = what + " has", remedy = "expected ";
    for (const string_view key : keys) {
      const bool first = key == keys.front();
      message += fmt::format("{} no {}", first ? "" : " and", in_backticks(key));
      remedy += fmt::format("{}{} ({})", first ? "" : ", ", in_backticks(key), find_field(kind, key)->unit);
    }
    node.bad = true;
    diagnostics_.add(where, std::move(message), remedy + " or both");
  }

  /// Whether an unknown key of the map is probably this field misspelt. Then one error covers both.
  static bool is_misspelt_in(const Node& node, const Kind& kind, const Field& field) {
    for (size_t i = 0; i < min(node.keys.size(), most_suggestions); ++i) {
      const Key& key = node.keys[i];
      if (find_field(kind, key.text) != nullptr) continue;
      const string near = meant(key.text, kind);
      const vector<string_view> others = substitutes(field);
      if (near == field.key || contains(others, near)) return true;
    }
    return false;
  }
  static string meant(string_view key, const Kind& kind) {
    const string_view head = key.substr(0, key.find_first_of(": "));
    return find_field(kind, head) != nullptr ? string(head) : nearest(key, keys_of(kind));
  }

  /// The word none cancels a default, except where it is a value itself.
  static void mark_cancelled(Node& node, const Kind& kind) {
    for (size_t i = 0; i < node.keys.size(); ++i) {
      Node& value = node.items[i];
      if (value.text != "none" || !value.is_scalar()) continue;
      const Field* field = find_field(kind, node.keys[i].text);
      if (field == nullptr || field->type == Type::text || field->own) continue;
      if (field->type == Type::color_or_none || field->type == Type::number_or_none) continue;
      // A file may have this name, in quotes.
      if ((field->type == Type::file || field->type == Type::file_or_part) && value.quoted) continue;
      const vector<string_view> all = field->type == Type::choice ? choices(*field) : vector<string_view>();
      value.cancels = !contains(all, "none");
    }
  }

  static bool has(const Node& node, const Node* defaults, string_view key) {
    if (const Node* own = node.find(key)) return !own->cancels;
    const Node* given = defaults == nullptr ? nullptr : defaults->find(key);
    return given != nullptr && !given->cancels;
  }
  static bool has_any(const Node& node, const Node* defaults, const Field& field) {
    const vector<string_view> others = substitutes(field);
    return has(node, defaults, field.key) ||
           any_of(others, [&](string_view other) { return has(node, defaults, other); });
  }

  void missing(const Node& node, const Node* defaults, const Kind& kind, const Field& field, const string& what,
               Place where) {
    if (find_field(kind, "fit") != nullptr && field.one_of.find("fit") != string_view::npos &&
        has(node, defaults, "mesh")) {
      diagnostics_.add(
          where, fmt::format("{} has a `mesh` but no volume", what),
          fmt::format("expected `fit`: {}, the tightest one around the mesh", expected(*find_field(kind, "fit"))));
      return;
    }

    string message = fmt::format("{} has no {}", what, in_backticks(field.key));
    string remedy = fmt::format("expected {}: {}", in_backticks(field.key), expected(field));
    for (const string_view key : substitutes(field)) {
      const Field& other = *find_field(kind, key);
      message += fmt::format(" and no {}", in_backticks(key));
      remedy += fmt::format("\nor {}: {}", in_backticks(key), expected(other));
    }

    diagnostics_.add(where, std::move(message), std::move(remedy));
  }

  /// A decimal comma in a flow map: `mass: 1,5` is a 1 and a key 5 without a value. Marks both as one number.
  bool decimal_comma(const Key& key, const Node& value, Node& map_node) {
    const auto i = size_t(&key - map_node.keys.data());
    if (i == 0 || !value.is_null()) return false;

    // The two parts stand side by side, and make a number.
    Node& whole = map_node.items[i - 1];
    const bool joined = whole.place.source == key.place.source &&
                        whole.place.offset + whole.place.length + 1 == key.place.offset;  // the comma
    const string point = whole.text + "." + key.text;
    if (!joined || !whole.is_scalar() || key.text.front() < '0' || key.text.front() > '9' || !parse_number(point))
      return false;

    diagnostics_.add({whole.place.source, whole.place.offset, whole.place.length + 1 + key.place.length},
                     fmt::format("`{},{}` has a comma", whole.text, key.text),
                     fmt::format("the decimal point is a point: {}", point));
    whole.bad = true;
    return true;
  }

  void unknown_key(const Key& key, const Node& value, const Kind& kind, const string& what) {
    // In YAML, `radius 0.1` and `radius:0.1` are keys without a value.
    const size_t gap = key.text.find_first_of(": ");
    if (value.is_null() && gap != string::npos && gap > 0) {
      const string_view head = string_view(key.text).substr(0, gap);
      size_t tail = key.text.find_first_not_of(": ", gap);

      // What follows the colon, without characters that look like one.
      while (const auto found = lookalike_at(key.text, tail)) {
        char32_t code = 0;
        tail += size_t(utf8_length(key.text, tail, code));
      }

      const string suggestion = find_field(kind, head) != nullptr || is_name(head) ? string(head) : "key";
      diagnostics_.add(key.place, fmt::format("{} is a key without a value", in_backticks(key.text)),
                       tail >= key.text.size() ? "expected `key: value`"
                                               : fmt::format("did you mean {}? A ':' and a space part key and value",
                                                             in_backticks(suggestion + ": " + key.text.substr(tail))));
      return;
    }

    const string message = fmt::format("unknown key {} in {}", in_backticks(key.text), what);
    if (!diagnostics_.add_member(key.place, message)) diagnostics_.add(key.place, message, suggest_key(key.text, kind));
  }

  void entry(const Key& key, Node& value, Node& map_node, const Kind& kind, const string& what, bool partial) {
    const Field* field = find_field(kind, key.text);
    if (field == nullptr) {
      if (!decimal_comma(key, value, map_node)) unknown_key(key, value, kind, what);
      return;
    }
    if (value.cancels) return;
    // Two keys that exclude one another are reported once, at the second.
    const Key* other = nullptr;
    for (const string_view rival : rivals(*field)) {
      const Key* found = map_node.find_key(rival);
      if (found != nullptr && !map_node.find(rival)->cancels &&
          is_before(found->place, other == nullptr ? key.place : other->place))
        other = found;
    }
    if (other != nullptr) {
      diagnostics_.add(key.place,
                       fmt::format("{} has both {} and {}", what, in_backticks(other->text), in_backticks(key.text)),
                       "remove one of them");
    }
    check_value(value, *field, key, partial);
  }

  void file(Node& value, const Field& field) {
    if (!value.is_scalar() || value.text.empty() || value.text.find('\n') != string::npos) {
      wrong_type(value, in_backticks(field.key), "expected " + expected(field));
      return;
    }
    const string why = why_no_file(beneath(folder_, value.text));
    if (why.empty()) return;
    const string other = name_in_other_case(folder_, value.text);
    refuse(value, fmt::format("{} {}", why, in_backticks(value.text)),
           other.empty() ? "paths are relative to the folder of the scene"
                         : fmt::format("did you mean {}?", in_backticks(other)));
  }

  /// Whether a value is a number, or a vector of numbers, within limits. Texts of errors take longer than this.
  static bool is_good_number(const Node& value, const Field& field) {
    if (field.type != Type::number && field.type != Type::vector) return false;
    const Range limits = limited_range(field);
    const auto is_good = [&](const Node& one) {
      const bool plain = one.is_scalar() && !one.quoted && !one.bad;
      const optional<double> number = plain ? parse_number(one.text) : nullopt;
      return number && contains(field.range, *number) && contains(limits, *number);
    };
    if (field.type == Type::number) return is_good(value);
    return value.is_sequence() && value.items.size() == 3 && all_of(value.items, is_good);
  }

  void check_value(Node& value, const Field& field, const Key& key, bool partial) {
    if (value.bad || is_good_number(value, field)) return;
    const string name = in_backticks(field.key);
    const string required = "expected " + expected(field);
    const bool is_scalar = value.is_scalar(), is_map = value.is_map();
    switch (field.type) {
      // Single values.
      case Type::number_or_none:
      case Type::number:
        return void(number(value, field, name, limited_range(field)));
      case Type::whole:
        return void(whole(value, field, name));

      case Type::flag:
        return flag(value, name, required);
      case Type::file:
        return file(value, field);
      case Type::text:
        return text(value, name, required);
      case Type::text_or_flag:
        return text(value, name, is_map ? required + "\na text that begins with a brace needs quotes" : required);
      case Type::choice:
        return choice(value, field, name);

      // Lists of numbers.
      case Type::direction:
        return direction(value, field, name, required);
      case Type::pixels:
        if (is_scalar) return choice(value, field, name);
        [[fallthrough]];
      case Type::point_or_name:
        if (is_scalar) return;
        [[fallthrough]];
      case Type::vector:
      case Type::extent:
        numbers(value, field, name);
        return;

      // Colours and names.
      case Type::color:
        return color(value, name);
      case Type::color_or_none:
        return color(value, name, ColorWords::colors_and_none);
      case Type::color_or_part:
      case Type::number_or_part:
      case Type::file_or_part:
        return is_map ? part(value, field, key, partial) : value_for_part(value, field, name);

      case Type::name:
        if (!is_scalar) wrong_type(value, name, required);
        return;
      case Type::name_or_two:
      case Type::two_names:
      case Type::names:
        return names(value, field, name, required);

      // Maps, and lists of maps.
      case Type::part_or_flag:
        if (is_flag(value)) return;
        if (!is_map) return wrong_type(value, name, required);
        [[fallthrough]];
      case Type::part:
        return part(value, field, key, partial);
      case Type::values:
        return values(value, field, name, required);
      case Type::texts:
        return texts(value, name, required);
      case Type::repeat:
        return repeated(value, partial);

      case Type::named:
        return named(value, field, name);
      case Type::list:
        return list(value, field, name, required);

      default:
        return value_of_sweep(value, field, name, required);
    }
  }

  /// Things with good counts have become their members (expand.h). Defaults are those of each member.
  void repeated(Node& value, bool partial) {
    if (partial) refuse(value, "`repeat` in `defaults`", "expected it in each thing that is repeated");
  }

  /// Checks a value that stands in place of a map.
  void value_for_part(Node& value, const Field& field, const string& name) {
    if (field.type == Type::color_or_part) color(value, name);
    if (field.type == Type::number_or_part) number(value, field, name, limited_range(field));
    if (field.type == Type::file_or_part) file(value, field);
  }

  /// Checks a value of a type that only sweep files have.
  void value_of_sweep(Node& value, const Field& field, const string& name, const string& required) {
    if (field.type == Type::settings) settings(value, name, required);
    if (field.type == Type::axes) axes(value, name, required);
    if (field.type == Type::spans) spans(value, field, name, required);
    if (field.type == Type::cases) cases(value, name, required);
  }

  static bool is_flag(const Node& value) {
    return value.is_scalar() && !value.quoted && (value.text == "true" || value.text == "false");
  }

  void flag(Node& value, const string& name, const string& required) {
    if (!is_flag(value)) wrong_type(value, name, required);
  }

  void text(Node& value, const string& name, const string& required) {
    if (!value.is_scalar()) {
      wrong_type(value, name, required);
    } else if (value.text.find('\n') != string::npos) {
      refuse(value, name + " has more than one line", "expected one line");
    }
  }

  void direction(Node& value, const Field& field, const string& name, const string& required) {
    if (!numbers(value, field, name)) return;
    bool zero = true;
    for (const Node& item : value.items) zero = zero && parse_number(item.text).value_or(1) == 0;
    if (zero) refuse(value, name + " has no length", required);
  }

  /// A remedy for an entry that stands in place of a list.
  static string list_of_one(const Node& value, const Field& field) {
    if (value.is_map()) return field.type == Type::list ? "\na list of one map is [{...}]" : "";
    const vector<string_view> words = parts_of(field.type == Type::list ? field.plain : field.of);
    const bool is_name = field.type == Type::names && words.empty();
    const bool is_entry = is_name || contains(words, value.text);
    return value.is_scalar() && is_entry ? fmt::format("\na list of one is [{}]", printable(value.text)) : "";
  }

  void names(Node& value, const Field& field, const string& name, const string& required) {
    if (field.type == Type::name_or_two && value.is_scalar()) return;
    if (!value.is_sequence()) {
      wrong_type(value, name, required + list_of_one(value, field));
    } else if (const size_t most = field.type == Type::names ? value.items.size() : 2;
               value.items.size() < (field.type == Type::two_names ? 2 : 1) || value.items.size() > most) {
      refuse(value, fmt::format("{} has {}", name, how_many(value.items.size(), "entry", "entries")), required);

    } else {
      for (Node& item : value.items) {
        if (!item.is_scalar())
          wrong_type(item, "an entry of " + name, "expected a name");
        else if (!field.of.empty())
          choice(item, field, "an entry of " + name);
      }

      if (field.type == Type::names) distinct(value, name);
    }
  }

  void distinct(const Node& names, const string& name) {
    set<string_view> found;
    for (const Node& item : names.items)
      if (!item.bad && !found.insert(item.text).second)
        diagnostics_.add(item.place, fmt::format("{} has {} twice", name, in_backticks(item.text)),
                         "remove one of them");
  }

  void list(Node& value, const Field& field, const string& name, const string& required) {
    if (!value.is_sequence()) {
      wrong_type(value, name, required + list_of_one(value, field));
      return;
    }
    if (field.held->needs_entries && value.items.empty())
      refuse(value, fmt::format("{} has no entries", name), "expected at least one");

    const vector<string_view> words = parts_of(field.plain);
    for (Node& item : value.items) {
      if (words.empty() || !item.is_scalar())
        map(item, *field.held, "this entry of " + name, item.place, false);
      else if (!contains(words, item.text))
        refuse(item, fmt::format("{} is no entry of {}", in_backticks(item.text), name),
               fmt::format("expected {}, or a map of {}", listed(words), listed(keys_of(*field.held))));
    }
  }

  void cases(Node& value, const string& name, const string& required) {
    if (!value.is_sequence()) {
      wrong_type(value, name, required);
    } else if (value.items.empty()) {
      refuse(value, name + " has no entries", required);
    }
    for (Node& item : value.items) settings(item, "this entry of " + name, required);
  }

  void part(Node& value, const Field& field, const Key& key, bool partial) {
    const Kind& kind = *field.held;
    // `defaults: {ball: ...}` is partial. So is a part inside it, if that part has defaults of its own.
    map(value, kind, in_backticks(key.text), key.place, kind.name == "defaults" || (partial && !kind.defaults.empty()));
  }

  void values(Node& value, const Field& field, const string& name, const string& required) {
    if (!value.is_map()) return wrong_type(value, name, required);
    Field each = field;
    each.type = Type::number;
    for (size_t i = 0; i < value.keys.size(); ++i) {
      const string shown = in_backticks(value.keys[i].text);
      number(value.items[i], each, shown, each.range);
    }
  }

  void texts(Node& value, const string& name, const string& required) {
    if (!value.is_map()) return wrong_type(value, name, required);
    for (size_t i = 0; i < value.keys.size(); ++i) {
      const string shown = in_backticks(value.keys[i].text);
      if (!is_name(value.keys[i].text) || value.keys[i].text.find('-') != string::npos)
        diagnostics_.add(value.keys[i].place, shown + " is no name of a measure",
                         "a name has letters, digits and _, and begins with a letter or _");
      else
        text(value.items[i], shown, required);
    }
  }

  bool has_entries(Node& value, const string& name, const string& required) {
    if (!value.is_map())
      wrong_type(value, name, required);
    else if (value.items.empty())
      refuse(value, name + " has no entries", required);
    return !value.bad;
  }

  void settings(Node& value, const string& name, const string& required) {
    if (!has_entries(value, name, required)) return;
    for (size_t i = 0; i < value.keys.size(); ++i) {
      if (value.items[i].is_null()) wrong_type(value.items[i], in_backticks(value.keys[i].text), "expected a value");
    }
  }

  void axes(Node& value, const string& name, const string& required) {
    if (!has_entries(value, name, required)) return;
    for (size_t i = 0; i < value.keys.size(); ++i) {
      const string path = in_backticks(value.keys[i].text);
      Node& values = value.items[i];

      // A range, or a list of values.
      if (values.is_map()) {
        map(values, kind_named("range"), path, value.keys[i].place, false);
      } else if (!values.is_sequence()) {
        wrong_type(values, path, "expected a list of values, or {from, to, count} or {from, to, step}");
      } else if (values.items.empty()) {
        refuse(values, path + " has no values", "expected at least one");
      } else {
        for (Node& item : values.items)
          if (item.is_null()) wrong_type(item, "an entry of " + path, "expected a value");
      }
    }
  }

  void spans(Node& value, const Field& field, const string& name, const string& required) {
    if (!has_entries(value, name, required)) return;
    for (size_t i = 0; i < value.keys.size(); ++i)
      map(value.items[i], *field.held, in_backticks(value.keys[i].text), value.keys[i].place, false);
  }

  void named(Node& value, const Field& field, const string& name) {
    if (!value.is_map()) {
      wrong_type(value, name, "expected " + expected(field));
      return;
    }

    const Kind& kind = *field.held;
    for (size_t i = 0; i < value.keys.size(); ++i) {
      const Key& key = value.keys[i];
      if (kind.also != nullptr && key.text == kind.also->key) {
        color(value.items[i], in_backticks(key.text));
        continue;
      }

      // A name, or that of a member: `row.0`.
      const string_view family = find_field(kind, "repeat") == nullptr ? "" : family_of(key.text);
      if (!is_name(family.empty() ? key.text : family)) {
        diagnostics_.add(key.place, fmt::format("{} is not a name", in_backticks(key.text)),
                         "expected letters, digits, _ and -, a letter or _ first");
      } else if (!family.empty()) {
        in_order(key, family, i == 0 ? string_view() : value.keys[i - 1].text);
      }

      map(value.items[i], kind, fmt::format("{} {}", kind.name, in_backticks(key.text)), key.place, false);
    }
  }

  /// Members follow one another: name.0, name.1, ...
  void in_order(const Key& key, string_view family, string_view before) {
    const string_view number = string_view(key.text).substr(family.size() + 1);
    const string last = number == "0" ? "" : fmt::format("{}.{}", family, *parse_index(number) - 1);
    if (number == "0" || before == last) return;
    diagnostics_.add(key.place, fmt::format("{} does not follow {}", in_backticks(key.text), in_backticks(last)),
                     fmt::format("members stand in order, {}.0 first; `repeat` makes them", family));
  }

  const Node& root_;
  const string& folder_;
};

}  // namespace

void check_scene(Node& root, const string& folder, Diagnostics& diagnostics) {
  const Place start = root.keys.empty() ? root.place : root.keys.front().place;
  Checker(root, folder, diagnostics).map(root, kind_named("scene"), "the scene", start, false);
}

void check_sweep(Node& root, Diagnostics& diagnostics) {
  const Place start = root.keys.empty() ? root.place : root.keys.front().place;
  Checker(root, "", diagnostics).map(root, kind_named("sweep"), "the sweep", start, false);
}

const Node* defaults_for(const Node& root, const Kind& kind) {
  if (kind.defaults.empty()) return nullptr;
  const Node* defaults = root.find("defaults");
  const Node* node = defaults == nullptr ? nullptr : defaults->find(kind.defaults);
  return node != nullptr && node->is_map() ? node : nullptr;
}

string beneath(const string& folder, const string& path) {
  if (path.starts_with('/') || folder.empty()) return path;
  return folder.ends_with('/') ? folder + path : folder + "/" + path;
}

string suggest_key(string_view wrong, const Kind& kind) {
  const vector<string_view> keys = keys_of(kind);
  if (const AbsentWord* word = find_absent_word(wrong))
    return fmt::format("{}\nsee {}", word->meaning, commands_of(*word));

  // Other maps that have this key.
  const string known = "expected " + listed(keys);
  vector<string_view> owners;
  vector<string> shown;
  const bool of_sweep = &kind >= sweep_kinds().data() && &kind < sweep_kinds().data() + sweep_kinds().size();
  for (const Kind& other : of_sweep ? sweep_kinds() : kinds()) {
    if (other.name == kind.name || other.name == "member" || find_field(other, wrong) == nullptr) continue;
    shown.push_back(other.name == "scene" || other.name == "sweep" ? fmt::format("the {} itself", other.name)
                                                                   : in_backticks(other.name));
  }

  for (const string& owner : shown) owners.push_back(owner);
  if (!owners.empty()) return fmt::format("{} is a key of {}\n{}", in_backticks(wrong), listed(owners), known);

  const string near = nearest(wrong, keys);
  return near.empty() ? known : fmt::format("did you mean {}?", in_backticks(near));
}

}  // namespace carom
