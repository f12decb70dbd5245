// Parses names of measures: a column of summary.csv, or KIND.NAME.QUANTITY of a body.
// Units and labels are derived from the suffix of the name, so that a new column needs no further text.
#include "run/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <vector>

#include "physics/body_now.h"
#include "scene/scene.h"
#include "yaml/diagnostics.h"
#include "yaml/joined.h"

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

bool is_kind(std::string_view word) {
  return word == "balls" || word == "bodies" || word == "groups";
}

std::vector<std::string_view> known_names() {
  std::vector<std::string_view> names;
  for (const SummaryColumn& column : summary_columns())
    if (column.number != nullptr) names.push_back(column.name);
  return names;
}

std::string meant(std::string_view word, const std::vector<std::string_view>& names) {
  const std::string near = nearest(word, names);
  return near.empty() ? "" : fmt::format("; did you mean {}?", in_backticks(near));
}

[[noreturn]] void refuse_name(std::string_view name) {
  const std::string near = meant(name, known_names());
  throw MeasureError(fmt::format(
      "no measure {}{}", in_backticks(name),
      near.empty() ? "; a measure is a numeric column of summary.csv, or a quantity such as balls.NAME.speed_m_per_s"
                   : near));
}

const BodyRange* find_range(const Scene& scene, std::string_view name) {
  for (const BodyRange& range : scene.roster.bodies)
    if (range.name == name) return &range;
  return nullptr;
}

/// The number of a measure's body. Throws MeasureError if the scene does not have it.
Entity entity_of(const Measure& measure, const Scene& scene) {
  // A member of a repeated thing is a body of its own, with a dot in its name. A repeated group has one, too.
  const bool of_group = measure.kind == "groups";
  const std::size_t dot = of_group ? measure.body.rfind('.') : std::string::npos;
  const std::string name = measure.body.substr(0, dot);
  const BodyRange* range = find_range(scene, name);
  if (range == nullptr || range->group != (measure.kind == "groups")) {
    std::vector<std::string_view> names;
    for (const BodyRange& other : scene.roster.bodies)
      if (other.group == (measure.kind == "groups")) names.push_back(other.name);
    throw MeasureError(fmt::format("{}: {} has no {}{}", in_backticks(measure.name), measure.kind, in_backticks(name),
                                   meant(name, names)));
  }
  if (!range->group) return range->first;
  Entity member = 0;
  const char* end = measure.body.data() + measure.body.size();
  const auto [stop, error] = std::from_chars(measure.body.data() + dot + 1, end, member);
  if (error != std::errc() || stop != end || member >= range->count)
    throw MeasureError(fmt::format("{}: the members of {} are 0 to {}", in_backticks(measure.name), in_backticks(name),
                                   range->count == 0 ? "none" : std::to_string(range->count - 1)));
  return range->first + member;
}

}  // namespace

std::string_view name_of(Quantity quantity) {
  return quantities[static_cast<std::size_t>(quantity)].name;
}

std::string_view meaning_of(Quantity quantity) {
  return quantities[static_cast<std::size_t>(quantity)].meaning;
}

Measure parse_measure(std::string_view name) {
  Measure measure;
  measure.name = name;
  measure.column = find_summary_column(name);
  if (measure.column != nullptr) {
    if (measure.column->number == nullptr)
      throw MeasureError(fmt::format("{} of summary.csv is text, not a measure", in_backticks(name)));
    return measure;
  }
  const std::size_t first = name.find('.'), last = name.rfind('.');
  measure.kind = name.substr(0, first);
  if (first == std::string_view::npos || !is_kind(measure.kind)) refuse_name(name);
  if (first == last)
    throw MeasureError(fmt::format("{} has no quantity: expected one such as {}.NAME.speed_m_per_s", in_backticks(name),
                                   measure.kind));
  measure.body = name.substr(first + 1, last - first - 1);
  const std::string_view quantity = name.substr(last + 1);
  const auto found = std::find_if(quantities.begin(), quantities.end(),
                                  [&](const QuantityText& text) { return text.name == quantity; });
  if (found == quantities.end()) {
    std::vector<std::string_view> names;
    for (const QuantityText& text : quantities) names.push_back(text.name);
    throw MeasureError(fmt::format("{}: no quantity {}{}", in_backticks(name), in_backticks(quantity),
                                   meant(quantity, names).empty()
                                       ? fmt::format("; the quantities are {}", joined(names, ", "))
                                       : meant(quantity, names)));
  }
  measure.quantity = static_cast<Quantity>(found - quantities.begin());
  const bool has_member = measure.body.find('.') != std::string::npos;
  if (measure.kind == "groups" && !has_member)
    throw MeasureError(fmt::format("{} has no member: expected one such as groups.{}.0.{}", in_backticks(name),
                                   measure.body, quantity));
  return measure;
}

Measure parse_measure(std::string_view name, const Scene& scene) {
  Measure measure = parse_measure(name);
  if (measure.column == nullptr) entity_of(measure, scene);
  return measure;
}

double quantity_of(Quantity quantity, const Vec3& position, const Vec3& velocity, double mass) {
  switch (quantity) {
    case Quantity::x:
    case Quantity::y:
    case Quantity::z:
      return position[static_cast<int>(quantity)];
    case Quantity::vx:
    case Quantity::vy:
    case Quantity::vz:
      return velocity[static_cast<int>(quantity) - static_cast<int>(Quantity::vx)];
    case Quantity::speed:
      return velocity.norm();
    case Quantity::kinetic:
      return 0.5 * mass * velocity.squaredNorm();
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double value_of(const Measure& measure, const Scene& scene, const State& state, const Summary& summary) {
  if (measure.column != nullptr) return measure.column->number(summary);
  Entity body = 0;
  try {
    body = entity_of(measure, scene);
  } catch (const MeasureError&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (is_part_of_another(state, body)) return std::numeric_limits<double>::quiet_NaN();
  const double mass = mass_now(scene.world, state, body);
  return quantity_of(measure.quantity, state.position[body], state.velocity[body], mass);
}

std::string_view unit_of(std::string_view column) {
  const UnitText* text = unit_text(column);
  return text == nullptr ? std::string_view() : text->unit;
}

std::string label_of(std::string_view column) {
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
