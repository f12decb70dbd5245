// The charts are gathered and drawn as those of a run are. Only the data come from the run's files.
#include "run/plot_run.h"

#include <fcntl.h>

#include "export/tables_book.h"
#include "files/folder_names.h"
#include "files/folder_writer.h"
#include "files/manifest.h"
#include "files/mesh_copies.h"
#include "files/run_folder.h"
#include "files/series.h"
#include "files/stored_file.h"
#include "files/stored_table.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

namespace {

/// Bytes. A title is one line.
constexpr uint64_t largest_summary = 1 << 20;

/// A text file of the run.
string text_of_run(const FormerRun& former, const char* name, uint64_t most) {
  const Descriptor folder = open_folder(AT_FDCWD, former.folder, true);
  const auto text = folder ? read_text(folder.get(), name, most) : nullopt;
  if (!text) throw ExportError(former.folder + "/" + name + " is missing or too large");
  return *text;
}

/// The end of the cell that begins at `from`.
size_t cell_end(const string& text, size_t from, char separator) {
  bool quoted = false;
  for (; from < text.size(); ++from) {
    if (text[from] == '"') quoted = !quoted;
    if (!quoted && (text[from] == separator || text[from] == '\n')) break;
  }
  return from;
}

/// summary.csv of a run without pictures.
string without_pictures(string summary) {
  const char separator = separator_of(summary);
  size_t head = 0, row = summary.find('\n') + 1;
  while (head < summary.size()) {
    const size_t head_end = cell_end(summary, head, separator), row_end = cell_end(summary, row, separator);
    if (summary.compare(head, head_end - head, "frames") == 0) return summary.replace(row, row_end - row, "0");
    head = head_end + 1;
    row = row_end + 1;
  }
  return summary;
}

class RunPlotter {
 public:
  explicit RunPlotter(const PlotRequest& request)
      : former_(*request.former),
        request_(request),
        in_place_(request.folder == former_.folder),
        possible_(possible_charts(former_)) {}

  void go(const ReadingWatch& watch) {
    RunCharts charts(*request_.scene);
    read_charts(former_, *request_.scene, charts, watch);
    watch(1);
    write(draw_charts(possible_.names, charts, request_.gnuplot));
  }

 private:
  void write(const vector<ChartFile>& drawn) {
    FolderWriter folder(request_.folder);
    vector<FileRecord> records = in_place_ ? kept_files() : folder.begin(*request_.scene, read_meshes(*request_.scene));
    if (in_place_) folder.renew(*request_.scene, {});

    // Another folder gets the run's totals too.
    optional<OutputFile> summary;
    unique_ptr<OutputFile> workbook;
    vector<PartFile*> files;
    if (!in_place_) {
      summary.emplace(folder.place(), "summary.csv");
      summary->write(without_pictures(text_of_run(former_, "summary.csv", largest_summary)));
      summary->complete();
      records.push_back(summary->record());
      files.push_back(&*summary);

      workbook = write_tables_workbook(
          folder.place(), request_.scene->output.tables, request_.scene->title, [&](const string& name) {
            return name == "summary.csv" ? open_stored(folder.place().folder, part_name(name)) : Descriptor();
          });
      if (workbook) {
        records.push_back(workbook->record());
        files.push_back(workbook.get());
      }
    }

    Series series(folder, plot_files);
    for (const ChartFile& file : drawn) series.put(file.name, file.bytes);
    const vector<FileRecord> charts = series.records();
    records.insert(records.end(), charts.begin(), charts.end());

    OutputFile manifest(folder.place(), manifest_name);
    manifest.write(changed_manifest(text_of_run(former_, manifest_name, largest_manifest), *request_.scene, records));
    manifest.complete();
    folder.publish(std::move(files), manifest);
  }

  /// All files of the run except those that are drawn now.
  vector<FileRecord> kept_files() const {
    vector<FileRecord> files = former_.manifest.files;
    std::erase_if(files, [&](const FileRecord& file) { return is_drawn_by(possible_, file.name); });
    return files;
  }

  const FormerRun& former_;
  const PlotRequest& request_;
  const bool in_place_;
  const PossibleCharts possible_;
};

}  // namespace

void plot_run(const PlotRequest& request, const ReadingWatch& watch) {
  RunPlotter(request).go(watch);
}

}  // namespace carom
