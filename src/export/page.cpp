// gnuplot's SVG is a document of its own: with a head, identifiers that are the same in each, and fonts. In a page only
// its drawing remains, and all drawings share one set of marks.
#include "export/page.h"

#include <fmt/format.h>

#include "export/gnuplot.h"
#include "export/page_style.h"
#include "export/plot_script.h"
#include "std.h"
#include "yaml/printable.h"

namespace carom {
namespace {

/// Small enough for a telephone, where letters are then of a readable size.
constexpr int figure_width = 460, figure_height = 300;

void replace_all(string& text, string_view from, string_view to) {
  for (size_t at = 0; (at = text.find(from, at)) != string::npos; at += to.size()) text.replace(at, from.size(), to);
}

/// The text between two marks, without them. Empty: they are absent.
string_view between(string_view text, string_view first, string_view last) {
  const size_t begin = text.find(first);
  const size_t end = begin == string_view::npos ? begin : text.find(last, begin + first.size());
  return end == string_view::npos ? string_view() : text.substr(begin + first.size(), end - begin - first.size());
}

/// gnuplot's marks, gpPt0 and so on.
string marks_of(string_view svg) {
  string marks(between(svg, "<defs>", "<filter"));
  replace_all(marks, "xlink:href", "href");
  return fmt::format("<svg class=\"marks\" aria-hidden=\"true\"><defs>{}</defs></svg>\n", marks);
}

/// The groups of a drawing, without those that are empty and without what they say needlessly.
string drawing_of(string_view svg) {
  const size_t begin = svg.find("</defs>"), end = svg.rfind("</svg>");
  if (begin == string_view::npos || end == string_view::npos) return {};
  string text(svg.substr(begin + 7, end - begin - 7));
  replace_all(text, "xlink:href", "href");
  for (const string_view word : {" font-family=\"DejaVu Sans\"", " stroke-linecap=\"butt\"",
                                 " stroke-linejoin=\"miter\"", " color=\"black\"", " stroke-width=\"1.00\"", "\t"})
    replace_all(text, word, "");
  replace_all(text, "<tspan >", "<tspan>");

  // A group that is opened and closed at once.
  string kept;
  for (size_t at = 0; at < text.size();) {
    size_t line = min(text.find('\n', at), text.size());
    const string_view one = string_view(text).substr(at, line - at);
    const bool is_empty = one.starts_with("<g ") && one.ends_with(">") && text.compare(line, 5, "\n</g>") == 0;
    if (is_empty) line = min(text.find('\n', line + 1), text.size());
    const size_t name = one.find(" id=\"");
    if (!is_empty && !one.empty() && name != string_view::npos)
      kept += fmt::format("{}{}\n", one.substr(0, name), one.substr(one.find('"', name + 5) + 1));
    else if (!is_empty && !one.empty())
      kept.append(one).append("\n");
    at = line + 1;
  }
  // The last one closes the canvas, whose beginning stood in the head.
  return kept.substr(0, kept.rfind("</g>"));
}

/// An entry of the legend.
string key_of(const PlotSeries& series) {
  const string color = plot_color(series);
  string sample;
  if (series.form == PlotForm::band)
    sample = fmt::format("<path d=\"M0,2h26v10h-26z\" fill=\"{}\"/>", color);
  else if (series.form != PlotForm::points)
    sample = fmt::format("<path d=\"M0,7h26\" stroke=\"{}\" stroke-width=\"2\"{}/>", color,
                         series.form == PlotForm::dashes ? " stroke-dasharray=\"5 4\"" : "");
  if (series.form == PlotForm::points || series.form == PlotForm::marks)
    sample += fmt::format("<use href=\"#gpPt{}\" transform=\"translate(13,7) scale(4)\" color=\"{}\"/>",
                          plot_mark(series) - 1, color);
  return fmt::format("<span><svg viewBox=\"0 0 26 14\" aria-hidden=\"true\">{}</svg>{}</span>", sample,
                     html_text(series.name));
}

}  // namespace

string html_text(string_view text) {
  constexpr pair<char, string_view> escapes[] = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}};
  string out;

  // Line by line, since line feeds stay.
  while (true) {
    const size_t line = text.find('\n');
    for (const char c : printable(text.substr(0, line))) {
      const auto* escape = ranges::find(escapes, c, &pair<char, string_view>::first);
      escape == std::end(escapes) ? out += c : out += escape->second;
    }
    if (line == string_view::npos) return out;
    out += '\n';
    text.remove_prefix(line + 1);
  }
}

string html_address(string_view path) {
  constexpr string_view plain = "-._~/0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
  string address;
  for (const char c : path) {
    if (plain.find(c) != string_view::npos)
      address += c;
    else
      address += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return address;
}

string html_link(string_view path, string_view text) {
  return fmt::format("<a href=\"{}\">{}</a>", html_address(path), html_text(text));
}

string short_number(double number) {
  return isfinite(number) ? fmt::format("{:.5g}", number == 0 ? 0 : number) : "";
}

string page_head(string_view title, string_view style) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"/>\n"
      "<title>{}</title>\n<style>{}{}</style></head>\n<body>\n",
      html_text(title), page_style, style);
}

string page_end() {
  return "</body></html>\n";
}

PageFigures draw_figures(vector<Plot> plots, const string& gnuplot) {
  const vector<Plot> described = plots;
  for (Plot& plot : plots) {
    plot.svg_width = figure_width;
    plot.svg_height = figure_height;
    plot.title = plot.subtitle = "";
    for (PlotSeries& series : plot.series) series.name.clear();
  }

  PageFigures page;
  const vector<string> drawn = draw_svgs(plots, gnuplot);
  if (!drawn.empty()) page.marks = marks_of(drawn.front());
  for (size_t i = 0; i < drawn.size(); ++i) {
    const Plot& plot = described[i];
    string figure = fmt::format("<figure><figcaption>{}", html_text(plot.title));
    if (!plot.subtitle.empty()) figure += fmt::format("<small>{}</small>", html_text(plot.subtitle));
    figure += fmt::format("</figcaption>\n<svg class=\"chart\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n",
                          figure_width, figure_height, html_text(plot.title));
    figure += drawing_of(drawn[i]) + "</svg>\n";

    string key;
    for (const PlotSeries& series : plot.series)
      if (!series.name.empty()) key += key_of(series);
    if (!key.empty()) figure += fmt::format("<p class=\"key\">{}</p>", key);
    page.figures.push_back(figure + "</figure>\n");
  }
  return page;
}

}  // namespace carom
