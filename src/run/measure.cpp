// Units and labels are derived from the suffix of a measure's name, so that a new column needs no further text.
#include "run/measure.h"

#include <fmt/format.h>

#include "files/summary_columns.h"
#include "std.h"

namespace carom {
namespace {

struct QuantityText {
  string_view name, meaning;
};

// Indexed by Quantity.
constexpr array<QuantityText, 8> quantities = {{{"x_m", "x coordinate of the centre"},
                                                {"y_m", "y coordinate (up) of the centre"},
                                                {"z_m", "z coordinate of the centre"},
                                                {"vx_m_per_s", "velocity along x"},
                                                {"vy_m_per_s", "velocity along y (up)"},
                                                {"vz_m_per_s", "velocity along z"},
                                                {"speed_m_per_s", "speed"},
                                                {"kinetic_J", "kinetic energy"}}};

/// The name of a call, "max", and what stands in its parentheses. An empty name: it is no call.
pair<string_view, string_view> call_of(string_view text) {
  const size_t open = text.find('(');
  if (open == string_view::npos || text.back() != ')' || text.front() == '=') return {};
  return {text.substr(0, open), text.substr(open + 1, text.size() - open - 2)};
}

/// The arguments of a call without those of its window, and the window as text: " from 1 to 2 s". Both parts may be
/// empty.
pair<string_view, string> without_window(string_view inside) {
  string_view from, until;
  for (const auto& [key, end] : {pair{string_view(", until: "), &until}, pair{string_view(", from: "), &from}}) {
    const size_t at = inside.rfind(key);
    if (at == string_view::npos) continue;
    *end = inside.substr(at + key.size());
    inside = inside.substr(0, at);
  }
  string text;
  if (!from.empty()) text += fmt::format(" from {}", from);
  if (!until.empty()) text += fmt::format(" to {}", until);
  return {inside, text.empty() ? text : text + " s"};
}

}  // namespace

bool compares(double value, Relation relation, double limit) {
  switch (relation) {
    case Relation::less:
      return value < limit;
    case Relation::at_most:
      return value <= limit;
    case Relation::greater:
      return value > limit;
    case Relation::at_least:
      return value >= limit;
  }
  return false;
}

string_view name_of(Quantity quantity) {
  return quantities[size_t(quantity)].name;
}

string_view meaning_of(Quantity quantity) {
  return quantities[size_t(quantity)].meaning;
}

string_view unit_of(string_view column) {
  const auto [call, inside] = call_of(column);
  if (call == "max" || call == "min" || call == "mean") return unit_of(without_window(inside).first);
  if (call == "impulse") return "N s";
  if (call == "time_of_max" || call == "time_of_min" || call == "first") return "s";
  if (!call.empty() || column.starts_with('=')) return {};
  const UnitSuffix* text = unit_suffix(column);
  return text == nullptr ? string_view() : text->unit;
}

string label_of(string_view column) {
  const auto [call, whole] = call_of(column);
  if (column.starts_with('=')) return string(column.substr(min(column.find_first_not_of("= "), column.size())));
  if (call == "hits" || call == "count") return string(column);

  const auto [inside, window] = without_window(whole);
  if (call == "first") return fmt::format("first hit of {}{} (s)", inside, window);
  if (call == "impulse") return fmt::format("impulse of {}{} (N s)", inside, window);
  if (!call.empty()) {
    string of = label_of(inside);
    const size_t unit = min(of.size(), of.rfind(" ("));
    const bool time = call.starts_with("time_of_");
    if (time) return fmt::format("time of the {}imum {}{} (s)", call.substr(8), of.substr(0, unit), window);
    return fmt::format("{} {}{}{}", call == "mean" ? "mean" : fmt::format("{}imum", call), of.substr(0, unit), window,
                       of.substr(unit));
  }

  const UnitSuffix* text = unit_suffix(column);
  string label(column.substr(0, column.size() - (text == nullptr ? 0 : text->suffix.size())));
  // Names of bodies stay unchanged.
  const size_t dot = label.rfind('.');
  std::replace(dot == string::npos ? label.begin() : label.begin() + ptrdiff_t(dot), label.end(), '_', ' ');
  if (dot != string::npos) label[dot] = ' ';

  for (const string_view kind : {"kinetic", "potential", "total"})
    if (label.ends_with(kind)) label += " energy";
  return text == nullptr ? label : fmt::format("{} ({})", label, text->unit);
}

}  // namespace carom
