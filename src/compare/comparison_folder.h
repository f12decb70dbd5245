#pragma once
// The folder of a comparison: what is in it already, and the files that a comparison leaves there.
#include <memory>
#include <string>
#include <vector>

#include "compare/comparison.h"
#include "export/side_by_side.h"
#include "files/open_folder.h"
#include "files/run_folder.h"

namespace carom {

inline constexpr const char* comparison_film_name = "comparison.mp4";

/// What a comparison was asked for, as JSON: the runs (by their digest), measures, charts, film.
std::string request_text(const ComparisonPlan& plan, const std::string& runs, bool video);

/// What stands in a folder: of this very comparison, whole: this_run; of any other comparison: incomplete, to be
/// replaced.
FolderContent inspect_comparison_folder(const std::string& folder, const std::string& request);

class ComparisonFolder {
 public:
  /// Makes and locks the folder; what is in it stays until publish(). Throws ExportError, as all of this class does.
  explicit ComparisonFolder(const std::string& path) : folder_(path) {}
  const FilePlace& place() const { return folder_.place(); }
  /// Names the files, removes those of a former comparison that are no more, and writes the manifest last. `film`: may
  /// be null.
  void publish(const std::vector<std::unique_ptr<OutputFile>>& files, SideBySide* film, const std::string& request);

 private:
  OpenFolder folder_;
};

}  // namespace carom
