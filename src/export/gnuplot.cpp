// Reads each picture from the standard output of a gnuplot of its own, and all of them draw at once. Pictures of a page
// are many and small: one gnuplot draws one after the other.
#include "export/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <chrono>

#include "export/child.h"
#include "export/plot_script.h"
#include "files/export_error.h"
#include "std.h"

namespace carom {
namespace {

constexpr auto patience = std::chrono::minutes(1);
/// Of a picture.
constexpr size_t most_bytes = (1 << 20) - 1;
/// The size of the PNG by that of the SVG.
constexpr int enlarged = 2;
constexpr const char* plot_font = "font 'DejaVu Sans,13'";

/// Whether a PNG or an SVG has its end.
bool is_whole_picture(string_view bytes) {
  const size_t end = bytes.find_last_not_of('\n');
  return bytes.ends_with("IEND\xAE\x42\x60\x82") || bytes.substr(0, end + 1).ends_with("</svg>");
}

/// gnuplot at work on a script.
class PlotDrawing {
 public:
  PlotDrawing(const string& gnuplot, const string& script)
      : folder_(open("/", O_RDONLY | O_DIRECTORY | O_CLOEXEC)),
        child_({gnuplot, "--default-settings"}, folder_.get(), true),
        sent_(child_.send(script.data(), script.size(), patience) == Child::Sent::all) {
    child_.end_input();
  }

  /// Waits for the picture, its standard output, or for several.
  string picture(size_t most = most_bytes) {
    const auto code = child_.wait(patience);
    if (code != 0)
      throw ExportError("cannot draw the plot: gnuplot " +
                        (code ? fmt::format("failed with code {}: {}", *code, child_.errors())
                              : string("did not end within a minute and was stopped")));
    string bytes = child_.output(most + 1);
    // The exit code and the output come first. A program that reads nothing may end before or after the sending.
    if (bytes.empty()) throw ExportError("cannot draw the plot: gnuplot wrote nothing: " + child_.errors());
    if (!sent_) throw ExportError("cannot draw the plot: gnuplot did not read all of it: " + child_.errors());
    if (bytes.size() > most) throw ExportError("cannot draw the plot: it takes more than a megabyte");
    if (!is_whole_picture(bytes))
      throw ExportError("cannot draw the plot: gnuplot wrote a part of it: " + child_.errors());
    return bytes;
  }

 private:
  Descriptor folder_;
  Child child_;
  bool sent_;
};

/// gnuplot's letters of a size are 4/3 as large in a PNG as in an SVG.
string terminal_of_png(const Plot& plot) {
  return fmt::format("pngcairo size {},{} fontscale {} linewidth {} {}", enlarged * plot.svg_width,
                     enlarged * plot.svg_height, 0.75 * enlarged, enlarged, plot_font);
}

string terminal_of_svg(const Plot& plot) {
  return fmt::format("svg size {},{} dynamic {} background 'white'", plot.svg_width, plot.svg_height, plot_font);
}

}  // namespace

string find_gnuplot() {
  const auto gnuplot = find_program("gnuplot");
  if (!gnuplot)
    throw ExportError(
        "the plots need gnuplot, which is not on the PATH\n  install it (on Debian: apt install gnuplot-nox)");
  return *gnuplot;
}

vector<PlotPictures> draw_plots(span<const Plot> plots, const string& gnuplot) {
  vector<unique_ptr<PlotDrawing>> drawings;
  for (const Plot& plot : plots) {
    const string script = plot_script(plot);
    for (const string& terminal : {terminal_of_png(plot), terminal_of_svg(plot)})
      drawings.push_back(make_unique<PlotDrawing>(gnuplot, fmt::format("set terminal {}\n{}", terminal, script)));
  }
  vector<PlotPictures> pictures(plots.size());
  for (size_t i = 0; i < plots.size(); ++i) pictures[i] = {drawings[2 * i]->picture(), drawings[2 * i + 1]->picture()};
  return pictures;
}

vector<string> draw_svgs(span<const Plot> plots, const string& gnuplot) {
  if (plots.empty()) return {};
  string script;
  for (const Plot& plot : plots)
    script += fmt::format("reset\nset terminal {}\n{}", terminal_of_svg(plot), plot_script(plot));
  const string bytes = PlotDrawing(gnuplot, script).picture(plots.size() * most_bytes);

  // One document follows the other.
  constexpr string_view end = "</svg>";
  vector<string> pictures;
  for (size_t from = 0, to = 0; (to = bytes.find(end, from)) != string::npos; from = to + end.size())
    pictures.push_back(bytes.substr(from, to + end.size() - from));
  if (pictures.size() != plots.size()) throw ExportError("cannot draw the plot: gnuplot wrote a part of it");
  return pictures;
}

}  // namespace carom
