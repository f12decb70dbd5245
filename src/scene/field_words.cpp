// Describes the rows of the table in words.
// The same words serve messages, the schema, the page of the format and `carom explain`.
#include <fmt/format.h>

#include <charconv>
#include <iterator>

#include "scene/field.h"
#include "std.h"

namespace carom {
namespace {

string capital(string text) {
  if (text[0] >= 'a' && text[0] <= 'z') text[0] = char(text[0] - 32);
  return text;
}

/// Without an exponent: 0.000001.
string plain(double value) {
  char buffer[400];
  return {buffer, std::to_chars(buffer, std::end(buffer), value, std::chars_format::fixed).ptr};
}

}  // namespace

const Field* find_field(const Kind& kind, string_view key) {
  const auto found = ranges::find(kind.fields, key, &Field::key);
  return found == kind.fields.end() ? nullptr : &*found;
}

bool contains(const Range& range, double value) {
  return (range.above_min ? value > range.min : value >= range.min) &&
         (range.below_max ? value < range.max : value <= range.max) && (!range.even || std::fmod(value, 2) == 0);
}

bool holds_whole_numbers(const Field& field) {
  return field.type == Type::whole || field.type == Type::repeat || field.type == Type::pixels;
}

span<const UnitLimit> unit_limits() {
  static constexpr UnitLimit limits[] = {
      {"", 1e-90, 1e90},         {"m", 1e-30, 1e30},    {"s", 1e-30, 1e30},
      {"1/s", 1e-30, 1e30},      {"m/s", 1e-30, 1e30},  {"m/s^2", 1e-30, 1e30},
      {"m^3/s^2", 1e-90, 1e90},  {"kg", 1e-60, 1e60},   {"m^3/(kg s^2)", 1e-120, 1e30},
      {"kg/m^3", 1e-150, 1e150}, {"N", 1e-60, 1e60},    {"N s", 1e-60, 1e60},
      {"N/m", 1e-60, 1e60},      {"kg/s", 1e-60, 1e60}, {"kg/m", 1e-60, 1e60},
  };
  return limits;
}

Range limited_range(const Field& field) {
  Range range = field.range;
  if (holds_whole_numbers(field) || field.type == Type::direction) return range;
  for (const UnitLimit& limit : unit_limits()) {
    if (limit.unit != field.unit) continue;
    range.max = min(range.max, limit.largest);
    range.min = max(range.min, -limit.largest);
    if (range.min != 0 || !range.above_min) continue;
    range.min = limit.smallest;
    range.above_min = false;
  }
  return range;
}

string limit_text(const Range& limits, string_view unit) {
  return fmt::format("a run takes numbers from {} to {}{}", limits.min, limits.max,
                     unit.empty() ? "" : fmt::format(" {}", unit));
}

string describe(const Range& range) {
  if (range.min == range.max) return plain(range.min);
  const bool low = range.min > Range{}.min, high = range.max < Range{}.max;
  if (low && high) {
    return range.above_min || range.below_max ? fmt::format("between {} and {}", plain(range.min), plain(range.max))
                                              : fmt::format("from {} to {}", plain(range.min), plain(range.max));
  }
  if (low)
    return range.above_min ? fmt::format("above {}", plain(range.min))
                           : fmt::format("of at least {}", plain(range.min));
  if (high) return fmt::format("of at most {}", plain(range.max));
  return {};
}

vector<string_view> parts_of(string_view text) {
  vector<string_view> out;
  for (size_t i = 0; i < text.size();) {
    const size_t end = min(text.find('|', i), text.size());
    out.push_back(text.substr(i, end - i));
    i = end + 1;
  }
  return out;
}

bool has_part(string_view text, string_view part) {
  const vector<string_view> parts = parts_of(text);
  return contains(parts, part);
}

vector<string_view> rivals(const Field& field) {
  vector<string_view> out = parts_of(field.one_of);
  std::erase(out, field.key);
  return out;
}

vector<string_view> substitutes(const Field& field) {
  vector<string_view> out = rivals(field);
  for (const string_view key : parts_of(field.spared_by)) out.push_back(key);
  return out;
}

vector<vector<string_view>> needs_of(const Kind& kind) {
  vector<vector<string_view>> needs;
  for (const Field& field : kind.fields) {
    if (!field.needed) continue;
    vector<string_view>& keys = needs.emplace_back(parts_of(field.one_of));
    if (keys.empty()) keys.push_back(field.key);
    for (const string_view key : parts_of(field.spared_by)) keys.push_back(key);
  }
  return needs;
}

vector<string_view> need_with(const Kind& kind, const Field& field) {
  for (const vector<string_view>& keys : needs_of(kind))
    if (contains(keys, field.key)) return keys;
  return {};
}

vector<string_view> choices(const Field& field) {
  return parts_of(field.of);
}

string word_in_yaml(string_view word) {
  const char first = word.empty() ? ' ' : word.front();
  const bool plain = (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z') || (first >= '0' && first <= '9');
  return plain ? string(word) : fmt::format("\"{}\"", word);
}

string title_of(const Field& field) {
  string title(field.title.empty() ? field.key : field.title);
  for (char& c : title) c = c == '_' ? ' ' : c;
  return capital(std::move(title));
}

string condition_text(const Field& field) {
  if (field.with.empty()) return {};
  if (field.spared_by.empty()) return fmt::format("Only with `{}`.", field.with);
  vector<string> sparing;
  for (const string_view key : parts_of(field.spared_by)) sparing.push_back(fmt::format("`{}`", key));
  return fmt::format("Only with `{}` or {}.", field.with, listed({sparing.begin(), sparing.end()}));
}

string described(const Field& field) {
  string text(field.doc);

  if (field.type == Type::choice) {
    text += fmt::format(" One of {}.", expected(field));
  } else if (field.range.min == field.range.max) {
    text += fmt::format(" Always {}.", field.range.min);
  } else if (field.held == nullptr) {
    text += fmt::format(" {}.", capital(expected(field)));
  }

  if (!field.initial.empty()) text += fmt::format(" Default: {}.", field.initial);
  vector<string> others;
  for (const string_view rival : rivals(field)) others.push_back(fmt::format("`{}`", rival));
  if (!others.empty()) text += fmt::format(" Not with {}.", listed({others.begin(), others.end()}));

  if (!field.with.empty()) text += " " + condition_text(field);
  if (!field.engines.empty()) text += fmt::format(" Only with engine {}.", listed(parts_of(field.engines)));
  return text;
}

bool holds_entries(const Field& field) {
  const Inside inside = facts_of(field.type).inside;
  return inside == Inside::named || inside == Inside::list;
}

bool holds_map(const Field& field) {
  return facts_of(field.type).inside == Inside::map;
}

string listed(const vector<string_view>& words) {
  string out;
  for (size_t i = 0; i < words.size(); ++i) {
    if (i > 0) out += i + 1 == words.size() ? " or " : ", ";
    out += words[i];
  }
  return out;
}

string expected(const Field& field) {
  const TypeFacts& facts = facts_of(field.type);
  const string range = describe(field.range);
  if (field.range.min == field.range.max) return range;
  vector<string> words;
  for (const string_view choice : choices(field)) words.push_back(word_in_yaml(choice));
  const bool is_other = field.type == Type::names ? !field.of.empty() : !field.plain.empty();
  return fmt::format(
      fmt::runtime(is_other ? facts.other_form : facts.form), fmt::arg("limits", range.empty() ? "" : " " + range),
      fmt::arg("unit", field.unit.empty() ? "" : fmt::format(" in {}", field.unit)),
      fmt::arg("an", field.range.even ? "an even" : "a"), fmt::arg("even", field.range.even ? "even " : ""),
      fmt::arg("choices", listed({words.begin(), words.end()})), fmt::arg("plain", listed(parts_of(field.plain))),
      fmt::arg("example", field.example));
}

}  // namespace carom
