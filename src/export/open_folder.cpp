#include "export/open_folder.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <optional>
#include <system_error>
#include <vector>

#include "export/folder_names.h"
#include "export/manifest.h"
#include "export/run_folder.h"
#include "export/series_folders.h"
#include "export/stored_file.h"

namespace carom {
namespace {

/// Where a manifest is kept while the files that it names are removed, so that an interrupted removal can go on.
constexpr const char* former_manifest = ".manifest.json.former";

/// Removes the named files of a run, but for scene.yaml. What cannot be removed will be told when it is written anew.
void remove_files(int folder, const std::vector<std::string>& names) {
  SeriesFolders folders(folder);
  for (const std::string& name : names) {
    if (!is_run_file(name) || name == "scene.yaml") continue;
    const FileSpot spot = folders.spot(name);
    if (spot.folder >= 0) unlinkat(spot.folder, spot.name.c_str(), 0);
  }
}

void remove_parts(int folder) {
  for (const std::string& name : folder_names(folder))
    if (is_part_name(name)) remove_entry(folder, name);
}

/// Parts of files, why a run failed, and series' folders without files.
void remove_leavings(int folder) {
  remove_parts(folder);
  unlinkat(folder, failure_file, 0);
  SeriesFolders folders(folder);
  for (const std::string& series : series_folder_names()) {
    const int inner = folders.open(series);
    if (inner < 0) continue;
    remove_parts(inner);
    unlinkat(folder, series.c_str(), AT_REMOVEDIR);  // if it is empty
  }
}

void add_files(std::vector<std::string>& names, const std::optional<Manifest>& manifest) {
  if (!manifest) return;
  for (const FileRecord& file : manifest->files) names.push_back(file.name);
}

/// The files that an interrupted run of this scene may have left without a manifest that names them.
void add_remains(std::vector<std::string>& names, int folder, const Scene& scene) {
  for (std::string& name : run_files(scene, with_all(scene.output))) names.push_back(std::move(name));
  names.insert(names.end(), bench_files.begin(), bench_files.end());
  SeriesFolders folders(folder);
  for (const std::string& series : series_folder_names())
    if (const int inner = folders.open(series); inner >= 0)
      for (const std::string& name : folder_names(inner)) names.push_back(series + "/" + name);
}

}  // namespace

Descriptor open_folder(int parent, const std::string& name, bool follow) {
  return Descriptor(openat(parent, name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | (follow ? 0 : O_NOFOLLOW)));
}

void remove_files_of_run(int folder) {
  std::vector<std::string> names;
  add_files(names, read_manifest(folder, manifest_name));
  add_files(names, read_manifest(folder, former_manifest));
  if (names.empty() && stored_size(folder, "scene.yaml")) add_remains(names, folder, Scene());
  // scene.yaml last: until then the folder is known to be an unfinished run.
  unlinkat(folder, manifest_name, 0);
  remove_files(folder, names);
  remove_leavings(folder);
  unlinkat(folder, former_manifest, 0);
  unlinkat(folder, "scene.yaml", 0);
}

OpenFolder::OpenFolder(const std::string& path, Durability durability) : durability_(durability) {
  place_.path = path.empty() ? "." : path;
  while (place_.path.size() > 1 && place_.path.ends_with('/')) place_.path.pop_back();
  std::error_code error;
  const auto parent = std::filesystem::path(place_.path).parent_path();
  if (!parent.empty()) std::filesystem::create_directories(parent, error);
  if (error) fail("make", {-1, parent.string()}, "", error.message());
  // A run that fails removes the folder that it made; another one may just have opened it then. So: again.
  for (int attempt = 0; attempt < 10; ++attempt) {
    made_ = mkdir(place_.path.c_str(), 0777) == 0;
    if (!made_ && errno != EEXIST) fail("make", place_, "");
    folder_ = open_folder(AT_FDCWD, place_.path, true);
    if (!folder_ && errno == ENOENT) continue;
    if (!folder_) fail("open", place_, "");
    // A file system that knows no locks (some network ones) is used without.
    if (flock(folder_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      fail("write", place_, "", "another run is writing into it; wait for it, or name another folder with -o");
    struct stat info {};
    if (fstat(folder_.get(), &info) == 0 && info.st_nlink > 0) break;
    folder_.reset();
  }
  if (!folder_) fail("open", place_, "", "it is a link to nothing, or something else removes it");
  place_.folder = folder_.get();
}

OpenFolder::~OpenFolder() {
  if (renews_) {
    first_files_.clear();
    remove_parts(place_.folder);
    return;
  }
  if (keep_) return;
  if (!begun_.empty()) {
    for (const std::string& series : series_folder_names())
      unlinkat(place_.folder, series.c_str(), AT_REMOVEDIR);  // if it is empty
  }
  for (const FileRecord& file : begun_) unlinkat(place_.folder, file.name.c_str(), 0);
  if (made_) rmdir(place_.path.c_str());
}

std::vector<FileRecord> OpenFolder::begin(const Scene& scene, const std::vector<MeshCopy>& meshes) {
  const int folder = place_.folder;
  std::vector<std::string> names;
  const auto manifest = read_manifest(folder, manifest_name);
  const auto former = read_manifest(folder, former_manifest);
  add_files(names, manifest);
  add_files(names, former);
  const auto stored_scene = read_record(folder, "scene.yaml");
  if (!manifest && stored_scene && stored_scene->sha256 == sha256(scene.resolved)) add_remains(names, folder, scene);

  // First of all the folder stops being a whole run; then it becomes an unfinished one of this scene; then the old
  // goes.
  const bool gone = manifest ? renameat(folder, manifest_name, folder, former_manifest) == 0
                             : unlinkat(folder, manifest_name, 0) == 0 || errno == ENOENT;
  if (!gone) fail("replace", place_, manifest_name);
  const auto put = [&](const std::string& name, const std::string& bytes) {
    OutputFile file(place_, name);
    file.write(bytes);
    file.publish();
    begun_.push_back(file.record());
  };
  put("scene.yaml", scene.resolved);
  remove_files(folder, names);
  remove_leavings(folder);
  unlinkat(folder, former_manifest, 0);
  for (const MeshCopy& mesh : meshes) put(mesh.name, mesh.bytes);
  return begun_;
}

std::vector<FileRecord> OpenFolder::renew(const Scene& scene, const std::vector<MeshCopy>& meshes,
                                          const std::vector<FileRecord>& kept) {
  renews_ = true;
  remove_leavings(place_.folder);
  for (const FileRecord& file : kept) kept_.push_back(file.name);
  std::vector<FileRecord> records;
  const auto put = [&](const std::string& name, const std::string& bytes) {
    OutputFile& file = *first_files_.emplace_back(std::make_unique<OutputFile>(place_, name));
    file.write(bytes);
    file.complete();
    records.push_back(file.record());
  };
  put("scene.yaml", scene.resolved);
  for (const MeshCopy& mesh : meshes) put(mesh.name, mesh.bytes);
  return records;
}

/// The folder stops being a whole run, then its files go, but for those that are kept; scene.yaml is replaced before
/// that, so that the folder is known to be an unfinished run of the new scene.
void OpenFolder::remove_former() {
  const int folder = place_.folder;
  std::vector<std::string> names;
  add_files(names, read_manifest(folder, manifest_name));
  if (renameat(folder, manifest_name, folder, former_manifest) != 0) fail("replace", place_, manifest_name);
  first_files_.front()->publish();
  std::erase_if(names,
                [&](const std::string& name) { return std::find(kept_.begin(), kept_.end(), name) != kept_.end(); });
  remove_files(folder, names);
  for (const auto& file : first_files_)
    if (file != first_files_.front()) file->publish();
}

/// Gives the files of series their places.
void OpenFolder::move_series() {
  for (const std::string& series : series_folder_names()) {
    const Descriptor from = open_folder(place_.folder, part_name(series), false);
    if (!from) continue;
    const FilePlace place{-1, place_.path + "/" + series};
    if (mkdirat(place_.folder, series.c_str(), 0777) != 0 && errno != EEXIST) fail("make", place, "");
    const Descriptor to = open_folder(place_.folder, series, false);
    if (!to) fail("open", place, "");
    for (const std::string& name : folder_names(from.get()))
      if (renameat(from.get(), name.c_str(), to.get(), name.c_str()) != 0) fail("write", place, name);
  }
}

FilePlace OpenFolder::series(const FileSeries& series) {
  const std::string name = renews_ ? part_name(series.folder) : std::string(series.folder);
  const FilePlace place{-1, place_.path + "/" + name};
  if (mkdirat(place_.folder, name.c_str(), 0777) != 0 && errno != EEXIST) fail("make", place, "");
  Descriptor folder = open_folder(place_.folder, name, false);
  const bool other = !folder && (errno == ENOTDIR || errno == ELOOP);
  if (!folder) fail("open", place, "", other ? "it is no folder, or a link; remove it" : "");
  series_.push_back(std::move(folder));
  return {series_.back().get(), place.path};
}

void OpenFolder::publish(const std::vector<OutputFile*>& files, OutputFile& manifest,
                         const std::function<void()>& others) {
  sync_all();
  keep();
  if (renews_) {
    remove_former();
    move_series();
  }
  for (OutputFile* file : files) file->publish();
  if (others) others();
  sync_names();
  manifest.publish();
  sync_names();
  if (renews_) remove_leavings(place_.folder);
  if (renews_) unlinkat(place_.folder, former_manifest, 0);
}

void OpenFolder::sync_all() {
  if (durability_ == Durability::deferred) return;
  if (syncfs(place_.folder) != 0) fail("write", place_, "");
}

void OpenFolder::sync_names() {
  if (durability_ == Durability::deferred) return;
  // Some file systems cannot sync a folder, and need not.
  if (fsync(place_.folder) != 0 && errno != EINVAL && errno != ENOTSUP) fail("write", place_, "");
}

}  // namespace carom
