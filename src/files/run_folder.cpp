// Classifies the content of a folder by its manifest, by sizes and hashes of the files, and by the hash of scene.yaml.
// Sizes are compared before hashes, so that a truncated file is found without reading gigabytes.
#include "files/run_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <tuple>

#include "files/folder_names.h"
#include "files/folders.h"
#include "files/manifest.h"
#include "files/mesh_copies.h"
#include "files/publication.h"
#include "files/series_folders.h"
#include "files/stored_file.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"
#include "std.h"
#include "version.h"

namespace carom {
namespace {

/// Calls `check(spot, record)` for each file of the manifest until one fails.
template <typename Check>
bool all_files(int folder, const Manifest& manifest, const Check& check) {
  SeriesFolders folders(folder);
  return all_of(manifest.files, [&](const FileRecord& file) {
    const FileSpot spot = folders.spot(file.name);
    return spot.folder >= 0 && check(spot, file);
  });
}

bool has_size(const FileSpot& spot, const FileRecord& file) {
  return stored_size(spot.folder, spot.name) == file.bytes;
}

bool has_hash(const FileSpot& spot, const FileRecord& file) {
  const auto stored = read_record(spot.folder, spot.name);
  return stored && stored->bytes == file.bytes && stored->sha256 == file.sha256;
}

bool names_all(const Manifest& manifest, const vector<string>& names) {
  return all_of(names, [&](const string& name) {
    const auto has_name = [&](const auto& file) { return file.name == name; };
    return any_of(manifest.files, has_name) || any_of(manifest.left_out, has_name);
  });
}

/// The first entry of a run's folder that neither the manifest nor a former run accounts for, and that `counts`.
string foreign_entry(const FoundFolder& found, const Manifest& manifest,
                     const function<bool(const string& name)>& counts) {
  set<string> known = {manifest_name, failure_file};
  for (const FileRecord& file : manifest.files) known.insert(file.name);
  const auto is_foreign = [&](const string& name) { return !known.contains(name) && counts(name); };

  const vector<string> series = series_folder_names();
  SeriesFolders folders(found.folder.get());
  for (const string& name : found.names) {
    if (is_part_name(name)) continue;
    const int inner = !contains(series, name) ? -1 : folders.open(name);
    if (inner < 0 && is_foreign(name)) return name;
    if (inner < 0) continue;

    // The folder of a series.
    for (const string& entry : folder_names(inner)) {
      string path = name + "/";
      path += entry;
      if (!is_part_name(entry) && is_foreign(path)) return path;
    }
  }
  return {};
}

FolderChanges changes_in(const FoundFolder& found, const Manifest& manifest,
                         const function<bool(const string& name)>& counts) {
  FolderChanges changes;
  // Of an interrupted publication the files are newer than the manifest.
  if (found.has(next_manifest)) return changes;

  changes.foreign = foreign_entry(found, manifest, counts);
  SeriesFolders folders(found.folder.get());

  for (const FileRecord& file : manifest.files) {
    const FileSpot spot = folders.spot(file.name);
    const auto size = spot.folder < 0 ? nullopt : stored_size(spot.folder, spot.name);
    if (!size && changes.missing.empty()) changes.missing = file.name;
    if (!size || (*size == file.bytes && has_hash(spot, file))) continue;
    changes.changed = file.name;
    break;
  }
  return changes;
}

/// Compares sizes before hashes, so that a truncated file is found without reading gigabytes.
bool is_whole(int folder, const Manifest& manifest, const string& outputs, const vector<string>& names) {
  return manifest.version == program_version && manifest.outputs == outputs && names_all(manifest, names) &&
         all_files(folder, manifest, has_size) && all_files(folder, manifest, has_hash);
}

/// Whether the folder has a file of a run by this program that a run with the scene's outputs would not replace.
bool has_more(int folder, const Manifest& manifest, const Scene& scene, const vector<string>& names) {
  if (manifest.version != program_version) return false;
  SeriesFolders folders(folder);
  return any_of(manifest.files, [&](const FileRecord& file) {
    const OutputKind* kind = output_with_series(file.name);
    const bool anew = kind ? kind->asked(scene.output) : contains(names, file.name);
    if (anew) return false;
    const FileSpot spot = folders.spot(file.name);
    return spot.folder >= 0 && stored_size(spot.folder, spot.name).has_value();
  });
}

/// The time of the last change to a file's content, name or owner (ctime). No program can set it back.
optional<timespec> changed(const FileSpot& spot) {
  struct stat info {};
  if (fstatat(spot.folder, spot.name.c_str(), &info, AT_SYMLINK_NOFOLLOW) == 0) return info.st_ctim;
  if (!is_absent(errno)) fail("read", place_of(spot.folder), spot.name);
  return nullopt;
}

bool is_before(const timespec& a, const timespec& b) {
  return tie(a.tv_sec, a.tv_nsec) < tie(b.tv_sec, b.tv_nsec);
}

}  // namespace

bool is_whole_since(const string& path, const string& mark) {
  const timespec marked = changed({AT_FDCWD, mark}).value_or(timespec{});
  const Descriptor folder = open_folder(AT_FDCWD, path, true);
  const auto manifest = folder ? read_manifest(folder.get(), manifest_name) : nullopt;
  if (!manifest || manifest->version != program_version) return false;

  // The manifest itself is no younger than the mark.
  if (!mark.empty()) {
    const optional<timespec> made = changed({folder.get(), manifest_name});
    if (!made || !is_before(*made, marked)) return false;
  }

  const auto unchanged = [&](const FileSpot& spot, const FileRecord& file) {
    const optional<timespec> when = changed(spot);
    return when && has_size(spot, file) && (is_before(*when, marked) || has_hash(spot, file));
  };
  return all_files(folder.get(), *manifest, unchanged);
}

FolderChanges find_changes(const string& path, const function<bool(const string& name)>& counts) {
  const FoundFolder found = find_folder(path);
  auto manifest = found.has(manifest_name) ? read_manifest(found.folder.get(), manifest_name) : nullopt;
  if (!manifest) return {};
  if (!counts) return changes_in(found, *manifest, [](const string&) { return true; });
  std::erase_if(manifest->files, [&](const FileRecord& file) { return !counts(file.name); });
  return changes_in(found, *manifest, counts);
}

string wrong_file(int folder, const Manifest& manifest, const function<bool(string_view name)>& spared) {
  SeriesFolders folders(folder);
  for (const FileRecord& file : manifest.files) {
    if (spared(file.name)) continue;
    const FileSpot spot = folders.spot(file.name);
    if (spot.folder < 0 || !has_size(spot, file) || !has_hash(spot, file)) return file.name;
  }
  return {};
}

string run_again(const string& folder) {
  return "carom run " + folder + "/scene.yaml -o " + folder + " --force runs it again";
}

void sync_file_system(const string& path) {
  const Descriptor folder = open_folder(AT_FDCWD, path, true);
  if (!folder || syncfs(folder.get()) != 0) fail("write", {-1, path}, "");
}

bool FoundFolder::has(const string& name) const {
  return std::binary_search(names.begin(), names.end(), name);
}

FoundFolder find_folder(const string& path) {
  FoundFolder found{open_folder(AT_FDCWD, path.empty() ? "." : path, true), {}, FolderContent::nothing};
  if (!found.folder) {
    if (errno == ENOTDIR) found.content = FolderContent::other_run;
    return found;
  }
  found.names = folder_names(found.folder.get());
  const auto is_leftover = [](const string& name) { return is_part_name(name) || name == failure_file; };
  if (!found.names.empty())
    found.content = all_of(found.names, is_leftover) ? FolderContent::incomplete : FolderContent::other_run;
  return found;
}

FolderContent inspect_folder(const string& path, const Scene& scene, FolderChanges* changes) {
  const vector<string> files = run_files(scene, scene.output);
  const FolderContent content = inspect_folder(path, scene, outputs_text(scene.output), files, changes);
  const bool changed = content == FolderContent::incomplete || content == FolderContent::more;
  if (!changed || scene.output.plots) return content;
  // Charts that were added to a run leave it whole.
  Output charted = scene.output;
  charted.plots = true;
  return inspect_folder(path, scene, outputs_text(charted), files) == FolderContent::this_run ? FolderContent::this_run
                                                                                              : content;
}

FolderContent inspect_folder(const string& path, const Scene& scene, const string& outputs, const vector<string>& files,
                             FolderChanges* changes) {
  const FoundFolder found = find_folder(path);
  const Descriptor& folder = found.folder;
  const string hash = sha256(scene.resolved);

  if (found.has(manifest_name)) {
    const auto manifest = read_manifest(folder.get(), manifest_name);
    if (!manifest || manifest->scene_sha256 != hash || manifest->meshes != meshes_text(scene)) {
      return FolderContent::other_run;
    }
    if (is_whole(folder.get(), *manifest, outputs, files)) return FolderContent::this_run;

    const auto is_written = [&](const string& name) {
      const OutputKind* kind = output_with_series(name);
      return kind ? kind->asked(scene.output) : contains(files, name);
    };

    FolderChanges its = changes_in(found, *manifest, is_written);
    if (!its.changed.empty() || !its.foreign.empty()) {
      if (changes != nullptr) *changes = std::move(its);
      return FolderContent::touched;
    }
    return has_more(folder.get(), *manifest, scene, files) ? FolderContent::more : FolderContent::incomplete;
  }

  if (found.has("scene.yaml")) {
    const auto stored = read_record(folder.get(), "scene.yaml");
    return stored && stored->sha256 == hash ? FolderContent::incomplete : FolderContent::other_run;
  }

  // Incomplete: a run that was killed before its first file was complete, or that failed.
  return found.content;
}

}  // namespace carom
