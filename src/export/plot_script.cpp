// Fixes colours, fonts and ranges, and places the labels. No default of gnuplot or of its user then changes the
// picture.
#include "export/plot_script.h"

#include <fmt/format.h>

#include "export/plot_axis.h"
#include "std.h"
#include "yaml/joined.h"
#include "yaml/letters.h"

namespace carom {

namespace {

/// The ratio of its upper to its lower end on a logarithmic axis, and its part of a linear one.
constexpr double shortest_bar = 1.2, shortest_part = 0.02;
/// Marks of more points than these are smaller.
constexpr size_t few_points = 60, few_on_line = 20;

/// Colours that are distinct for every kind of colour vision (Okabe & Ito 2008), and gnuplot's numbers of marks.
struct PlotStyle {
  array<int, 3> color;  // red, green, blue
  int mark;
};
constexpr array<PlotStyle, plot_styles> styles = {{{{0xD5, 0x5E, 0x00}, 13},
                                                   {{0xE6, 0x9F, 0x00}, 7},
                                                   {{0x00, 0x9E, 0x73}, 5},
                                                   {{0x00, 0x72, 0xB2}, 9},
                                                   {{0xCC, 0x79, 0xA7}, 11},
                                                   {{0x56, 0xB4, 0xE9}, 15},
                                                   {{0x00, 0x00, 0x00}, 6},
                                                   {{0x8C, 0x8C, 0x00}, 4}}};

/// "'#D55E00'"
string color_of(const PlotSeries& series) {
  return "'" + plot_color(series) + "'";
}

/// Text in single quotes, which gnuplot takes literally.
string quoted_text(const string& text) {
  string quoted = "'";
  for (const char c : text) {
    if (c == '\'') quoted += '\'';
    quoted += static_cast<unsigned char>(c) < ' ' || c == 127 ? ' ' : c;
  }
  return quoted + "'";
}

string title_of(const PlotSeries& series) {
  return series.name.empty() ? "notitle" : "title " + quoted_text(series.name);
}

/// Where the parts of the picture are, in shares of its width and height.
struct PlotFrame {
  double left, right, legend, y_label;
  double bottom, top;
};

/// Leaves room for the ticks of the y axis, and at the right for the names of the legend.
PlotFrame frame_of(const Plot& plot, const PlotAxes& axes) {
  // In pixels of the SVG, here and below. A letter of 13 points is 8 wide on average.
  constexpr double letter = 8, label = 20, gap = 26, sample = 62;
  size_t names = 0;
  for (const PlotSeries& series : plot.series) names = max(names, letters_of(series.name));
  for (const PlotLevel& level : plot.levels) names = max(names, letters_of(level.name));
  const bool has_title = !plot.title.empty() || !plot.subtitle.empty();
  const double width = plot.svg_width, height = plot.svg_height, end = letter * double(axes.x.tick_letters()) / 2;
  const double right = 1 - (names > 0 ? sample + letter * double(names) : 4 + end) / width;
  return {(label + gap + letter * double(axes.y.tick_letters())) / width,
          right,
          right + 12 / width,
          label / width,
          55 / height,
          1 - (has_title ? 70 : 12) / height};
}

/// Leaves out a label that would cover another one. Distances are in shares of the picture's width and height.
class PlotLabels {
 public:
  explicit PlotLabels(const PlotAxes& axes) : axes_(axes) {}
  bool fits(double x, double y) {
    const double across = axes_.x.part(x), up = axes_.y.part(y);
    const auto covers = [&](const auto& p) {
      return std::abs(p.first - across) < 0.1 && std::abs(p.second - up) < 0.03;
    };
    if (any_of(taken_, covers)) return false;
    taken_.emplace_back(across, up);
    return true;
  }

 private:
  const PlotAxes& axes_;
  vector<pair<double, double>> taken_;
};

/// Appends blocks of data, and the layers that draw them.
class PlotLayers {
 public:
  PlotLayers(const Plot& plot, const PlotAxes& axes) : plot_(plot), axes_(axes), labels_(axes) {
    for (const PlotLevel& level : plot.levels)
      layers_.push_back(
          fmt::format("{:.17g} with lines linetype 1 linecolor '#808080' linewidth 1.5 dashtype 2 title {}",
                      plot.height(level.y), quoted_text(level.name)));
    for (size_t s = 0; s < plot.series.size(); ++s)
      if (!plot.series[s].points.empty()) add(s, plot.series[s]);
    if (layers_.empty()) layers_.push_back("NaN notitle");
  }

  string text() const { return data_ + fmt::format("plot {}\n", joined(layers_, ", \\\n  ")); }

 private:
  void add(size_t s, const PlotSeries& series) {
    if (series.form == PlotForm::band) return add_band(s, series);

    string points;
    for (const PlotPoint& point : series.points)
      points += fmt::format("{:.17g} {:.17g}\n", point.x, plot_.height(point.y));
    put("series", s, points);

    const bool is_marked = series.form == PlotForm::marks || series.form == PlotForm::points;
    if (is_marked) add_bars(s, series);
    layers_.push_back(fmt::format("$series{} using 1:2 with {} {}", s, style_of(series), title_of(series)));
    if (is_marked) add_labels(s, series);
  }

  static string style_of(const PlotSeries& series) {
    const string color = color_of(series);
    const int mark = styles.at(series.style).mark;
    if (series.form == PlotForm::points)
      return fmt::format("points linetype 1 linecolor {} pointtype {} pointsize {}", color, mark,
                         series.points.size() > few_points ? 0.6 : 0.9);
    if (series.form == PlotForm::marks)
      return fmt::format("linespoints linetype 1 linecolor {} linewidth 2 pointtype {} pointsize {}", color, mark,
                         series.points.size() > few_on_line ? 0.8 : 1.3);
    return fmt::format("lines linetype 1 linecolor {} linewidth 2 dashtype {}", color,
                       series.form == PlotForm::dashes ? "(8,8)" : "solid");
  }

  void add_band(size_t s, const PlotSeries& series) {
    string points;
    for (const PlotPoint& point : series.points)
      points += fmt::format("{:.17g} {:.17g} {:.17g}\n", point.x, plot_.height(point.low), plot_.height(point.high));
    put("series", s, points);
    layers_.push_back(
        fmt::format("$series{} using 1:2:3 with filledcurves linetype 1 linecolor {} fillstyle solid 1 noborder {}", s,
                    color_of(series), title_of(series)));
  }

  void add_bars(size_t s, const PlotSeries& series) {
    string bars;
    for (const PlotPoint& point : series.points)
      if (!is_covered(point))
        bars += fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}\n", point.x, plot_.height(point.y),
                            max(point.low, axes_.y.from), point.high);
    if (bars.empty()) return;
    put("bars", s, bars);
    layers_.push_back(
        fmt::format("$bars{} using 1:2:3:4 with yerrorbars linetype 1 linecolor {} linewidth 1.2 pointtype 0 notitle",
                    s, color_of(series)));
  }

  /// Whether the mark covers the bar.
  bool is_covered(const PlotPoint& point) const {
    if (plot_.scale == PlotScale::linear) return !(axes_.y.part(point.high) - axes_.y.part(point.low) > shortest_part);
    return !(point.high > shortest_bar * plot_.height(point.low));
  }

  void add_labels(size_t s, const PlotSeries& series) {
    string labels;
    for (const PlotPoint& point : series.points)
      if (!point.label.empty() && labels_.fits(point.x, plot_.height(point.y)))
        labels += fmt::format("{:.17g} {:.17g} \"{}\"\n", point.x, plot_.height(point.y), point.label);
    if (labels.empty()) return;
    put("labels", s, labels);
    layers_.push_back(
        fmt::format("$labels{} using 1:2:3 with labels left offset 0.9,0.5 font ',10' textcolor {} noenhanced notitle",
                    s, color_of(series)));
  }

  void put(const char* name, size_t s, const string& lines) {
    data_ += fmt::format("${}{} << END\n{}END\n", name, s, lines);
  }

  const Plot& plot_;
  const PlotAxes& axes_;
  PlotLabels labels_;
  string data_;
  vector<string> layers_;
};

}  // namespace

string plot_color(const PlotSeries& series) {
  string text = "#";
  for (const int part : styles.at(series.style).color)
    text += fmt::format("{:02X}", int(std::lround(part + (255 - part) * series.tint)));
  return text;
}

int plot_mark(const PlotSeries& series) {
  return styles.at(series.style).mark;
}

string plot_script(const Plot& plot) {
  const PlotAxes axes = axes_of(plot);
  const PlotFrame frame = frame_of(plot, axes);
  return fmt::format(
             "set encoding utf8\n"
             "{}{}set tics nomirror scale 0.8,0.4\n"
             "set grid xtics ytics linetype 1 linecolor '#E4E4E4' linewidth 1\n"
             "set border 3 linecolor '#606060' linewidth 1.2\n"
             "set lmargin at screen {:.6g}\nset rmargin at screen {:.6g}\n"
             "set bmargin at screen {:.6g}\nset tmargin at screen {:.6g}\n"
             "set key at screen {:.6g}, graph 0.98 left top vertical Left reverse noenhanced spacing 1.5 samplen 2.5\n",
             axes.x.commands('x'), axes.y.commands('y'), frame.left, frame.right, frame.bottom, frame.top,
             frame.legend) +
         // The titles.
         fmt::format(
             "set label 1 {} at screen {:.6g}, screen {:.6g} left font ',17' noenhanced\n"
             "set label 2 {} at screen {:.6g}, screen {:.6g} left font ',12' textcolor '#505050' noenhanced\n"
             "set label 3 {} at screen {:.6g}, screen {:.6g} center rotate noenhanced\n"
             "set xlabel {} noenhanced offset 0,0.2\n",
             quoted_text(plot.title), frame.left, 1 - 25.0 / plot.svg_height, quoted_text(plot.subtitle), frame.left,
             1 - 50.0 / plot.svg_height, quoted_text(axes.y.label(plot.y_label, plot.y_unit)), frame.y_label,
             (frame.bottom + frame.top) / 2, quoted_text(axes.x.label(plot.x_label, plot.x_unit))) +
         PlotLayers(plot, axes).text();
}

}  // namespace carom
