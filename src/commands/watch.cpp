// A round plans and runs the scenes of which a file has changed. Files are stamped before a round, so that a save
// during it leads to another one.
#include "commands/watch.h"

#include <fmt/format.h>

#include <iterator>

#include "commands/batch.h"
#include "commands/file_watch.h"
#include "commands/interrupt.h"
#include "commands/plan.h"
#include "commands/report.h"
#include "commands/scene_files.h"
#include "commands/text.h"
#include "std.h"

namespace carom {

namespace {

class WatchSession {
 public:
  explicit WatchSession(const Options& options) : options_(options), files_(options.operands.size()) {}

  int go() {
    if (contains(options_.operands, standard_input))
      throw UsageError("--watch needs a file, and standard input is none", "write the scene to a file and name that");
    set<string> changed(options_.operands.begin(), options_.operands.end());
    for (size_t i = 0; i < files_.size(); ++i) files_[i] = {options_.operands[i]};
    watch_.follow(changed);
    while (true) {
      if (const int code = round(changed); code > 2) return code;
      flush_out();
      remark(options_, fmt::format("waiting for changes of {}; Ctrl-C ends", listed(watched(), names_shown)));
      changed = watch_.changed(stop_if_interrupted);
    }
  }

 private:
  static constexpr size_t names_shown = 6;

  /// Gives the exit code of the runs.
  int round(const set<string>& changed) {
    vector<PlannedScene> scenes = named_scenes(options_), affected;
    vector<size_t> numbers;
    for (size_t i = 0; i < scenes.size(); ++i) {
      if (none_of(files_[i], [&](const auto& file) { return changed.contains(file); })) continue;
      numbers.push_back(i);
      affected.push_back(std::move(scenes[i]));
    }

    affected = plan_scenes(std::move(affected), options_, Purpose::run,
                           [&](PlannedScene& planned) { renew_pictures(planned, changed); });
    for (size_t k = 0; k < affected.size(); ++k) files_[numbers[k]] = files_of_scene(affected[k]);
    follow();
    refuse_other_content(affected, options_);
    return run(std::move(affected));
  }

  /// Scenes with errors do not keep the others from running.
  int run(vector<PlannedScene> scenes) const {
    vector<PlannedScene> right;
    for (PlannedScene& planned : scenes) {
      if (planned.errors == 0) {
        right.push_back(std::move(planned));
        continue;
      }
      write_err(planned.error);
      complain(options_,
               fmt::format("{}: {}; not run", printable(planned.file), counted(planned.errors, "error", "errors")));
    }
    return right.empty() ? 0 : run_planned(options_, std::move(right));
  }

  /// Textures and materials are not among what makes a run up to date.
  static void renew_pictures(PlannedScene& planned, const set<string>& changed) {
    if (planned.found.content != FolderContent::this_run || !planned.scene || !planned.scene->output.pictures()) return;
    const set<string> files = files_of_scene(planned);
    if (any_of(files, [&](const auto& file) { return file != planned.file && changed.contains(file); }))
      planned.found.content = FolderContent::incomplete;
  }

  void follow() {
    set<string> all;
    for (const auto& files : files_) all.insert(files.begin(), files.end());
    watch_.follow(all);
  }

  vector<string> watched() const {
    vector<string> names;
    for (const string& scene : options_.operands) names.push_back(printable(scene));
    size_t others = 0;
    for (const auto& files : files_) others += files.size() - 1;
    if (others > 0) names.push_back(counted(others, "other file", "other files"));
    return names;
  }

  const Options& options_;
  vector<set<string>> files_;  // by scene
  FileWatch watch_;
};

}  // namespace

int watch_scenes(const Options& options) {
  if (options.json) throw UsageError("--watch has no end that a JSON document could wait for", "leave out --json");
  return WatchSession(options).go();
}

}  // namespace carom
