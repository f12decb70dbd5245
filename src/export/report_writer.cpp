// The charts are those of plots/, drawn anew in the size of the page: their letters are too small on a telephone.
#include "export/report_writer.h"

#include <fmt/format.h>

#include "export/gnuplot.h"
#include "export/page.h"
#include "export/tables.h"
#include "files/folders.h"
#include "files/summary_columns.h"
#include "scene/film_format.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/joined.h"

namespace carom {
namespace {

constexpr size_t most_collisions = 12;
/// Bytes of the scene's text. A longer one is linked alone.
constexpr size_t most_text = 100'000;

/// The film, the sheet or the first frame, whatever there is first.
string picture_of(span<const FileRecord> files) {
  const auto image = [](string_view name, string_view what) {
    return fmt::format("<img class=\"film\" src=\"{}\" alt=\"{}\"/>\n", html_address(name), what);
  };

  for (const FileRecord& file : files)
    if (const auto format = film_format(file.name); format == FilmFormat::mp4)
      return fmt::format("<video class=\"film\" controls=\"\" preload=\"metadata\" src=\"{}\"></video>\n",
                         html_address(file.name));
    else if (format)
      return image(file.name, "film");

  for (const FileRecord& file : files)
    if (file.name == "sheet.png") return image(file.name, "pictures of the run");
  for (const FileRecord& file : files)
    if (file.name.starts_with(frame_files.folder)) return image(file.name, "the first picture");
  return {};
}

/// A row: name, value, unit, meaning.
string row_of(string_view column, const string& value, string_view meaning) {
  const UnitSuffix* unit = unit_suffix(column);
  string name(column.substr(0, column.size() - (unit == nullptr ? 0 : unit->suffix.size())));
  ranges::replace(name, '_', ' ');
  return fmt::format("<tr><td class=\"t\">{}</td><td>{}</td><td class=\"t\">{}</td><td class=\"t\">{}</td></tr>\n",
                     html_text(name), html_text(value), unit == nullptr ? "" : html_text(unit->unit),
                     html_text(meaning));
}

string value_text(const SummaryColumn& column, const Summary& summary) {
  const auto value = column.value(summary);
  if (const auto* text = std::get_if<string_view>(&value)) return string(*text);
  if (const auto* count = std::get_if<uint64_t>(&value)) return to_string(*count);
  return short_number(std::get<double>(value));
}

constexpr const char* head_of_rows = "<tr><th>name</th><th class=\"n\">value</th><th>unit</th><th>meaning</th></tr>\n";

/// The measures that the scene defines. Empty: there are none.
string measures_of(const Summary& summary) {
  if (summary.measures.empty()) return {};
  string text = "<h2>Measures of the scene</h2>\n<div class=\"wide\"><table>";
  for (const Measured& measure : summary.measures)
    text += fmt::format("<tr><td class=\"t\">{}</td><td><b>{}</b></td></tr>\n", html_text(measure.name),
                        html_text(measure.text.empty() ? short_number(measure.value) : measure.text));
  return text + "</table></div>\n";
}

string numbers_of(const Summary& summary) {
  string text = fmt::format("<h2>Numbers</h2>\n<div class=\"wide\"><table>{}", head_of_rows);
  for (const SummaryColumn& column : summary_columns()) {
    const string value = value_text(column, summary);
    if (column.name != "title" && !value.empty()) text += row_of(column.name, value, column.meaning);
  }
  return text + "</table></div>\n<p class=\"quiet\">Numbers have five digits here, and all in " +
         html_link("summary.csv", "summary.csv") + ".</p>\n";
}

string size_text(uint64_t bytes) {
  if (bytes < 1000) return how_many(bytes, "byte", "bytes");
  return bytes < 1'000'000 ? fmt::format("{:.3g} kB", double(bytes) / 1e3)
                           : fmt::format("{:.3g} MB", double(bytes) / 1e6);
}

/// A link to each file, and to the first one of each folder.
string links_of(span<const FileRecord> files) {
  map<string, size_t> in_folder;
  for (const FileRecord& file : files)
    if (const size_t slash = file.name.find('/'); slash != string::npos) ++in_folder[file.name.substr(0, slash)];

  string text = "<h2>Files</h2>\n<p class=\"links\">";
  set<string> named;
  for (const FileRecord& file : files) {
    const size_t slash = file.name.find('/');
    string note = size_text(file.bytes);
    if (slash != string::npos) {
      const string folder = file.name.substr(0, slash);
      if (!named.insert(folder).second) continue;
      note = fmt::format("the first of {}", how_many(in_folder[folder], "file", "files"));
    }
    text += fmt::format("<span>{} <small>{}</small></span> ", html_link(file.name, file.name), html_text(note));
  }
  return text + html_link("manifest.json", "manifest.json") + "</p>\n";
}

string head_of(const Summary& summary, const RunFacts& facts) {
  string text =
      fmt::format("<p><span class=\"flag {}\">{}</span>engine {}, {} simulated, ended by {}</p>\n",
                  summary.status == "done" ? "good" : "doubtful", html_text(summary.status), html_text(summary.engine),
                  html_text(short_number(summary.duration) + " s"), html_text(summary.ended_by));
  for (const Warning& warning : summary.warnings)
    text += fmt::format("<p class=\"doubtful\">{}</p>\n", html_text(warning.text));
  for (const LeftOut& file : facts.left_out)
    text += fmt::format("<p class=\"doubtful\">without {}: {}</p>\n", html_text(file.name), html_text(file.why));
  return text;
}

}  // namespace

ReportWriter::ReportWriter(const FolderWriter& folder, const Scene& scene)
    : folder_(folder), scene_(scene), gnuplot_(find_gnuplot()), charts_(scene) {}

void ReportWriter::record(span<const Collision> collisions) {
  for (const Collision& collision : collisions) {
    charts_.collisions.add(collision.time, collision.kind);
    if (first_.size() < most_collisions && collision.kind != CollisionKind::rest) first_.push_back(collision);
  }
}

void ReportWriter::add(double time, const State& state, span<const ContactForce>) {
  charts_.sample(time, state);
}

string ReportWriter::first_collisions() const {
  if (first_.empty()) return {};
  string text =
      "<h2>First collisions</h2>\n<div class=\"wide\"><table><tr><th class=\"n\">time (s)</th><th>kind</th>"
      "<th>a</th><th>b</th><th class=\"n\">approach (m/s)</th><th class=\"n\">restitution</th>"
      "<th class=\"n\">impulse (N s)</th><th class=\"n\">energy lost (J)</th></tr>\n";

  for (const Collision& one : first_)
    text += fmt::format(
        "<tr><td>{}</td><td class=\"k\">{}</td><td class=\"k\">{}</td><td class=\"k\">{}</td><td>{}</td><td>{}</td>"
        "<td>{}</td><td>{}</td></tr>\n",
        short_number(one.time), name_of(one.kind), html_text(scene_.roster.name(one.a)),
        html_text(scene_.roster.name(one.b)), short_number(one.approach_speed), short_number(one.restitution),
        short_number(one.impulse), short_number(one.energy_lost));
  return text + "</table></div>\n";
}

string ReportWriter::text(const Summary& summary, const RunFacts& facts, span<const FileRecord> files) const {
  const string title = summary.title.empty() ? name_of_folder(folder_.place().path) : summary.title;
  string text = page_head(title) + fmt::format("<h1>{}</h1>\n", html_text(title)) + head_of(summary, facts);
  text += fmt::format("<div class=\"columns\"><div>{}</div><div>{}{}</div></div>\n", picture_of(files),
                      measures_of(summary), first_collisions());

  // A chart's subtitle says what it shows; its title is that of the scene.
  vector<Plot> plots;
  for (const RunChart& chart : run_charts()) {
    plots.push_back(chart.plot(charts_));
    plots.back().title = exchange(plots.back().subtitle, "");
  }
  const PageFigures page = draw_figures(std::move(plots), gnuplot_);
  text += fmt::format("<h2>Charts</h2>\n{}<div class=\"columns\">{}</div>\n", page.marks, joined(page.figures, ""));

  text += numbers_of(summary) + links_of(files);
  if (scene_.resolved.size() <= most_text)
    text += fmt::format("<details><summary>The scene, with all its values</summary><pre>{}</pre></details>\n",
                        html_text(scene_.resolved));
  return text + page_end();
}

OutputFile* ReportWriter::page(const Summary& summary, const RunFacts& facts, span<const FileRecord> files) {
  file_.emplace(folder_.place(), page_name);
  file_->write(text(summary, facts, files));
  return &*file_;
}

}  // namespace carom
