// Writes a gnuplot script with fixed colours, fonts and ranges, and reads the picture from gnuplot's standard output.
// Ranges are whole powers of ten computed here, and labels are placed here.
// No default of gnuplot or of its user then changes the picture.
#include "export/plot.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>

#include "export/child.h"
#include "files/run_folder.h"
#include "yaml/joined.h"

namespace carom {

namespace {

constexpr auto patience = std::chrono::minutes(1);
/// The ratio of its upper to its lower end.
constexpr double shortest_bar = 1.2;
/// Of a picture, as much as Child::output() keeps.
constexpr std::size_t most_bytes = (1 << 20) - 1;

/// Colours that are distinct for every kind of colour vision (Okabe & Ito 2008), and gnuplot's numbers of marks.
struct PlotStyle {
  const char* color;
  int mark;
};
constexpr std::array<PlotStyle, plot_styles> styles = {{{"#D55E00", 13},
                                                        {"#E69F00", 7},
                                                        {"#009E73", 5},
                                                        {"#0072B2", 9},
                                                        {"#CC79A7", 11},
                                                        {"#56B4E9", 15},
                                                        {"#000000", 6},
                                                        {"#8C8C00", 4}}};

/// Text in single quotes, which gnuplot takes literally.
std::string quoted_text(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') quoted += '\'';
    quoted += static_cast<unsigned char>(c) < ' ' || c == 127 ? ' ' : c;
  }
  return quoted + "'";
}

/// The range of one axis. widen() makes it whole powers of ten with some margin around the values taken.
struct AxisRange {
  double from = std::numeric_limits<double>::infinity(), to = 0;
  void take(double value) {
    from = std::min(from, value);
    to = std::max(to, value);
  }
  void widen() {
    if (!(from <= to)) from = to = 1;
    from = std::floor(std::log10(from) - 0.15);
    to = std::ceil(std::log10(to) + 0.15);
  }
  std::string text() const { return fmt::format("[1e{}:1e{}]", static_cast<int>(from), static_cast<int>(to)); }
  double part(double value) const { return (std::log10(value) - from) / (to - from); }
};

/// Leaves out a label that would cover another one. Distances are in shares of the picture's width and height.
class Labels {
 public:
  Labels(const AxisRange& x, const AxisRange& y) : x_(x), y_(y) {}
  bool fits(double x, double y) {
    const double across = x_.part(x), up = y_.part(y);
    const auto covers = [&](const auto& p) {
      return std::abs(p.first - across) < 0.1 && std::abs(p.second - up) < 0.03;
    };
    if (std::any_of(taken_.begin(), taken_.end(), covers)) return false;
    taken_.emplace_back(across, up);
    return true;
  }

 private:
  const AxisRange &x_, &y_;
  std::vector<std::pair<double, double>> taken_;
};

std::string script(const Plot& plot, const std::string& terminal) {
  const auto height = [&](double y) { return std::max(y, plot.floor); };
  AxisRange x, y;
  for (const PlotSeries& series : plot.series)
    for (const PlotPoint& point : series.points) x.take(point.x), y.take(height(point.y));
  for (const PlotLevel& level : plot.levels) y.take(height(level.y));
  x.widen();
  y.widen();

  std::string text = fmt::format(
      "set terminal {}\nset encoding utf8\n"
      "set logscale xy\nset xrange {}\nset yrange {}\n"
      "set format x '10^{{%T}}'\nset format y '10^{{%T}}'\nset tics nomirror scale 0.8,0.4\n"
      "set mxtics 10\nset mytics 10\n"
      "set grid xtics ytics linetype 1 linecolor '#E4E4E4' linewidth 1\n"
      "set border 3 linecolor '#606060' linewidth 1.2\n"
      "set lmargin at screen 0.1\nset rmargin at screen 0.79\nset bmargin at screen 0.11\nset tmargin at screen 0.86\n"
      "set key at screen 0.805, graph 0.98 left top vertical Left reverse noenhanced spacing 1.5 samplen 2.5\n"
      "set label 1 {} at screen 0.1, screen 0.95 left font ',17' noenhanced\n"
      "set label 2 {} at screen 0.1, screen 0.9 left font ',12' textcolor '#505050' noenhanced\n"
      "set xlabel {} noenhanced offset 0,0.2\nset ylabel {} noenhanced offset 0.5,0\n",
      terminal, x.text(), y.text(), quoted_text(plot.title), quoted_text(plot.subtitle), quoted_text(plot.x_label),
      quoted_text(plot.y_label));
  std::string data;
  std::vector<std::string> layers;
  for (const PlotLevel& level : plot.levels)
    layers.push_back(fmt::format("{:.17g} with lines linetype 1 linecolor '#808080' linewidth 1.5 dashtype 2 title {}",
                                 height(level.y), quoted_text(level.name)));
  Labels places(x, y);
  for (std::size_t s = 0; s < plot.series.size(); ++s) {
    const PlotSeries& series = plot.series[s];
    if (series.points.empty()) continue;
    const PlotStyle style = styles.at(series.style);
    std::string labels, bars;
    data += fmt::format("$series{} << END\n", s);
    for (const PlotPoint& point : series.points) {
      data += fmt::format("{:.17g} {:.17g}\n", point.x, height(point.y));
      // A bar that the mark would cover is left out.
      if (point.high > shortest_bar * height(point.low))
        bars += fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}\n", point.x, height(point.y),
                            std::max(point.low, std::pow(10, y.from)), point.high);
      if (!point.label.empty() && places.fits(point.x, height(point.y)))
        labels += fmt::format("{:.17g} {:.17g} \"{}\"\n", point.x, height(point.y), point.label);
    }
    data += "END\n";
    if (!bars.empty()) {
      data += fmt::format("$bars{} << END\n{}END\n", s, bars);
      layers.push_back(fmt::format(
          "$bars{} using 1:2:3:4 with yerrorbars linetype 1 linecolor '{}' linewidth 1.2 pointtype 0 notitle", s,
          style.color));
    }
    layers.push_back(
        fmt::format("$series{} using 1:2 with linespoints linetype 1 linecolor '{}' linewidth 2 pointtype {} "
                    "pointsize 1.3 title {}",
                    s, style.color, style.mark, quoted_text(series.name)));
    if (labels.empty()) continue;
    data += fmt::format("$labels{} << END\n{}END\n", s, labels);
    layers.push_back(fmt::format(
        "$labels{} using 1:2:3 with labels left offset 0.9,0.5 font ',10' textcolor '{}' noenhanced notitle", s,
        style.color));
  }
  if (layers.empty()) layers.push_back("NaN notitle");
  return text + data + fmt::format("plot {}\n", joined(layers, ", \\\n  "));
}

/// The standard output of gnuplot for a script on its standard input.
std::string drawn(const std::string& gnuplot, const std::string& script) {
  const Descriptor folder(open("/", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  Child child({gnuplot, "--default-settings"}, folder.get(), true);
  const bool sent = child.send(script.data(), script.size(), patience) == Child::Sent::all;
  child.end_input();
  const auto code = child.wait(patience);
  if (code != 0)
    throw ExportError("cannot draw the plot: gnuplot " +
                      (code ? fmt::format("failed with code {}: {}", *code, child.errors())
                            : std::string("did not end within a minute and was stopped")));
  std::string picture = child.output();
  // The exit code and the output come first. A program that reads nothing may end before or after the sending.
  if (picture.empty()) throw ExportError("cannot draw the plot: gnuplot wrote nothing: " + child.errors());
  if (!sent) throw ExportError("cannot draw the plot: gnuplot did not read all of it: " + child.errors());
  if (picture.size() > most_bytes) throw ExportError("cannot draw the plot: it takes more than a megabyte");
  return picture;
}

}  // namespace

std::string find_gnuplot() {
  const auto gnuplot = find_program("gnuplot");
  if (!gnuplot)
    throw ExportError(
        "the plots need gnuplot, which is not on the PATH: install it (on Debian: apt install "
        "gnuplot-nox)");
  return *gnuplot;
}

PlotPictures draw_plot(const Plot& plot, const std::string& gnuplot) {
  return {drawn(gnuplot, script(plot, "pngcairo size 1600,1000 fontscale 1.35 linewidth 1.35 font 'DejaVu Sans,13'")),
          drawn(gnuplot, script(plot, "svg size 1200,750 dynamic font 'DejaVu Sans,13' background 'white'"))};
}

}  // namespace carom
