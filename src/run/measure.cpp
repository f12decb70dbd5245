// Units and labels are derived from the suffix of a measure's name, so that a new column needs no further text.
#include "run/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace carom {
namespace {

struct QuantityText {
  std::string_view name, meaning;
};

// Indexed by Quantity.
constexpr std::array<QuantityText, 8> quantities = {{{"x_m", "x coordinate of the centre"},
                                                     {"y_m", "y coordinate (up) of the centre"},
                                                     {"z_m", "z coordinate of the centre"},
                                                     {"vx_m_per_s", "velocity along x"},
                                                     {"vy_m_per_s", "velocity along y (up)"},
                                                     {"vz_m_per_s", "velocity along z"},
                                                     {"speed_m_per_s", "speed"},
                                                     {"kinetic_J", "kinetic energy"}}};

struct UnitText {
  std::string_view suffix, unit;
};

// A longer suffix comes before a shorter one that it ends in.
constexpr std::array<UnitText, 7> units = {{{"_kg_m_per_s", "kg m/s"},
                                            {"_m_per_s", "m/s"},
                                            {"_N_s", "N s"},
                                            {"_J", "J"},
                                            {"_N", "N"},
                                            {"_m", "m"},
                                            {"_s", "s"}}};

const UnitText* unit_text(std::string_view column) {
  const auto found =
      std::find_if(units.begin(), units.end(), [&](const UnitText& u) { return column.ends_with(u.suffix); });
  return found == units.end() ? nullptr : &*found;
}

/// The name of a call, "max", and what stands in its parentheses. An empty name: it is no call.
std::pair<std::string_view, std::string_view> call_of(std::string_view text) {
  const std::size_t open = text.find('(');
  if (open == std::string_view::npos || text.back() != ')' || text.front() == '=') return {};
  return {text.substr(0, open), text.substr(open + 1, text.size() - open - 2)};
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

std::string_view name_of(Quantity quantity) {
  return quantities[static_cast<std::size_t>(quantity)].name;
}

std::string_view meaning_of(Quantity quantity) {
  return quantities[static_cast<std::size_t>(quantity)].meaning;
}

std::string_view unit_of(std::string_view column) {
  const auto [call, inside] = call_of(column);
  if (call == "max" || call == "min") return unit_of(inside);
  if (call == "time_of_max" || call == "time_of_min" || call == "first") return "s";
  if (!call.empty() || column.starts_with('=')) return {};
  const UnitText* text = unit_text(column);
  return text == nullptr ? std::string_view() : text->unit;
}

std::string label_of(std::string_view column) {
  const auto [call, inside] = call_of(column);
  if (column.starts_with('=') || call == "hits" || call == "count") return std::string(column);
  if (call == "first") return fmt::format("first hit of {} (s)", inside);
  if (!call.empty()) {
    std::string of = label_of(inside);
    const bool time = call.starts_with("time_of_");
    if (time) of.resize(std::min(of.size(), of.rfind(" (")));
    return time ? fmt::format("time of the {}imum {} (s)", call.substr(8), of) : fmt::format("{}imum {}", call, of);
  }
  const UnitText* text = unit_text(column);
  std::string label(column.substr(0, column.size() - (text == nullptr ? 0 : text->suffix.size())));
  // Names of bodies stay unchanged.
  const std::size_t dot = label.rfind('.');
  std::replace(dot == std::string::npos ? label.begin() : label.begin() + static_cast<std::ptrdiff_t>(dot), label.end(),
               '_', ' ');
  if (dot != std::string::npos) label[dot] = ' ';
  for (const std::string_view kind : {"kinetic", "potential", "total"})
    if (label.ends_with(kind)) label += " energy";
  return text == nullptr ? label : fmt::format("{} ({})", label, text->unit);
}

}  // namespace carom
