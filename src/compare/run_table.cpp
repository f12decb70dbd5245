// Keeps the numbers of each run until all are known, because a column's digits depend on all of them.
// A row links what stands in the run's folder and embeds nothing.
#include "compare/run_table.h"

#include <fmt/format.h>

#include <filesystem>

#include "compare/scenarios.h"
#include "export/page.h"
#include "files/csv.h"
#include "files/failed_run.h"
#include "files/folder_names.h"
#include "files/folders.h"
#include "files/run_folder.h"
#include "files/stored_table.h"
#include "scene/film_format.h"
#include "scene/output_kinds.h"
#include "std.h"

namespace carom {
namespace {

/// The first of these names that `is` accepts. Empty: none.
template <typename Is>
string first_of(const vector<string>& names, const Is& is) {
  const auto found = ranges::find_if(names, is);
  return found == names.end() ? "" : *found;
}

bool is_film(const string& name) {
  return film_format(name).has_value();
}

/// The run's sheet, first frame or still. Empty: none.
string picture_in(const RunRecord& run, const vector<string>& names) {
  if (contains(names, string_view("sheet.png"))) return "sheet.png";
  if (contains(names, frame_files.folder)) {
    const Descriptor folder = open_folder(run.folder.get(), string(frame_files.folder), false);
    const vector<string> frames = folder ? folder_names(folder.get()) : vector<string>();
    const string first = first_of(frames, [](const string& name) { return frame_files.has(name); });
    if (!first.empty()) return fmt::format("{}/{}", frame_files.folder, first);
  }
  return first_of(names, [](const string& name) { return name.starts_with("still_") && name.ends_with(".png"); });
}

}  // namespace

RunTable::RunTable(const FilePlace& place, const ComparisonPlan& plan, const vector<Measure>& measures, bool unrelated)
    : page_path_(place.path),
      has_parameters_(!unrelated),
      status_(size_t(find_summary_column("status") - summary_columns().data())) {
  vector<string> paths;
  for (const Parameter& parameter : plan.parameters) paths.push_back(parameter.path);
  const vector<string> names = short_names(paths);

  for (size_t p = 0; has_parameters_ && p < paths.size(); ++p)
    columns_.push_back({label_of({names[p], plan.parameters[p].unit}), paths[p], true, true});
  for (const Measure& measure : measures) columns_.push_back({label_of(measure.name), measure.name});
}

void RunTable::add(const RunRecord& run) {
  if (rows_.size() == most) return;
  Row row{run.run.id, run.done ? run.summary[status_] : "failed", {}, {}, media_of(run)};
  if (!run.done) row.error = stored_failure(run.run.folder);
  has_media_ = has_media_ || !row.media.film.empty() || !row.media.picture.empty();
  has_other_status_ = has_other_status_ || row.status != "done";

  // Its cells. Those of a failed run do not count for the look of a column.
  for (size_t p = 0; has_parameters_ && p < run.run.values.size(); ++p) row.cells.push_back(cell_of(run.run.values[p]));
  for (size_t k = 0; k < run.measures.size(); ++k)
    row.cells.push_back({run.texts[k].empty() && isfinite(run.measures[k]) ? "number" : run.texts[k], run.measures[k]});

  for (size_t k = 0; k < columns_.size(); ++k) {
    Column& column = columns_[k];
    const Cell& cell = row.cells[k];
    column.look.add(cell.number);
    column.is_number = column.is_number && (cell.is_number() || cell.text.empty());
    const Cell& first = rows_.empty() ? cell : rows_.front().cells[k];
    const bool same = cell.is_number() ? cell.number == first.number : cell.text == first.text && !first.is_number();
    column.is_constant = column.is_constant && same;
  }

  numbers_.emplace(row.id, rows_.size());
  rows_.push_back(std::move(row));
}

/// Of a sweep, its own runs need no look at the disk.
string RunTable::path_from_page(const string& folder) const {
  const string inside = page_path_ + "/";
  if (folder.starts_with(inside)) return folder.substr(inside.size());
  return std::filesystem::path(canonical(folder)).lexically_relative(canonical(page_path_)).string();
}

RunTable::Media RunTable::media_of(const RunRecord& run) const {
  Media media;
  if (!run.folder) return media;
  const string folder = path_from_page(run.run.folder) + "/";
  const vector<string> names = folder_names(run.folder.get());
  const auto path = [&](const string& name) { return name.empty() ? name : folder + name; };
  media.folder = contains(names, string_view(page_name)) ? folder + page_name : folder;
  media.film = path(first_of(names, is_film));
  media.picture = path(picture_in(run, names));
  return media;
}

string RunTable::anchor(string_view id) const {
  const auto found = numbers_.find(id);
  return found == numbers_.end() ? "" : fmt::format("#n{}", found->second + 1);
}

string RunTable::link(string_view id) const {
  const string to = anchor(id);
  return to.empty() ? html_text(id) : fmt::format("<a href=\"{}\">{}</a>", to, html_text(id));
}

vector<size_t> RunTable::shown() const {
  vector<size_t> shown;
  for (size_t k = 0; k < columns_.size(); ++k)
    if (!columns_[k].is_constant || rows_.size() < 2) shown.push_back(k);
  return shown;
}

string RunTable::constants() const {
  string text;
  for (const Column& column : columns_) {
    if (!column.is_constant || rows_.size() < 2) continue;
    const Cell& cell = rows_.front().cells[size_t(&column - columns_.data())];
    const string value = cell.is_number() ? short_number(cell.number) : cell.text;
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", column.head, value.empty() ? "undefined" : value);
  }
  return text;
}

/// A film of a format that browsers play is a video; others move as pictures do.
string RunTable::media_html(const Media& media) {
  const bool is_video = film_format(media.film) == FilmFormat::mp4;
  const string film = html_address(media.film),
               picture = html_address(media.picture.empty() ? media.film : media.picture);
  if (is_video && media.picture.empty())
    return fmt::format("<video controls=\"\" preload=\"none\" muted=\"\" src=\"{}\"></video>", film);
  if (picture.empty()) return {};
  return fmt::format("<a href=\"{}\"><img loading=\"lazy\" alt=\"\" src=\"{}\"/></a>", film.empty() ? picture : film,
                     picture);
}

string RunTable::cell_html(const Column& column, const Cell& cell) const {
  if (!column.is_number) return fmt::format("<td class=\"t\">{}</td>", html_text(cell.text));
  // What the script sorts and filters by, where the digits that are shown are not all.
  const string shown = column.look.text(cell.number);
  if (number_in(shown) == cell.number) return fmt::format("<td>{}</td>", shown);
  return fmt::format("<td data-v=\"{}\">{}</td>", number_cell(cell.number), shown);
}

string RunTable::row_html(size_t number) const {
  const Row& row = rows_[number];
  string text = fmt::format("<tr id=\"n{}\"", number + 1);
  if (row.status != "done") text += fmt::format(" class=\"{}\"", html_text(row.status));
  text += "><td class=\"t\">";
  text += row.media.folder.empty() ? html_text(row.id) : html_link(row.media.folder, row.id);
  text += "</td>";
  if (has_media_) text += fmt::format("<td class=\"m\">{}</td>", media_html(row.media));

  for (const size_t k : shown()) text += cell_html(columns_[k], row.cells[k]);
  if (has_other_status_)
    text += fmt::format("<td class=\"t\">{}{}</td>", html_text(row.status),
                        row.error.empty() ? "" : fmt::format("<small> {}</small>", html_text(row.error)));
  return text + "</tr>\n";
}

string RunTable::html() const {
  string text = "<table id=\"runs\"><thead><tr><th class=\"t\">run</th>";
  if (has_media_) text += "<th class=\"m\">picture</th>";
  for (const size_t k : shown()) {
    const Column& column = columns_[k];
    text += fmt::format("<th class=\"{}{}\" title=\"{}\">{}</th>", column.is_number ? "n" : "t",
                        column.is_varied ? " v" : "", html_text(column.title), html_text(column.head));
  }
  if (has_other_status_) text += "<th class=\"t\">status</th>";
  text += "</tr></thead>\n<tbody>\n";
  for (size_t number = 0; number < rows_.size(); ++number) text += row_html(number);
  return text + "</tbody></table>\n";
}

}  // namespace carom
