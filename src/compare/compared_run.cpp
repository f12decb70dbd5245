// Reads a run by its manifest, summary.csv and, for other measures, what is stored of them (stored_measures.h).
#include "compare/compared_run.h"

#include <fcntl.h>
#include <fmt/format.h>

#include "compare/stored_measures.h"
#include "files/folder_writer.h"
#include "files/manifest.h"
#include "files/run_folder.h"
#include "files/stored_file.h"
#include "scene/scene_values.h"
#include "std.h"
#include "yaml/source.h"

namespace carom {
namespace {

[[noreturn]] void refuse_run(const string& folder, const string& text) {
  throw ExportError(fmt::format("{} {}", folder, text));
}

vector<string> read_summary(const RunRecord& run) {
  StoredTable table = open_table(run, summary_name);
  if (table.next() == nullptr) refuse_run(run.run.folder, "has an empty summary.csv: run it again with --force");
  vector<string> cells;
  for (const SummaryColumn& column : summary_columns()) cells.emplace_back(table.cell(table.find(column.name)));
  return cells;
}

}  // namespace

StoredTable open_table(const RunRecord& run, const char* name) {
  Descriptor file = open_stored_table(run.folder.get(), name);
  if (!file) refuse_run(run.run.folder, fmt::format("has no {}", name));
  return StoredTable(std::move(file));
}

bool has_file(const RunRecord& run, const char* name) {
  return stored_table(run.folder.get(), name).has_value();
}

optional<CsvDialect> dialect_of(const ComparedRun& run) {
  const Descriptor folder = open_folder(AT_FDCWD, run.folder, true);
  const auto text = folder ? read_text(folder.get(), "scene.yaml", max_source_bytes) : nullopt;
  return text ? optional(CsvDialect(own_tables(*text))) : nullopt;
}

bool has_measures(const string& path, const vector<Measure>& measures) {
  if (all_of(measures, [](const Measure& m) { return m.column != nullptr; })) return true;
  const Descriptor folder = open_folder(AT_FDCWD, path, true);
  return folder && StoredMeasures(folder.get(), path).have(measures);
}

RunRecord read_run(ComparedRun run, const vector<Measure>& measures) {
  RunRecord record{std::move(run), false, Descriptor(), {}, {}, {}};
  record.folder = open_folder(AT_FDCWD, record.run.folder, true);

  if (!record.folder && !record.run.failed) refuse_run(record.run.folder, "cannot be opened: there is no such folder");
  record.done = !record.run.failed && has_file(record, manifest_name) && has_file(record, summary_name);
  if (!record.done && !record.run.failed && !has_file(record, failure_file))
    refuse_run(record.run.folder, "holds no whole run: run its scene again, or leave it out");

  if (!record.done) {
    record.summary.assign(summary_columns().size(), "");
    record.measures.assign(measures.size(), numeric_limits<double>::quiet_NaN());
    record.texts.resize(measures.size());
    return record;
  }

  record.summary = read_summary(record);
  StoredMeasures stored(record.folder.get(), record.run.folder);
  for (const Measure& measure : measures) {
    const Measured measured = stored.value(measure, record.summary);
    record.measures.push_back(measured.value);
    record.texts.push_back(measured.text);
  }
  return record;
}

}  // namespace carom
