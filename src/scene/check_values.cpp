// A bad value gets one error, at its own place, and the checks go on. Exceptions would end at the first error.
#include "scene/check_values.h"

#include <fmt/format.h>

#include "scene/absent_words.h"
#include "scene/colors.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

ExpectedNumber expected_number(const Field& field) {
  return {field.key, field.unit, "expected " + expected(field)};
}

string wrong_count(const string& name, size_t count) {
  return fmt::format("{} has {} number{}", name, count, count == 1 ? "" : "s");
}

/// Adds what stands for a mass of 0 or infinity in other programs.
string with_fixed_things(const Field& field, string remedy) {
  if (field.key != "mass" && field.key != "density") return remedy;
  return remedy + "\nwhat no impact moves has no mass: it stands in `obstacles`, `planes` or `walls`";
}

bool means_none(string_view text) {
  for (const char* word : {"None", "NONE", "transparent", "Transparent", "clear", "no"})
    if (text == word) return true;
  return false;
}

/// Whether a path such as tables.format ends in this key.
bool is_end_of(string_view path, string_view key) {
  return path.size() > key.size() && path.ends_with(key) && path[path.size() - key.size() - 1] == '.';
}

}  // namespace

void ValueChecker::refuse(Node& node, string message, string remedy) {
  node.bad = true;
  diagnostics_.add(node.place, std::move(message), std::move(remedy));
}

void ValueChecker::wrong_type(Node& node, const string& name, const string& required) {
  if (node.bad) return;
  switch (node.kind) {
    case Node::Kind::null:
      refuse(node, name + " has no value", required);
      break;

    case Node::Kind::scalar:
      refuse(node, fmt::format("{} is {}", name, in_backticks(node.text)), required);
      break;

    case Node::Kind::sequence:
      refuse(node, name + " is a list", required);
      break;
    case Node::Kind::map:
      refuse(node, name + " is a map of keys", required);
      break;
  }
}

bool ValueChecker::number(Node& value, const Field& field, const string& name, const Range& limits) {
  if (value.bad) return false;
  if (!value.is_scalar()) {
    wrong_type(value, name, "expected " + expected(field));
    return false;
  }
  if (field.type == Type::number_or_none && value.text == "none") return true;

  const optional<double> parsed = value.quoted ? nullopt : parse_number(value.text);
  if (!parsed) {
    Complaint complaint = explain_number(value, expected_number(field));
    if (is_infinite(value.text)) complaint.remedy = with_fixed_things(field, std::move(complaint.remedy));
    refuse(value, std::move(complaint.message), std::move(complaint.remedy));
    return false;
  }

  // The range of the field, then the limits of a run.
  if (!contains(field.range, *parsed)) {
    refuse(value, fmt::format("{} is {}", name, value.text),
           *parsed == 0 ? with_fixed_things(field, "expected " + expected(field)) : "expected " + expected(field));
    return false;
  }
  if (!contains(limits, *parsed)) {
    refuse(value, fmt::format("{} is {}", name, value.text), limit_text(limits, field.unit));
    return false;
  }

  return true;
}

bool ValueChecker::whole(Node& value, const Field& field, const string& name) {
  if (value.is_scalar() && !value.quoted && !value.bad) {
    const optional<uint64_t> parsed = parse_whole(value.text);
    if (parsed && contains(field.range, double(*parsed))) return true;
    if (parse_number(value.text)) {
      refuse(value, fmt::format("{} is {}", name, value.text), "expected " + expected(field));
      return false;
    }
  }
  return number(value, field, name, field.range);
}

bool ValueChecker::numbers(Node& value, const Field& field, const string& name) {
  const size_t count = parts_of(facts_of(field.type).components).size();
  if (!value.is_sequence()) {
    wrong_type(value, name, "expected " + expected(field));
    return false;
  }

  if (value.items.size() != count) {
    refuse(value, wrong_count(name, value.items.size()),
           "expected " + expected(field) +
               (value.items.size() > count ? "\nthe decimal point is a point: 1.5, not 1,5" : ""));
    return false;
  }

  bool good = true;
  Field each = field;
  const Range limits = limited_range(field);
  const bool are_whole = holds_whole_numbers(field);
  each.type = are_whole ? Type::whole : Type::number;

  for (Node& item : value.items) {
    const string part = "a number of " + name;
    good = (are_whole ? whole(item, each, part) : number(item, each, part, limits)) && good;
  }

  if (!good) value.bad = true;
  return good;
}

void ValueChecker::choice(Node& value, const Field& field, const string& name) {
  const string required = "expected " + expected(field);
  if (!value.is_scalar()) {
    wrong_type(value, name, required);
    return;
  }

  // A quoted number is no choice.
  const vector<string_view> all = choices(field);
  for (const string_view one : all) {
    if (value.text != one) continue;
    if (!value.quoted || !parse_number(value.text)) return;
    Complaint complaint = explain_number(value, expected_number(field));
    refuse(value, std::move(complaint.message), std::move(complaint.remedy));
    return;
  }

  // A word that other programs have, and that leads to this key.
  const AbsentWord* const known = find_absent_word(value.text);
  if (known != nullptr && any_of(parts_of(known->see), [&](string_view key) { return is_end_of(key, field.key); }))
    return refuse(value, fmt::format("{} is {}", name, in_backticks(value.text)),
                  fmt::format("{}\n{}", required, known->meaning));

  const string near = nearest(value.text, all);
  refuse(value, fmt::format("{} is {}", name, in_backticks(value.text)),
         near.empty() ? required : fmt::format("did you mean {}?\n{}", in_backticks(near), required));
}

void ValueChecker::color(Node& value, const string& name, ColorWords words) {
  static constexpr Field component{.key = "color", .type = Type::vector, .range = {0, 1}};
  static constexpr Field plain{.key = "color", .type = Type::color},
      or_none{.key = "color", .type = Type::color_or_none};
  const bool may_be_none = words == ColorWords::colors_and_none;
  const string required = "expected " + expected(may_be_none ? or_none : plain);
  if (value.is_sequence() && value.items.size() == 3) {
    numbers(value, component, name);
  } else if (value.is_sequence()) {
    refuse(value, wrong_count(name, value.items.size()), required);
  } else if (!value.is_scalar()) {
    // An unquoted # begins a comment, so the value is lost.
    wrong_type(value, name, value.is_null() ? required + "\na colour that begins with # needs quotes" : required);
  } else if (!parse_color(value.text) && !(may_be_none && value.text == "none")) {
    vector<string_view> all = color_names();
    if (may_be_none) all.insert(all.begin(), "none");
    const string near = may_be_none && means_none(value.text) ? "none" : nearest(value.text, all);
    const bool is_flag = value.text == "true" || value.text == "false";
    refuse(value, fmt::format("{} is not a colour", in_backticks(value.text)),
           near.empty() || is_flag ? required : fmt::format("did you mean {}?", in_backticks(near)));
  }
}

}  // namespace carom
