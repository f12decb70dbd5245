// Publishes in four steps: sync the bytes, rename the manifest to `next_manifest`, rename the files,
// rename the manifest.
// The first rename commits. It is a single atomic rename, so a run is published completely or not at all.
// The function finish_publication can be repeated at any point, which makes recovery the same code as the normal path.
#include "files/publication.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "files/folder_names.h"
#include "files/folders.h"
#include "files/manifest.h"
#include "files/series_folders.h"
#include "std.h"

namespace carom {
namespace {

void sync_all(const FilePlace& place, Durability durability) {
  if (durability == Durability::deferred) return;
  if (syncfs(place.folder) != 0) fail("write", place, "");
}

/// Moves the files of a series from their temporary folder to their final one.
void name_series(const FilePlace& place, const string& part, const set<string>& names) {
  const string series = name_of_part(part);
  const Descriptor from = open_folder(place.folder, part, false);
  if (!from) return;
  const Descriptor to = make_folder(place, series);
  for (const string& name : folder_names(from.get()))
    if (names.contains(series + "/" + name)) give_name(from.get(), name, {to.get(), place.path + "/" + series}, name);
}

void name_parts(const FilePlace& place, const Manifest& next) {
  set<string> names;
  for (const FileRecord& file : next.files) names.insert(file.name);
  const vector<string> series = series_folder_names();
  for (const string& part : folder_names(place.folder)) {
    if (!is_part_name(part) || part == next_manifest) continue;
    const string name = name_of_part(part);
    if (names.contains(name)) give_name(place.folder, part, place, name);
    if (contains(series, name)) name_series(place, part, names);
  }
}

/// Removes the files of the former manifest that the next one does not name.
void remove_former(const FilePlace& place, const Manifest& next) {
  const auto former = read_manifest(place.folder, manifest_name);
  if (!former) return;
  set<string_view> stays;
  for (const FileRecord& file : next.files) stays.insert(file.name);
  vector<string> names;
  for (const FileRecord& file : former->files)
    if (!stays.contains(file.name)) names.push_back(file.name);
  remove_files(place, names);
}

}  // namespace

void remove_files(const FilePlace& place, const vector<string>& names) {
  SeriesFolders folders(place.folder);
  for (const string& name : names) {
    if (!is_run_file(name)) continue;
    const FileSpot spot = folders.spot(name);
    if (spot.folder >= 0) remove_file({spot.folder, place.path}, spot.name);
  }
}

void remove_leavings(const FilePlace& place, string_view spared) {
  remove_parts(place, spared);
  remove_file(place, failure_file);
  SeriesFolders folders(place.folder);
  for (const string& series : series_folder_names()) {
    const int inner = folders.open(series);
    if (inner < 0) continue;
    remove_parts({inner, place.path + "/" + series});
    if (unlinkat(place.folder, series.c_str(), AT_REMOVEDIR) != 0 && errno != ENOTEMPTY && errno != EEXIST &&
        !is_absent(errno))
      fail("remove", place, series);
  }
}

void publish(const FilePlace& place, Durability durability, const vector<PartFile*>& files, OutputFile& manifest) {
  sync_all(place, durability);
  // This rename is the moment of decision.
  give_name(place.folder, part_name(manifest_name), place, next_manifest);
  manifest.hand_over();
  for (PartFile* file : files) file->hand_over();
  if (durability == Durability::synced) sync_names(place);
  finish_publication(place, durability);
}

void finish_publication(const FilePlace& place, Durability durability) {
  const auto next = read_manifest(place.folder, next_manifest);
  if (!next) return;
  name_parts(place, *next);
  remove_former(place, *next);
  remove_leavings(place, next_manifest);
  if (durability == Durability::synced) sync_names(place);
  give_name(place.folder, next_manifest, place, manifest_name);
  if (durability == Durability::synced) sync_names(place);
}

void settle_folder(const string& path) {
  const Descriptor folder = open_folder(AT_FDCWD, path.empty() ? "." : path, true);
  if (!folder) return;
  struct stat info {};
  if (fstatat(folder.get(), next_manifest, &info, AT_SYMLINK_NOFOLLOW) != 0) {
    if (!is_absent(errno)) fail("read", {folder.get(), path}, next_manifest);
    return;
  }
  if (lock_folder({folder.get(), path}, LockKind::alone)) finish_publication({folder.get(), path}, Durability::synced);
}

}  // namespace carom
