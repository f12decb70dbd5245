// Names that are too long for the picture are cut, because gnuplot would draw beyond its edge.
#include "export/chart.h"

#include <filesystem>

#include "files/manifest.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/letters.h"

namespace carom {

namespace {

// In letters, as far as the picture has room.
constexpr size_t longest_title = 70, longest_name = 16;
/// Lines of more instants have no marks.
constexpr uint64_t most_marks = 40;

}  // namespace

Plot chart_of(const Scene& scene, string_view subtitle) {
  Plot plot;
  const string title = scene.title.empty() ? std::filesystem::path(scene.file).stem().string() : scene.title;
  plot.title = shortened(valid_utf8(title), longest_title);
  plot.subtitle = subtitle;
  plot.scale = PlotScale::linear;
  return plot;
}

Plot chart_over_time(const Scene& scene, string_view subtitle) {
  Plot plot = chart_of(scene, subtitle);
  plot.x_label = "time";
  plot.x_unit = "s";
  plot.x_from = 0;
  plot.x_to = end_of(scene);
  return plot;
}

PlotSeries chart_line(string_view name, size_t style, const ThinnedLine& line, uint64_t instants) {
  return {shortened(name, longest_name), style, line.points(),
          instants <= most_marks ? PlotForm::marks : PlotForm::line};
}

}  // namespace carom
