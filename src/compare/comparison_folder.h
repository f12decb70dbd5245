#pragma once
// The folder of a comparison: its present content, and its files.

#include "compare/comparison.h"
#include "export/side_by_side.h"
#include "files/folder_writer.h"
#include "files/run_folder.h"
#include "std.h"

namespace carom {

inline constexpr const char* comparison_film_name = "comparison.mp4";

/// The request of a comparison as JSON: the runs (by their digest), measures, charts, film.
string request_text(const ComparisonPlan& plan, const string& runs, bool video);

/// The content of a folder. this_run: this very comparison, complete. incomplete: any other comparison, to be replaced.
/// touched: one with a file that was changed since, or a foreign one in the place of its files; `changes` names it.
FolderContent inspect_comparison_folder(const string& folder, const string& request, FolderChanges& changes);

/// How the comparison in a folder, perhaps a sweep's, differs from what was written. Other files do not count.
FolderChanges changes_of_comparison(const string& folder);

/// "a comparison with a changed file, summary.csv": what must not be overwritten. Empty: nothing.
string comparison_obstacle(const FolderChanges& changes);

class ComparisonFolder {
 public:
  /// Makes and locks the folder. Its content stays until publish().
  /// Throws ExportError, as all functions of this class do.
  explicit ComparisonFolder(const string& path) : folder_(path) {}
  const FilePlace& place() const { return folder_.place(); }
  /// Renames the files, removes obsolete ones of a former comparison, and writes the manifest last.
  /// `film`: may be null.
  void publish(const vector<unique_ptr<OutputFile>>& files, SideBySide* film, const string& request);

 private:
  FolderWriter folder_;
};

}  // namespace carom
