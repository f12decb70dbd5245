#pragma once
// The folder that a run writes: its present content, and whether files in it are complete.

#include "files/file_place.h"
#include "std.h"

namespace carom {

struct Scene;

/// The command that makes the run in `folder` anew, as the second line of an error.
string run_again(const string& folder);

/// Writes all pending data of the file system of `path` to disk. Throws ExportError.
void sync_file_system(const string& path);

enum class FolderContent {
  nothing,  // absent or empty
  /// A complete run of this very request by the same program. Every file of the manifest has its size and hash.
  this_run,
  /// An incomplete run of this scene: interrupted, failed, or with fewer outputs.
  incomplete,
  /// A run of this scene with outputs that this run does not write and would remove.
  more,
  /// A complete run of the same scene file before that was edited, and nothing else (earlier_run.h).
  earlier,
  /// A run of this scene with a file that was changed since, or with a foreign one in the place of a file to write.
  touched,
  /// A run of another scene, or files that no run wrote.
  other_run
};

/// Whether the run in `folder` is complete according to its manifest. Every file must have its size.
/// A file changed since the file `mark` was written must also have its hash.
/// A run made since then is not complete, whatever its manifest holds.
/// `mark`: a path. Empty: every hash is checked. A change within the same clock tick counts as a change.
bool is_whole_since(const string& folder, const string& mark);

struct Manifest;

/// How a folder differs from its manifest: the first of each sort. A folder whose publication was interrupted does not.
struct FolderChanges {
  string changed;  // a file with another size or hash
  string missing;  // a file that is absent, or no file
  string foreign;  // an entry that the run did not write
  bool any() const { return !changed.empty() || !missing.empty() || !foreign.empty(); }
};
/// Reads every file of the manifest up to the first changed one. Changes nothing. Throws ExportError.
/// `counts`: the names to look at. None: all.
FolderChanges find_changes(const string& folder, const function<bool(const string& name)>& counts = nullptr);

/// The first of the manifest's files that lacks its size or hash. Empty: none. `spared`: files that may.
string wrong_file(int folder, const Manifest& manifest, const function<bool(string_view name)>& spared);

/// A folder as found.
struct FoundFolder {
  Descriptor folder;     // none: absent, or no folder
  vector<string> names;  // its entries, sorted
  /// As far as names show: nothing, incomplete (only temporary files or a failure), or other_run.
  FolderContent content;
  bool has(const string& name) const;
};
/// Throws ExportError if the folder exists and cannot be opened.
FoundFolder find_folder(const string& folder);

/// The content of `folder`, from its manifest.json. Changes nothing. A run with charts besides is this_run too.
/// `changes`: may be null; of a touched run what was changed.
FolderContent inspect_folder(const string& folder, const Scene& scene, FolderChanges* changes = nullptr);
/// The same for a folder that is not a run's. `outputs`: as in its manifest. `files`: those it must have.
FolderContent inspect_folder(const string& folder, const Scene& scene, const string& outputs,
                             const vector<string>& files, FolderChanges* changes = nullptr);

}  // namespace carom
