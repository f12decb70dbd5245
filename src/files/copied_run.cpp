// Copies a run file by file and compares the hash of each copy with the manifest.
// The manifest is copied last, so that an interrupted copy is an incomplete run.
#include "files/copied_run.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>

#include "files/folder_names.h"
#include "files/folder_writer.h"
#include "files/manifest.h"
#include "files/series_folders.h"
#include "files/stored_file.h"
#include "scene/output_kinds.h"
#include "std.h"

namespace carom {
namespace {

/// Copies a file. Its size and hash must match the record.
void copy_file(const FileSpot& from, const FilePlace& to, const FileRecord& record) {
  const string& name = from.name;
  const Descriptor source = open_stored(from.folder, name);
  if (!source) fail("copy", to, name, "it is missing from the original run");

  OutputFile file(to, name);
  array<char, 65536> buffer{};
  ssize_t n;
  while ((n = read(source.get(), buffer.data(), buffer.size())) != 0) {
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("copy", to, name);
    file.write({buffer.data(), size_t(n)});
  }

  // What was read has the hash of the manifest.
  file.complete();
  if (file.record().sha256 != record.sha256) fail("copy", to, name, "the original run has changed");
  file.publish();
}

}  // namespace

void copy_run(const string& from, const string& to) {
  const Descriptor source = open_folder(AT_FDCWD, from, true);
  const optional<Manifest> manifest = source ? read_manifest(source.get(), manifest_name) : nullopt;
  const optional<string> text = manifest ? read_text(source.get(), manifest_name, largest_manifest) : nullopt;
  if (!text) fail("copy", {-1, from}, "", "it holds no whole run");

  FolderWriter folder(to, Durability::deferred);
  remove_files_of_run(folder.place());
  SeriesFolders from_series(source.get());
  map<const OutputKind*, FilePlace> to_series;

  for (const FileRecord& record : manifest->files) {
    const FileSpot spot = from_series.spot(record.name);
    if (spot.folder < 0) fail("copy", {-1, from}, record.name, "it is not there");
    const OutputKind* series = output_with_series(record.name);
    if (series != nullptr && !to_series.contains(series)) to_series[series] = folder.series(series->series);
    copy_file(spot, series == nullptr ? folder.place() : to_series[series], record);
  }

  OutputFile last(folder.place(), manifest_name);
  last.write(*text);
  last.publish();
  folder.keep();
}

void remove_run(const string& path) {
  const Descriptor folder = open_folder(AT_FDCWD, path, false);
  if (!folder) return;
  remove_files_of_run({folder.get(), path});
  // A folder with files of another origin stays.
  if (rmdir(path.c_str()) != 0 && errno != ENOTEMPTY && errno != EEXIST && !is_absent(errno))
    fail("remove", {-1, path}, "");
}

}  // namespace carom
