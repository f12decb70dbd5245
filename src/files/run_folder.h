#pragma once
// The folder that a run writes: what is in it already, and files that appear whole or not at all.
#include <stdexcept>
#include <string>
#include <vector>

#include "files/output_file.h"

namespace carom {

struct Scene;

/// Writing cannot go on, or must not begin. The text is for the user.
struct ExportError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Whether what was written outlasts a power cut once it has its name. Not synced, it may be lost then, which a reader
/// sees by size and hash; of many small runs the caller syncs the file system now and then (sync_file_system).
enum class Durability { synced, deferred };

/// All that was written to the file system of `path`, to the disk. Throws ExportError.
void sync_file_system(const std::string& path);

/// What a failed run of a sweep leaves in its folder: the reason, one text.
inline constexpr const char* failure_file = "error.txt";

enum class FolderContent {
  nothing,     // it is not there, or empty
  this_run,    // this very run, by the same tool, whole: every file of the manifest has its size and hash
  incomplete,  // this scene's, not whole: a run that was interrupted, or fewer outputs of the same scene; or a failure
  more,        // this scene's, with outputs that this run does not write and would remove
  other_run    // another scene's run, or files that no run wrote
};

/// Whether the run in `folder` is whole, as its manifest says: every file of its size, and of its hash too if anything
/// about it has changed since the file `mark` was written. A run that was made since then is not, whatever its manifest
/// says. `mark`: a path, empty: every hash counts; what was written within the same clock tick counts as changed.
bool is_whole_since(const std::string& folder, const std::string& mark);

struct Manifest;

/// The first of the manifest's files, pictures aside, that is not there in its size and with its hash; empty: none.
std::string wrong_file(int folder, const Manifest& manifest);

/// A folder as it is found.
struct FoundFolder {
  Descriptor folder;               // open; none: there is none, or it is no folder
  std::vector<std::string> names;  // what is in it, sorted
  FolderContent content;           // as far as names tell: nothing, parts or a failure alone (incomplete), other_run
  bool has(const std::string& name) const;
};
/// Throws ExportError where it is there and cannot be opened.
FoundFolder look_into(const std::string& folder);

/// What stands in `folder`, read from its manifest.json. Changes nothing.
FolderContent inspect_folder(const std::string& folder, const Scene& scene);
/// The same for what is no run: `outputs` as in its manifest, `files` that it must have.
FolderContent inspect_folder(const std::string& folder, const Scene& scene, const std::string& outputs,
                             const std::vector<std::string>& files);

}  // namespace carom
