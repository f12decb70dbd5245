// Legends are words, numbers and colours. Their size and place follow from the picture (legend_block.h).
#include "overlay/legend.h"

#include <fmt/format.h>

#include "overlay/arrows.h"
#include "overlay/body_colors.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

constexpr size_t most_entries = 12;

// In the order of ColorQuantity.
constexpr const char* titles[] = {"speed (m/s)", "kinetic energy (J)", "collisions", "mass (kg)", "radius (m)", ""};

string number_text(double value) {
  return fmt::format("{:.6g}", value == 0 ? 0.0 : value);
}

Legend legend_of(const ColorRule& rule) {
  Legend legend;
  legend.map = rule.coloring.map;
  const ColorQuantity by = rule.coloring.by.value_or(ColorQuantity::group);
  legend.title = titles[size_t(by)];

  if (by != ColorQuantity::group) {
    legend.min = number_text(rule.scale.min);
    legend.max = number_text(rule.scale.max);
    return legend;
  }

  // The names of the bodies, as many as there is room for.
  const size_t count = rule.names.size(), shown = count > most_entries ? most_entries - 1 : count;
  for (size_t i = 0; i < shown; ++i) legend.entries.push_back({rule.color_of(double(i)), rule.names[i]});
  if (shown < count)
    legend.entries.push_back({rule.color_of(double(count - 1)), fmt::format("{} more", count - shown)});
  return legend;
}

Legend::Entry entry_of(const ArrowScale& scale) {
  return {scale.color(),
          fmt::format("{}: {} {} is {:.3g} m", scale.name(), number_text(scale.typical), scale.unit(), scale.length)};
}

}  // namespace

vector<Legend> legends_of(const Scene& scene) {
  vector<Legend> legends;
  for (const ColorRule& rule : color_rules(scene)) legends.push_back(legend_of(rule));
  Legend arrows;
  for (const ArrowScale& scale : arrow_scales(scene)) arrows.entries.push_back(entry_of(scale));
  if (!arrows.entries.empty()) legends.push_back(std::move(arrows));
  return legends;
}

}  // namespace carom
