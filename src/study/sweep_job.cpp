// Plans and runs a sweep in worker processes. Runs are grouped by digests of their scenes and of their motions.
// Scenarios with equal motion share one simulation, because only pictures and outputs differ.
// The division into parts does not depend on what is done.
#include "study/sweep_job.h"

#include <fmt/format.h>

#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <tuple>

#include "compare/compared_run.h"
#include "engine/engine.h"
#include "files/copied_run.h"
#include "files/failed_run.h"
#include "files/folder_writer.h"
#include "files/hash.h"
#include "files/mesh_copies.h"
#include "files/publication.h"
#include "run/run_scene.h"
#include "scene/caption.h"
#include "scene/motion_text.h"
#include "scene/path_field.h"
#include "scene/scene.h"
#include "std.h"
#include "study/sweep_folder.h"
#include "yaml/diagnostics.h"
#include "yaml/value_json.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

constexpr size_t examined_at_a_time = 64;
/// Of one simulation. Each may have a film in progress.
constexpr size_t most_shows = 8;
/// Batches with errors. Planning stops after this number.
constexpr size_t most_wrong = 16;
constexpr size_t errors_shown = 20;
constexpr double sync_every = 2;  // s

/// Removes repeated errors, and keeps each under the first run that has it.
/// An error is a line and the lines below it that begin with a blank.
pair<string, size_t> each_once(string_view text) {
  string out, head;
  set<string, std::less<>> known;

  for (size_t i = 0; i < text.size();) {
    size_t end = i;
    do {
      end = min(text.find('\n', end), text.size() - 1) + 1;
    } while (end < text.size() && text[end] == ' ');

    const string_view block = text.substr(i, end - i);
    i = end;
    if (block.ends_with(":\n")) {
      head = block;
    } else if (known.emplace(block).second && known.size() <= errors_shown) {
      out += exchange(head, "");
      out += block;
    }
  }

  if (known.size() > errors_shown) out += fmt::format("and {} more\n", known.size() - errors_shown);
  return {out, known.size()};
}

/// Invalid runs of a batch.
struct WrongRuns {
  string text;                  // for a terminal: the id of each run, then its errors
  vector<ErrorRecord> records;  // each once
  vector<InvalidRun> invalid;
  bool any_lost = false;  // whether the cause may be another than the scenes

  void append(const WrongRuns& more) {
    text += more.text;
    for (const ErrorRecord& record : more.records) add(record);
  }
  void lost(const string& id, const string& message) {
    any_lost = true;
    text += fmt::format("{}: error: {}\n", id, message);
    add({id, 0, 0, message, {}, {}});
  }
  /// `errors`: as examine() has them.
  void add(const string& id, const Json& errors) {
    const string its = errors[1].get<string>();
    text += fmt::format("{}:\n{}", id, its);
    any_lost = any_lost || !errors[4].get<bool>();
    InvalidRun run{errors[0].get<size_t>(), its, {}};
    for (const Json& error : errors[3]) {
      const ErrorRecord record{error[0], error[1], error[2], error[3], error[4], error[5]};
      run.messages += (run.messages.empty() ? "" : "; ") + record.message;
      add(record);
    }
    invalid.push_back(std::move(run));
  }

 private:
  void add(const ErrorRecord& record) {
    const auto is_same = [&](const ErrorRecord& other) {
      return tie(record.file, record.line, record.column, record.message) ==
             tie(other.file, other.line, other.column, other.message);
    };
    if (records.size() < errors_shown && none_of(records, is_same)) records.push_back(record);
  }
};

Json records_json(const vector<ErrorRecord>& records) {
  Json list = Json::array();
  for (const ErrorRecord& r : records) list.push_back({r.file, r.line, r.column, r.message, r.remedy, r.near});
  return list;
}

array<char, 16> digest(string_view text) {
  const string hex = sha256(text);
  array<char, 16> out{};
  for (size_t i = 0; i < out.size(); ++i) {
    const auto nibble = [&](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
    out[i] = char(16 * nibble(hex[2 * i]) + nibble(hex[2 * i + 1]));
  }
  return out;
}

/// The run that a scenario begins with, as its manifest names it. `folder`: the sweep's, in which it must not lie.
/// Throws SceneError.
string start_text(const Scene& scene, const string& folder) {
  const auto& start = scene.made_from.start;
  if (!start) return {};
  if ((canonical(start->folder) + "/").starts_with(canonical(folder) + "/")) {
    const string fault = fmt::format("the run {} lies in the folder of this sweep, which replaces what is there",
                                     in_backticks(start->run));
    const string remedy = "expected a run elsewhere, or another folder for the sweep: -o";
    throw SceneError(fmt::format("{}: error: {}\n   = {}\n", scene.file, fault, remedy), 1,
                     {{scene.file, 0, 0, fault, remedy, ""}});
  }
  return fmt::format("{} {} {}", start->run, start->at, start->sha256);
}

/// Adds the values of `let` that a measure names.
void add_given(const Measure& measure, const Scene& scene, string& text) {
  for (const Measure& part : measure.parts) add_given(part, scene, text);
  if (measure.form != MeasureForm::given) return;
  const auto number = scene.measures.numbers.find(measure.things[0]);
  if (number != scene.measures.numbers.end()) text += fmt::format("{}={}\n", number->first, number->second);
}

/// What besides the motion determines the measures of a scene, and these further ones.
string measured_text(const Scene& scene, const vector<Measure>& more) {
  string text;
  for (const OwnMeasure& own : scene.measures.own) text += fmt::format("{}: {}\n", own.name, own.text);
  for (const Measure& measure : own_measures(scene)) add_given(measure, scene, text);
  for (const Measure& measure : more) add_given(measure, scene, text);
  return text;
}

LoadOptions load_options(const Sweep& sweep, LoadOptions load) {
  const auto is_film = [](const SweepValue& output) { return output.text == "video"; };
  load.chooses_outputs = !sweep.only.empty() && none_of(sweep.only, is_film);
  return load;
}

}  // namespace

bool may_read_files(const Sweep& sweep, const string& base_text) {
  const string settings = sweep.resolved("");
  for (const char* key : {"mesh", "start", "table"})
    if (base_text.find(key) != string::npos || settings.find(key) != string::npos) return true;
  return false;
}

SweepJob::SweepJob(Sweep sweep, string folder, SweepSettings settings)
    : sweep_(std::move(sweep)),
      folder_(std::move(folder)),
      settings_(std::move(settings)),
      base_(sweep_.base, load_options(sweep_, settings_.load)),
      runs_(sweep_.size()) {
  if (sweep_.seeds == 0 || sweep_.first_seed) return;

  Sweep once = sweep_;
  once.seeds = 0;
  // All runs have the same seed. If none is valid, plan() reports the errors.
  for (size_t number = 0; !sweep_.first_seed && number < (sweep_.skip_invalid ? once.size() : 1); ++number) {
    try {
      sweep_.first_seed = base_.scene(once.run(number).settings).seed;
    } catch (const SceneError&) {
      continue;
    }
  }
  if (!sweep_.first_seed) sweep_.first_seed = 0;
}

string SweepJob::run_folder(size_t number) const {
  return fmt::format("{}/runs/{}", folder_, sweep_.id(number));
}

Scene SweepJob::scene(size_t number) {
  Scene scene = base_.scene(sweep_.run(number).settings);
  scene.output = settings_.restrict(scene.output, sweep_);
  return scene;
}

// ---- Planning: digests of each scenario, and the content of its folder.

/// The planned runs as bytes, then the errors of the wrong ones as JSON: number, text, count, errors in parts, and
/// whether the scene is invalid.
string SweepJob::examine(size_t first, size_t last) {
  string out;
  Json errors = Json::array();

  for (size_t number = first; number < last; ++number) {
    settings_.stop_check();
    PlannedRun run;
    const auto refuse = [&](const SceneError& error, bool is_invalid) {
      run.status = RunStatus::left_out;
      errors.push_back({number, error.what(), error.count, records_json(error.records), is_invalid});
    };

    try {
      const Scene its = scene(number);
      // The text contains only the names of meshes. Pictures with the run's name are not those of another run.
      const bool named = its.output.pictures() && has_name(its.overlay.caption, "run");
      run.scene = digest(its.resolved + meshes_text(its) + start_text(its, folder_) + (named ? sweep_.id(number) : ""));
      run.motion = digest(motion_text(its));
      run.measured = digest(measured_text(its, measures_));

      const string folder = run_folder(number);
      settle_folder(folder);
      run.content = inspect_folder(folder, its);
      // Files of a run of an unfinished sweep are not synced: they may have changed by a power failure.
      if (run.content == FolderContent::touched && !is_ended_sweep(folder_)) run.content = FolderContent::incomplete;
      if (run.content == FolderContent::this_run && !settings_.force && has_measures(folder, measures_))
        run.status = RunStatus::done;
      if (settings_.checks_requirements && run.status != RunStatus::done) requirements_.check(base_, its, its.output);
    } catch (const RequirementError& error) {
      refuse(error, false);
    } catch (const SceneError& error) {
      refuse(error, true);
    }

    out.append(reinterpret_cast<const char*>(&run), sizeof run);
  }
  return out + text_of_json(errors);
}

void SweepJob::plan(const function<void(const SweepProgress&)>& report_progress) {
  size_t next = 0;
  SweepProgress progress{0, 0, runs_.size()};

  measures_ = measures_of(comparison_plan(sweep_, base_.text()));
  // By the first run of the batch.
  map<size_t, WrongRuns> wrong;

  Tasks tasks;
  tasks.next = [&]() -> optional<size_t> {
    if (next >= runs_.size() || (!sweep_.skip_invalid && wrong.size() >= most_wrong)) return nullopt;
    const size_t task = next;
    next += examined_at_a_time;
    return task;
  };

  const auto end_of = [&](size_t first) { return min(first + examined_at_a_time, runs_.size()); };
  tasks.work = [&](size_t first) { return examine(first, end_of(first)); };
  tasks.done = [&](const TaskOutcome& outcome) {
    const size_t first = outcome.task, last = end_of(first);
    if (outcome.kind != TaskOutcome::Kind::done) {
      const string message = fmt::format("{}, between here and {}", outcome.text, sweep_.id(last - 1));
      wrong[first].lost(sweep_.id(first), message);
      return;
    }

    const size_t bytes = (last - first) * sizeof(PlannedRun);
    std::memcpy(static_cast<void*>(&runs_[first]), outcome.text.data(), bytes);
    for (const Json& errors : json_of_text(string_view(outcome.text).substr(bytes)))
      wrong[first].add(sweep_.id(errors[0].get<size_t>()), errors);
    progress.done += last - first;
    report_progress(progress);
  };

  tasks.stop_check = settings_.stop_check;
  work_off(tasks, min(settings_.jobs, (runs_.size() + examined_at_a_time - 1) / examined_at_a_time));

  // Errors in the order of the runs, whatever the order of the tasks.
  size_t valid = runs_.size();
  bool any_lost = false;
  for (auto& [first, runs] : wrong) {
    any_lost = any_lost || runs.any_lost;
    valid -= runs.invalid.size();
    std::move(runs.invalid.begin(), runs.invalid.end(), std::back_inserter(invalid_));
  }
  if (wrong.empty() || (sweep_.skip_invalid && !any_lost && valid > 0)) return;

  WrongRuns all;
  for (const auto& [first, runs] : wrong) all.append(runs);
  const auto [text, count] = each_once(all.text);
  throw SceneError(text, count, all.records);
}

optional<size_t> SweepJob::other_content() const {
  // Changes in the folders of other parts' runs do not count.
  const vector<size_t> mine = of_part();
  const auto found = ranges::find_if(mine, [&](size_t number) {
    const FolderContent content = runs_[number].content;
    return content == FolderContent::other_run || content == FolderContent::more || content == FolderContent::touched;
  });
  return found == mine.end() ? nullopt : optional(*found);
}

vector<string> SweepJob::idle_paths() const {
  constexpr size_t most = 20'000;  // runs that are examined
  vector<string> idle;
  for (size_t p = 0; p < sweep_.paths.size(); ++p) {
    const string& path = sweep_.paths[p];
    const string_view head = string_view(path).substr(0, path.find('.'));
    if (head == "output" || head == "title" || is_drawn(path)) continue;

    map<string, size_t> first;  // by the other values
    size_t pairs = 0, alike = 0;
    for (size_t number = 0; number < min(runs_.size(), most); ++number) {
      if (runs_[number].status == RunStatus::left_out) continue;

      string others;
      const SweepRun run = sweep_.run(number);
      for (size_t q = 0; q < run.values.size(); ++q)
        if (q != p) others += run.values[q].value_or("-") + '\n';
      const auto [found, is_new] = first.emplace(std::move(others), number);

      // Equal values may differ in notation.
      if (is_new || runs_[number].scene == runs_[found->second].scene) continue;
      ++pairs;
      const PlannedRun &one = runs_[number], &other = runs_[found->second];
      if (one.motion == other.motion && one.measured == other.measured) ++alike;
      if (alike < pairs) break;
    }

    if (pairs > 0 && alike == pairs) idle.push_back(path);
  }
  return idle;
}

// ---- Running

vector<SweepJob::Motion> SweepJob::motions() const {
  // Sort runs by motion, then scenario, then number.
  vector<size_t> order;
  for (size_t number = 0; number < runs_.size(); ++number)
    if (runs_[number].status != RunStatus::left_out) order.push_back(number);
  ranges::sort(order, [&](size_t a, size_t b) {
    return tie(runs_[a].motion, runs_[a].scene, a) < tie(runs_[b].motion, runs_[b].scene, b);
  });

  vector<Motion> motions;
  for (size_t i = 0; i < order.size();) {
    Motion motion;
    Unit shared;
    const auto& moves = runs_[order[i]].motion;

    while (i < order.size() && runs_[order[i]].motion == moves) {
      const auto& scenario = runs_[order[i]].scene;

      // The runs of one scenario.
      vector<size_t> to_do;
      size_t like = none;
      for (; i < order.size() && runs_[order[i]].motion == moves && runs_[order[i]].scene == scenario; ++i) {
        motion.runs.push_back(order[i]);
        if (runs_[order[i]].status == RunStatus::done)
          like = order[i];
        else
          to_do.push_back(order[i]);
      }

      if (to_do.empty()) continue;
      if (like != none) {
        motion.units.push_back({{std::move(to_do)}, like});
        continue;
      }

      shared.scenarios.push_back(std::move(to_do));
      if (shared.scenarios.size() == most_shows) motion.units.push_back(exchange(shared, {}));
    }

    if (!shared.scenarios.empty()) motion.units.push_back(std::move(shared));
    motions.push_back(std::move(motion));
  }

  // The division into parts must not depend on what is already done.
  ranges::sort(motions, [](const Motion& a, const Motion& b) { return first(a) < first(b); });

  vector<Motion> mine;
  for (size_t m = settings_.shard.index - 1; m < motions.size(); m += settings_.shard.count)
    mine.push_back(std::move(motions[m]));
  return mine;
}

size_t SweepJob::first(const Motion& motion) {
  return *ranges::min_element(motion.runs);
}

vector<SweepJob::Unit> SweepJob::units() const {
  vector<Unit> out;
  for (Motion& motion : motions()) std::move(motion.units.begin(), motion.units.end(), std::back_inserter(out));
  return out;
}

vector<size_t> SweepJob::of_part() const {
  vector<size_t> out;
  for (const Motion& motion : motions()) out.insert(out.end(), motion.runs.begin(), motion.runs.end());
  ranges::sort(out);
  return out;
}

size_t SweepJob::runs_in(const vector<Unit>& units) {
  size_t count = 0;
  for (const Unit& unit : units)
    for (const auto& scenario : unit.scenarios) count += scenario.size();
  return count;
}

size_t SweepJob::left() const {
  return runs_in(units());
}

/// The result of a unit as JSON: the reason for each failed run.
string SweepJob::work(const Unit& unit) {
  Json failures = Json::object();
  const auto fail = [&](size_t number, const string& why) { failures[to_string(number)] = why; };

  const auto copy_to_all = [&](size_t from, const vector<size_t>& runs) {
    for (const size_t number : runs) {
      if (number == from) continue;
      try {
        copy_run(run_folder(from), run_folder(number));
      } catch (const std::exception& error) {
        settings_.stop_check();
        fail(number, error.what());
      }
    }
  };

  if (unit.like != none) {
    copy_to_all(unit.like, unit.scenarios.front());
    return text_of_json(failures);
  }

  // One scene of each scenario, all by one simulation.
  vector<Scene> scenes;
  scenes.reserve(unit.scenarios.size());
  vector<Show> shows;
  for (const auto& scenario : unit.scenarios) {
    scenes.push_back(scene(scenario.front()));
    shows.push_back({&scenes.back(), run_folder(scenario.front()), 0});
  }

  const RunWatch watch{settings_.stop_check, [](const RunProgress&) {}};
  RunSettings how;
  how.durability = Durability::deferred;
  how.checkpoint_s = settings_.checkpoint_s;
  std::copy_if(measures_.begin(), measures_.end(), std::back_inserter(how.measures),
               [](const Measure& measure) { return !measure.is_stored(); });
  const vector<RunResult> results = run_shows(shows, choose_engine(scenes.front()), how, watch);

  for (size_t i = 0; i < results.size(); ++i) {
    const vector<size_t>& runs = unit.scenarios[i];
    if (!results[i].failure) {
      copy_to_all(runs.front(), runs);
      continue;
    }

    try {
      std::rethrow_exception(results[i].failure);
    } catch (const std::exception& error) {
      for (const size_t number : runs) fail(number, error.what());
    }
  }
  return text_of_json(failures);
}

void SweepJob::run(const function<void(const SweepProgress&)>& report_progress,
                   const function<void(size_t, const string&)>& failed) {
  const vector<Unit> all = units();
  // Of an earlier mesh.
  for (const InvalidRun& run : invalid_) remove_run(run_folder(run.number));

  SweepProgress progress{0, 0, runs_in(all)};
  size_t next = 0;
  auto synced = std::chrono::steady_clock::now();
  string full_disk;  // the first error that names one

  const auto fail = [&](size_t number, string why) {
    if (names_full_disk(why)) {
      if (full_disk.empty()) full_disk = std::move(why);
      return;
    }

    runs_[number].status = RunStatus::failed;
    try {
      store_failure(run_folder(number), why);
    } catch (const ExportError& error) {
      if (full_disk.empty() && names_full_disk(error.what())) full_disk = error.what();
      if (why != error.what()) why += fmt::format("; {}", error.what());
    }

    ++progress.failed;
    failed(number, why);
  };

  Tasks tasks;
  tasks.next = [&] { return next < all.size() && full_disk.empty() ? optional(next++) : nullopt; };
  tasks.work = [&](size_t task) { return work(all[task]); };

  tasks.done = [&](const TaskOutcome& outcome) {
    const bool whole = outcome.kind == TaskOutcome::Kind::done;
    const Json failures = whole ? json_of_text(outcome.text) : Json::object();

    for (const auto& scenario : all[outcome.task].scenarios) {
      for (const size_t number : scenario) {
        ++progress.done;
        const auto found = failures.find(to_string(number));
        if (!whole)
          fail(number, outcome.text);
        else if (found != failures.end())
          fail(number, found->get<string>());
        else
          runs_[number].status = RunStatus::done;
      }
    }

    report_progress(progress);
    const auto now = std::chrono::steady_clock::now();
    if (std::chrono::duration<double>(now - synced).count() < sync_every) return;
    sync_file_system(folder_);
    synced = std::chrono::steady_clock::now();
  };

  tasks.stop_check = [&] {
    settings_.stop_check();
    report_progress(progress);
  };
  work_off(tasks, min(settings_.jobs, max<size_t>(all.size(), 1)));
  if (!full_disk.empty()) throw ExportError(full_disk);
}

}  // namespace carom
