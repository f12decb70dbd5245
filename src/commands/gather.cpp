// Finds each run in the sweep's folder or in one of the other folders, and copies it if necessary. The comparison is
// then that of an undivided sweep.
#include "commands/commands.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "commands/error_list.h"
#include "commands/interrupt.h"
#include "commands/plan.h"
#include "commands/progress.h"
#include "commands/report.h"
#include "commands/sweep_report.h"
#include "commands/sweep_setup.h"
#include "commands/text.h"
#include "compare/comparison_folder.h"
#include "files/copied_run.h"
#include "files/failed_run.h"
#include "files/folder_writer.h"
#include "files/publication.h"
#include "files/stored_file.h"
#include "std.h"
#include "study/sweep_folder.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

constexpr uint64_t largest_text = 1 << 30;  // bytes
constexpr size_t parts_shown = 10;

class GatherSession {
 public:
  explicit GatherSession(const Options& options) : options_(options), folder_(options.operands.front()) {}

  int go() {
    settle_folder(folder_);
    const string source = has_sweep(folder_) ? folder_ : options_.operands.back();
    if (!has_sweep(source)) {
      return refuse(fmt::format("{} holds no sweep: there is no {} in it", printable(source), stored_sweep));
    }

    try {
      const Sweep sweep = load_sweep(source + "/" + stored_sweep);
      const auto base = text_of(source, stored_base);
      if (!base || text_of(source, stored_sweep) != sweep.resolved(stored_base))
        return refuse(fmt::format("{}/{} was not written by a sweep", printable(source), stored_sweep));

      for (const auto& [id, errors] : stored_skips(source)) skipped_.insert(id);
      skipped_text_ = text_of(source, stored_skipped).value_or("");

      if (inspect_sweep_folder(folder_, sweep, *base) == SweepContent::other)
        return refuse(fmt::format("the folder {} holds something else", printable(folder_)));
      for (size_t i = 1; i < options_.operands.size(); ++i) refuse_other(options_.operands[i], sweep, *base);
      return gather(sweep, *base);
    } catch (const SceneError& error) {
      write_err(error.what());
      return refuse("this was not written by a sweep", error.records);
    }
  }

 private:
  int refuse(const string& what) const { return refuse(what, error_of_text(what)); }

  int refuse(const string& what, const vector<ErrorRecord>& errors) const {
    return print_refusal(options_, what + "; nothing was gathered", {{"folder", folder_}}, errors);
  }

  static bool has_sweep(const string& folder) { return what_stands(folder + "/" + stored_sweep) != Standing::nothing; }

  static optional<string> text_of(const string& folder, const char* name) {
    const Descriptor place = open_folder(AT_FDCWD, folder, true);
    return place ? read_text(place.get(), name, largest_text) : nullopt;
  }

  void refuse_other(const string& folder, const Sweep& sweep, const string& base) const {
    if (text_of(folder, stored_sweep) == sweep.resolved(stored_base) && text_of(folder, stored_base) == base) return;
    throw UsageError(fmt::format("{} holds no part of the sweep in {}", printable(folder), printable(folder_)),
                     "gather parts of one sweep");
  }

  int gather(const Sweep& sweep, const string& base) {
    if (const string changed = comparison_obstacle(changes_of_comparison(folder_)); !changed.empty())
      return refuse(fmt::format("the folder {} holds {}: remove it or rename it", printable(folder_), changed));
    SweepFolder folder(folder_, SweepFolder::Use::exclusive, sweep, base, skipped_text_, stop_if_interrupted);
    Progress progress(options_, printable(name_of_folder(folder_)));

    // Which runs each folder has.
    vector<vector<bool>> whole;  // by folder, run
    for (const string& place : options_.operands) whole.push_back(whole_runs(sweep, place, base));
    if (const string edited = edited_run(sweep, whole.front()); !edited.empty()) {
      progress.clear();
      return refuse(edited + ": remove it or rename it");
    }

    // Each run, copied if it is not here.
    vector<RunStatus> statuses;
    vector<string> missing, failed;
    for (size_t number = 0; number < sweep.size(); ++number) {
      stop_if_interrupted();
      if (skipped_.contains(sweep.id(number))) {
        statuses.push_back(RunStatus::left_out);
        continue;
      }

      const auto has = ranges::find_if(whole, [&](const auto& runs) { return runs[number]; });
      statuses.push_back(bring(sweep.id(number), size_t(has - whole.begin())));
      if (statuses.back() == RunStatus::missing) missing.push_back(sweep.id(number));
      if (statuses.back() == RunStatus::failed) failed.push_back(sweep.id(number));
      progress.update(number, 2 * sweep.size(), "runs checked or compared");
    }

    if (!missing.empty()) {
      progress.clear();
      complain(options_,
               fmt::format("{}: {} of {} missing: {}\n  run the parts with these runs again", printable(folder_),
                           missing.size(), counted(sweep.size(), "run is", "runs are"), listed(missing, parts_shown)));
      return end("incomplete", sweep, missing, failed);
    }

    // The comparison of all.
    ComparisonWatch watch;
    watch.stop_check = stop_if_interrupted;
    watch.done = [&](size_t done) {
      progress.update(sweep.size() + done, 2 * sweep.size(), "runs checked or compared");
    };
    watch.doubtful = [&](size_t runs) { doubtful_ = runs; };
    folder.finish(sweep, statuses, watch);

    progress.clear();
    if (!failed.empty())
      complain(options_,
               fmt::format("{} failed: {}", counted(failed.size(), "run", "runs"), listed(failed, parts_shown)));
    return end("done", sweep, missing, failed);
  }

  /// A run of the ended sweep here that was changed since, in words. Empty: there is none. `whole`: flags of those
  /// here.
  string edited_run(const Sweep& sweep, const vector<bool>& whole) const {
    const size_t ended = is_ended_sweep(folder_) ? sweep.size() : 0;
    for (size_t number = 0; number < ended; ++number) {
      if (whole[number]) continue;
      const string run = fmt::format("{}/runs/{}", folder_, sweep.id(number));
      if (const FolderChanges changes = find_changes(run); !changes.changed.empty())
        return fmt::format("the folder {} holds {}", printable(run), obstacle_of(changes));
    }
    return {};
  }

  /// Flags of the sweep's runs that are whole in a folder.
  vector<bool> whole_runs(Sweep sweep, const string& folder, const string& base) const {
    vector<bool> whole(sweep.size());
    // Meshes and former runs lie where the sweep ran: a run that cannot be checked against its scene is taken as it is.
    if (may_read_files(sweep, base)) {
      for (size_t number = 0; number < sweep.size(); ++number)
        whole[number] = is_whole_since(fmt::format("{}/runs/{}", folder, sweep.id(number)), "");
      return whole;
    }

    // All others are planned as a sweep is, which finds those that are done.
    sweep.base = folder + "/" + stored_base;
    Options all = options_;
    all.shard = Shard{};
    SweepSettings settings = sweep_settings(all);
    settings.load.budget.enforced = false;
    SweepJob job(std::move(sweep), folder, std::move(settings));
    job.plan([](const SweepProgress&) {});

    for (size_t number = 0; number < whole.size(); ++number)
      whole[number] = job.runs()[number].status == RunStatus::done;
    return whole;
  }

  /// A run's status here, copied if necessary from folder `from` of the operands; `from` is their number if none has
  /// it.
  RunStatus bring(const string& id, size_t from) const {
    const auto path = [&](const string& folder) { return fmt::format("{}/runs/{}", folder, id); };
    if (from < options_.operands.size()) {
      if (from > 0) copy_run(path(options_.operands[from]), path(folder_));
      return RunStatus::done;
    }

    // None has it. It may have failed, here or elsewhere.
    if (!stored_failure(path(folder_)).empty()) return RunStatus::failed;
    for (size_t i = 1; i < options_.operands.size(); ++i) {
      const string why = stored_failure(path(options_.operands[i]));
      if (why.empty()) continue;
      store_failure(path(folder_), why);
      return RunStatus::failed;
    }
    return RunStatus::missing;
  }

  int end(string_view status, const Sweep& sweep, const vector<string>& missing, const vector<string>& failed) const {
    const size_t runs = sweep.size() - skipped_.size();
    const Json json = {{"folder", folder_}, {"status", string(status)}, {"runs", runs},         {"missing", missing},
                       {"failed", failed},  {"skipped", skipped_},      {"doubtful", doubtful_}};
    if (!missing.empty()) return print_end(options_, 1, json);

    Block block(options_);
    block.heading(name_of_folder(folder_), sweep.title);
    block.line("runs", failed.empty() ? counted(runs, "run", "runs")
                                      : fmt::format("{}, {} failed", counted(runs, "run", "runs"), failed.size()));
    describe_doubtful(block, doubtful_);
    if (!skipped_.empty())
      block.warning("left out", fmt::format("{}: see {}", counted(skipped_.size(), "run", "runs"), stored_skipped));
    block.line("folder", printable(folder_));
    return print_end(options_, failed.empty() ? 0 : 3, json, block.text());
  }

  const Options& options_;
  string folder_;
  set<string> skipped_;  // ids of runs that are left out
  string skipped_text_;
  size_t doubtful_ = 0;  // runs
};

}  // namespace

const Command gather_command = {
    "gather",
    [](const Options& options) { return GatherSession(options).go(); },
    "joins the parts of a sweep that was made with --shard",
    "  carom gather output/falls                             parts that were written into one folder\n"
    "  carom gather output/falls part1 part2                 parts from elsewhere, copied into it\n",
    "It writes summary.csv, comparison.xlsx, index.html and manifest.json, byte for byte as the same sweep\n"
    "in one part. If runs are missing, it lists them and writes nothing.\n\n"
    "Exit codes: 0 done, 1 runs are missing, 2 the command line is wrong or there is no sweep, 3 some\n"
    "runs failed, 130 or 143 interrupted.",
    {{"--progress"}},
    "DIR",
    "the sweep's folder, then those of parts elsewhere",
    "name the sweep's folder: carom {} output/falls"};

}  // namespace carom
