// A run's folder under an exclusive flock, from before the first file until the last one has its name.
// At every moment the folder is in a state that inspect_folder classifies correctly, even if the process is killed.
// The manifest is therefore moved aside before the files that it names are removed.
// The file scene.yaml marks an unfinished run, so it is written first and removed last.
#include "files/folder_writer.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "files/checkpoint_file.h"
#include "files/folder_names.h"
#include "files/manifest.h"
#include "files/publication.h"
#include "files/series_folders.h"
#include "files/stored_file.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

/// The name of a manifest while its files are removed, so that an interrupted removal can continue.
constexpr const char* former_manifest = ".manifest.json.former";

void add_files(vector<string>& names, const optional<Manifest>& manifest) {
  if (!manifest) return;
  for (const FileRecord& file : manifest->files) names.push_back(file.name);
}

/// Adds the files that an interrupted run of this scene may have left without a manifest that names them.
void add_remains(vector<string>& names, int folder, const Scene& scene) {
  Output all = with_all(scene.output);
  using Format = TablesOutput::Format;
  for (const Format format : {Format::csv, Format::gzip, Format::xlsx}) {
    all.tables.format = format;
    for (string& name : run_files(scene, all)) names.push_back(std::move(name));
  }
  names.insert(names.end(), bench_files.begin(), bench_files.end());
  SeriesFolders folders(folder);
  for (const string& series : series_folder_names())
    if (const int inner = folders.open(series); inner >= 0)
      for (const string& name : folder_names(inner)) names.push_back(series + "/" + name);
}

}  // namespace

void remove_files_of_run(const FilePlace& place) {
  const int folder = place.folder;
  vector<string> names;
  for (const char* manifest : {manifest_name, former_manifest, next_manifest})
    add_files(names, read_manifest(folder, manifest));
  if (names.empty() && stored_size(folder, "scene.yaml")) add_remains(names, folder, Scene());
  std::erase(names, "scene.yaml");
  // scene.yaml is removed last. Until then the folder is recognised as an unfinished run.
  remove_file(place, next_manifest);
  remove_file(place, manifest_name);
  remove_files(place, names);
  remove_leavings(place);
  remove_file(place, former_manifest);
  remove_file(place, "scene.yaml");
}

FolderWriter::FolderWriter(const string& path, Durability durability) : durability_(durability) {
  place_.path = path.empty() ? "." : path;
  while (place_.path.size() > 1 && place_.path.ends_with('/')) place_.path.pop_back();

  // Make the folders above.
  std::error_code error;
  const auto parent = std::filesystem::path(place_.path).parent_path();
  if (!parent.empty()) std::filesystem::create_directories(parent, error);
  if (error) fail("make", {-1, parent.string()}, "", error.message());

  try {
    lock();
    finish_publication(place_, durability_);
  } catch (...) {
    if (made_) rmdir(place_.path.c_str());
    throw;
  }
}

void FolderWriter::lock() {
  // A run that fails removes the folder that it made. A run that had just opened that folder makes it again.
  for (int attempt = 0; attempt < 10; ++attempt) {
    made_ = mkdir(place_.path.c_str(), 0777) == 0;
    if (!made_ && errno != EEXIST) fail("make", place_, "");

    folder_ = open_folder(AT_FDCWD, place_.path, true);
    if (!folder_ && errno == ENOENT) continue;
    if (!folder_) fail("open", place_, "");
    place_.folder = folder_.get();

    if (!lock_folder(place_, LockKind::alone))
      fail("write", place_, "", "another run is writing into it; wait for it, or name another folder with -o");

    // Whether it has been removed meanwhile.
    struct stat info {};
    if (fstat(folder_.get(), &info) != 0) fail("open", place_, "");
    if (info.st_nlink > 0) return;
    folder_.reset();
  }
  fail("open", place_, "", "it is a dangling link, or another program removes it");
}

FolderWriter::~FolderWriter() {
  if (renews_) {
    first_files_.clear();
    // Nothing was committed, so the remaining temporary folders are removed.
    for (const string& series : series_folder_names()) try_to_remove(place_.folder, part_name(series));
    return;
  }
  if (has_checkpoint(place_) || committed_) return;
  if (!begun_.empty()) remove_own_parts();
  if (keep_) return;
  if (!begun_.empty()) {
    for (const string& series : series_folder_names())
      // Succeeds only if the folder is empty.
      unlinkat(place_.folder, series.c_str(), AT_REMOVEDIR);
  }
  for (const FileRecord& file : begun_) unlinkat(place_.folder, file.name.c_str(), 0);
  if (made_) rmdir(place_.path.c_str());
}

/// Those that a checkpoint counted on.
void FolderWriter::remove_own_parts() const {
  try {
    remove_parts(place_);
  } catch (const ExportError&) {
    // The next run removes them.
  }
}

/// Refuses in advance what would make the renaming fail: a folder in a file's place, or a file in a series' place.
void FolderWriter::refuse_folders(const Scene& scene) const {
  for (const string& name : run_files(scene, scene.output)) refuse_folder(place_, name);
  for (const OutputKind& kind : output_kinds()) {
    if (kind.series.folder.empty() || !kind.asked(scene.output)) continue;
    const string series(kind.series.folder);
    if (!open_folder(place_.folder, series, false) && errno != ENOENT)
      fail("open", place_, series, "it is not a folder, or a link; remove it");
  }
}

/// Writes one of the first files.
void FolderWriter::put(const string& name, const string& bytes) {
  OutputFile file(place_, name);
  file.write(bytes);
  file.publish();
  begun_.push_back(file.record());
}

vector<FileRecord> FolderWriter::begin(const Scene& scene, const vector<MeshCopy>& meshes) {
  refuse_folders(scene);
  const int folder = place_.folder;

  // The files that former runs have left.
  vector<string> names;
  const auto manifest = read_manifest(folder, manifest_name);
  add_files(names, manifest);
  add_files(names, read_manifest(folder, former_manifest));
  const auto stored_scene = read_record(folder, "scene.yaml");
  const bool is_scenes = stored_scene && stored_scene->sha256 == sha256(scene.resolved);
  if (!manifest && (is_scenes || has_checkpoint(place_))) add_remains(names, folder, scene);
  std::erase(names, "scene.yaml");

  // The order is essential. First the folder stops being a complete run.
  // Then it becomes an unfinished run of this scene. Then the old files are removed.
  if (manifest)
    give_name(folder, manifest_name, place_, former_manifest);
  else
    remove_file(place_, manifest_name);
  put("scene.yaml", scene.resolved);
  remove_files(place_, names);
  remove_leavings(place_);
  remove_file(place_, former_manifest);

  for (const MeshCopy& mesh : meshes) put(mesh.name, mesh.bytes);
  return begun_;
}

vector<FileRecord> FolderWriter::go_on(const Scene& scene, const vector<MeshCopy>& meshes) {
  refuse_folders(scene);
  put("scene.yaml", scene.resolved);
  for (const MeshCopy& mesh : meshes) put(mesh.name, mesh.bytes);
  place_.goes_on = true;
  return begun_;
}

vector<FileRecord> FolderWriter::renew(const Scene& scene, const vector<MeshCopy>& meshes) {
  refuse_folders(scene);
  renews_ = true;
  remove_leavings(place_);

  vector<FileRecord> records;
  const auto put = [&](const string& name, const string& bytes) {
    OutputFile& file = *first_files_.emplace_back(make_unique<OutputFile>(place_, name));
    file.write(bytes);
    file.complete();
    records.push_back(file.record());
  };

  put("scene.yaml", scene.resolved);
  for (const MeshCopy& mesh : meshes) put(mesh.name, mesh.bytes);
  return records;
}

FilePlace FolderWriter::series(const FileSeries& series) {
  const string name = renews_ ? part_name(series.folder) : string(series.folder);
  series_.push_back(make_folder(place_, name));
  return {series_.back().get(), place_.path + "/" + name};
}

void FolderWriter::publish(vector<PartFile*> files, OutputFile& manifest) {
  for (const auto& file : first_files_) files.push_back(file.get());
  try {
    carom::publish(place_, durability_, files, manifest);
  } catch (...) {
    // Otherwise all new files are removed.
    if (manifest.is_handed_over()) commit();
    throw;
  }
  commit();
}

}  // namespace carom
