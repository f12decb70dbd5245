// Numbers of a scene file, parsed with std::from_chars after a check of the form, so that no locale matters.
// The form is stricter than YAML's: no leading zeros, no hexadecimal, no infinity, no NaN.
// Whole numbers may be written as 1e6. A scalar that fails gets a message about its likely cause.
#include "yaml/values.h"

#include <fmt/format.h>

#include <charconv>

#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/letters.h"
#include "yaml/lookalikes.h"

namespace carom {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// The longest start of `text` that has the form of a number. Empty: none.
string_view number_prefix(string_view text) {
  size_t i = 0;
  if (i < text.size() && (text[i] == '-' || text[i] == '+')) ++i;

  const size_t first = i;
  while (i < text.size() && is_digit(text[i])) ++i;
  size_t digits = i - first;

  if (i < text.size() && text[i] == '.') {
    size_t j = i + 1;
    while (j < text.size() && is_digit(text[j])) ++j;
    digits += j - i - 1;
    if (digits > 0) i = j;
  }
  if (digits == 0) return {};

  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    size_t j = i + 1;
    if (j < text.size() && (text[j] == '-' || text[j] == '+')) ++j;
    const size_t exponent = j;
    while (j < text.size() && is_digit(text[j])) ++j;
    if (j > exponent) i = j;
  }
  return text.substr(0, i);
}

bool has_leading_zero(string_view number) {
  if (number.starts_with('-') || number.starts_with('+')) number.remove_prefix(1);
  return number.size() > 1 && number[0] == '0' && is_digit(number[1]);
}

bool is_zero(string_view number) {
  for (const char c : number) {
    if (c == 'e' || c == 'E') break;
    if (c >= '1' && c <= '9') return false;
  }
  return true;
}

string without(string_view text, char unwanted) {
  string out;
  for (const char c : text) {
    if (c != unwanted) out += c;
  }
  return out;
}

}  // namespace

bool is_infinite(string_view text) {
  const string lower = in_lower_case(text);
  return lower == ".inf" || lower == "inf" || lower == "infinity";
}

optional<double> parse_number(string_view text) {
  if (number_prefix(text).size() != text.size() || text.empty() || has_leading_zero(text)) return nullopt;
  const string_view digits = text.starts_with('+') ? text.substr(1) : text;
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || !isfinite(value)) return nullopt;
  if (value == 0 && !is_zero(digits)) return nullopt;
  return value;
}

optional<uint64_t> parse_index(string_view text) {
  uint64_t whole = 0;
  if (has_leading_zero(text)) return nullopt;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), whole);
  return error == std::errc() && end == text.data() + text.size() ? optional(whole) : nullopt;
}

optional<uint64_t> parse_whole(string_view text) {
  if (const optional<uint64_t> digits = parse_index(text)) return digits;
  if (has_leading_zero(text)) return nullopt;
  const optional<double> value = parse_number(text);
  if (!value || *value < 0 || *value > 9007199254740992.0 || floor(*value) != *value) return nullopt;
  return uint64_t(*value);
}

Complaint explain_number(const Node& node, const ExpectedNumber& number) {
  const string& text = node.text;
  const string& wanted = number.expected;
  const string shown = in_backticks(text);
  const Complaint none{fmt::format("{} is not a number", shown), wanted};

  if (node.quoted) {
    if (parse_number(text))
      return {fmt::format("{} in quotes is text, not a number", shown), fmt::format("without quotes: {}", text)};
    return none;
  }

  // Spellings of other languages.
  string_view bare = text;
  if (bare.starts_with('-') || bare.starts_with('+')) bare.remove_prefix(1);
  const string lower = in_lower_case(bare);
  if (lower == ".nan" || lower == "nan" || is_infinite(bare)) {
    return {fmt::format("{} is not a finite number", shown), wanted};
  }
  if (lower.starts_with("0x") || lower.starts_with("0o") || lower.starts_with("0b")) {
    return {fmt::format("{} is not a decimal number", shown), wanted};
  }

  const string_view prefix = number_prefix(text);
  if (prefix.empty()) return none;
  if (prefix.size() == text.size()) {
    if (has_leading_zero(text)) {
      string better(bare.substr(min(bare.find_first_not_of('0'), bare.size() - 1)));
      if (!is_digit(better[0])) better.insert(0, "0");
      return {fmt::format("{} has a leading zero", shown),
              fmt::format("write {}{}", text[0] == '-' ? "-" : "", better)};
    }

    // What remains is a number beyond the range of a double.
    if (is_zero(prefix)) return none;
    const size_t e = lower.find('e');
    const bool tiny = e != string::npos ? lower[e + 1] == '-' : bare.starts_with('0') || bare.starts_with('.');
    return {fmt::format("{} is too {} for a double", shown, tiny ? "small" : "large"),
            tiny ? wanted + "; the smallest is about 5e-324" : wanted + "; the largest is about 1.8e308"};
  }

  // A number, and what follows it.
  const string_view rest = string_view(text).substr(prefix.size());
  if (rest[0] == '_' && parse_number(without(text, '_')))
    return {none.message, fmt::format("write {}", without(text, '_'))};
  if (rest[0] == ',') {
    string point = text;
    point[prefix.size()] = '.';
    if (parse_number(point))
      return {fmt::format("{} has a comma", shown), fmt::format("the decimal point is a point: {}", point)};
  }

  const size_t unit = rest.find_first_not_of(' ');
  const bool letters =
      unit != string_view::npos && !lookalike_at(rest, unit) &&
      (((rest[unit] | 32) >= 'a' && (rest[unit] | 32) <= 'z') || rest[unit] == '%' || (rest[unit] & 0x80));

  if (letters) {
    if (number.unit.empty()) return {fmt::format("{} carries a unit", shown), wanted + ", the number alone"};
    if (rest.substr(unit) == number.unit)
      return {fmt::format("{} carries a unit", shown),
              fmt::format("{} is always in {}: write {}", in_backticks(number.key), number.unit, prefix)};
    return {fmt::format("{} carries a unit", shown),
            fmt::format("{} is always in {}: write the number alone", in_backticks(number.key), number.unit)};
  }
  return none;
}

string shortest(double value) {
  char buffer[40];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, value == 0 ? 0.0 : value);
  return string(buffer, result.ptr);
}

bool is_name(string_view text) {
  if (text.empty() || text.size() > 200) return false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    if (!letter && (i == 0 || !(is_digit(c) || c == '-'))) return false;
  }
  return true;
}

}  // namespace carom
