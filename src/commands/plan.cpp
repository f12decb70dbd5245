// Loads and checks every scene before the first one runs. An error in the last scene would otherwise appear after all
// other runs.
#include "commands/plan.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <new>

#include "bench/bench_folder.h"
#include "commands/error_list.h"
#include "commands/idle_settings.h"
#include "commands/interrupt.h"
#include "commands/text.h"
#include "files/earlier_run.h"
#include "files/folder_writer.h"
#include "files/manifest.h"
#include "files/publication.h"
#include "overlay/text_notes.h"
#include "physics/world.h"
#include "render/mesh.h"
#include "run/measure.h"
#include "run/requirements.h"
#include "run/start_reader.h"
#include "run/stopwatch.h"
#include "scene/load.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

namespace fs = std::filesystem;

namespace {

/// The folder of a run: that of --output, or for several operands one in it, or `usual`.
string folder_of(const Options& options, const string& name, const string& usual) {
  if (!options.output) return usual;
  return options.operands.size() == 1 ? *options.output : (fs::path(*options.output) / name).string();
}

// Two runs in one folder would overwrite each other.
void refuse_shared_folders(const vector<PlannedScene>& scenes) {
  map<string, const PlannedScene*> owner;
  for (const PlannedScene& scene : scenes) {
    const auto [found, is_new] = owner.emplace(canonical(scene.folder), &scene);
    if (is_new) continue;
    throw UsageError(fmt::format("{} and {} would both be written to {}", printable(found->second->file),
                                 printable(scene.file), printable(scene.folder)),
                     "run one of them with another -o");
  }
}

void mark_failed(PlannedScene& planned, size_t errors, const string& text, vector<ErrorRecord> records) {
  planned.scene.reset();
  planned.errors = errors;
  planned.records = std::move(records);
  planned.error = text;
  if (planned.error.empty() || planned.error.back() != '\n') planned.error += '\n';
}

void mark_failed(PlannedScene& planned, const string& text) {
  mark_failed(planned, 1, fmt::format("{}: {}", printable(planned.file), text), error_of_text(text, planned.file));
}

SceneOrigin origin_of(const PlannedScene& planned, const Options& options) {
  SceneOrigin origin{planned.file == standard_input ? string() : path_from(planned.folder, planned.file), {}};
  for (const string& set : options.set) origin.settings.push_back(valid_utf8(set));
  if (options.seed) origin.settings.push_back(fmt::format("seed={}", *options.seed));
  return origin;
}

/// What is the same for all scenes of a command line.
struct Planning {
  const Options& options;
  Purpose purpose;
  const function<void(PlannedScene&)>& inspected;  // may be unset
  Requirements requirements{};
};

/// A scene as its file has it, with the outputs that are written.
struct LoadedScene {
  unique_ptr<Scene> scene;
  Output requested;      // without --only
  vector<string> notes;  // as in PlannedScene
};

LoadedScene load(SceneFile& file, const string& path, const Options& options) {
  auto scene = make_unique<Scene>(file.scene());
  const Output requested = scene->output;
  const auto written = [&](const Output& all) { return options.only ? restricted(all, *options.only) : all; };
  scene->output = written(requested);

  for (string& note : text_notes(*scene)) scene->made_from.notes.push_back(std::move(note));
  vector<string> notes = scene->made_from.notes;
  const vector<string> idle = idle_settings(options.set, *scene, [&](const vector<string>& set) {
    LoadOptions load = load_options(options, true);
    load.set = set;
    Scene other = load_scene(path, load);
    other.output = written(other.output);
    return other;
  });
  notes.insert(notes.end(), idle.begin(), idle.end());

  check_flights(*scene);
  return {std::move(scene), requested, std::move(notes)};
}

FolderLook look_for_bench(const string& folder, const Scene& scene, const BenchOptions& options) {
  FolderChanges changes;
  const FolderContent content = inspect_bench_folder(folder, scene, options, &changes);
  return {content, obstacle_of(changes)};
}

/// A run of this scene file before it was edited is no obstacle. `requested`: the outputs without --only.
FolderLook look_for_run(const string& folder, const Scene& scene, const SceneOrigin& origin, const Output& requested,
                        const optional<vector<string>>& only) {
  FolderLook found = look_into(folder, scene);
  if (found.content == FolderContent::other_run) {
    const EarlierRun earlier = find_earlier_run(folder, origin);
    if (earlier.is_replaceable()) found.content = FolderContent::earlier;
    found.obstacle = obstacle_of(earlier.changes);
  }

  const bool differs = found.content == FolderContent::incomplete || found.content == FolderContent::more;
  if (!only || !differs || !holds_all(requested, *only)) return found;

  // A whole run of this scene has the named outputs and more.
  Scene whole = scene;
  whole.output = requested;
  if (inspect_folder(folder, whole) == FolderContent::this_run) found.content = FolderContent::this_run;
  return found;
}

/// Throws ExportError if a run must not be written there. Completes what an interrupted one left.
void prepare_folder(const string& folder, const optional<StartedFrom>& start) {
  refuse_other_file(folder);
  if (start && is_same_folder(start->folder, folder))
    throw ExportError(
        fmt::format("{} holds the run that this one begins with, and would be replaced\n  write elsewhere with -o",
                    printable(folder)));
  settle_folder(folder);
}

void check(PlannedScene& planned, Planning& planning) {
  const Options& options = planning.options;
  const bool bench = planning.purpose == Purpose::bench;

  const auto start = std::chrono::steady_clock::now();
  SceneFile file(planned.file, load_options(options, options.only || bench));
  LoadedScene loaded = load(file, planned.file, options);
  planned.scene = std::move(loaded.scene);
  planned.notes = std::move(loaded.notes);
  planned.load_s = since(start);

  const Scene& scene = *planned.scene;
  planned.price = price_of(scene);
  // With --only the outputs it leaves or adds count, not those of the file.
  if (options.only && !options.force) hold_to_budget(scene, planned.price.forecast, "--only requests");

  prepare_folder(planned.folder, scene.made_from.start);
  if (bench) {
    planned.found = look_for_bench(planned.folder, scene, options.bench);
    return;
  }

  planned.origin = origin_of(planned, options);
  planned.found = look_for_run(planned.folder, scene, planned.origin, loaded.requested, options.only);
  if (planning.inspected) planning.inspected(planned);
  if (!is_up_to_date(planned, options)) planning.requirements.check(file, scene, scene.output);
}

}  // namespace

Price price_of(const Scene& scene) {
  return {choose_engine(scene), forecast(scene)};
}

FolderLook look_into(const string& folder, const Scene& scene) {
  FolderChanges changes;
  const FolderContent content = inspect_folder(folder, scene, &changes);
  return {content, obstacle_of(changes)};
}

FolderLook look_into_own(const string& folder) {
  const FolderChanges changes = find_changes(folder);
  if (changes.changed.empty()) return {FolderContent::incomplete};
  return {FolderContent::touched, obstacle_of(changes)};
}

void refuse_other_file(const string& folder) {
  if (what_stands(folder) == Standing::other) throw ExportError(fmt::format("{} is not a folder", printable(folder)));
}

bool is_up_to_date(const PlannedScene& planned, const Options& options) {
  return planned.found.content == FolderContent::this_run && !options.force;
}

string obstacle_of(const FolderChanges& changes) {
  if (!changes.changed.empty())
    return fmt::format("a run of this scene with a changed file, {}", printable(changes.changed));
  if (!changes.foreign.empty()) return fmt::format("{}, which the run there did not write", printable(changes.foreign));
  if (!changes.missing.empty())
    return fmt::format("a run of this scene that lacks a file, {}", printable(changes.missing));
  return {};
}

vector<PlannedScene> planned_folders(const Options& options) {
  vector<PlannedScene> runs;
  for (const string& folder : options.operands) {
    PlannedScene& run = runs.emplace_back();
    run.file = folder;
    while (run.file.size() > 1 && run.file.ends_with('/')) run.file.pop_back();
    run.name = name_of_folder(folder);
    run.folder = folder_of(options, run.name, run.file);
  }
  return runs;
}

LoadOptions load_options(const Options& options, bool lifted) {
  LoadOptions load;
  load.set = options.set;
  load.seed = options.seed;
  load.budget.enforced = !options.force;
  if (lifted) load.budget = load.budget.without_outputs();
  load.chooses_outputs = lifted;
  load.measure_fault = measure_fault;
  load.mesh_points = [](const string& path) { return read_mesh_points(path); };
  load.former_state = start_reader(load);
  load.color = !options.json && uses_color(options.color, STDERR_FILENO);
  return load;
}

void hold_to_budget(const Scene& scene, const Forecast& forecast, string_view asker) {
  const Budget budget;
  if (forecast.frames > budget.frames) {
    throw ExportError(fmt::format("{} {}, more than the {} that a run may draw without --force", asker,
                                  counted(forecast.frames, "picture", "pictures"), grouped(budget.frames)));
  }
  for (const Excess& excess : excesses(scene.output, scene.simulate.duration, scene.world.body_count(), budget)) {
    throw ExportError(fmt::format("{} {:.15g} {}, more than the {} that a run may write without --force", asker,
                                  excess.figure, excess.what, grouped(excess.limit)));
  }
}

vector<PlannedScene> named_scenes(const Options& options, Purpose purpose) {
  vector<PlannedScene> scenes(options.operands.size());
  if (contains(options.operands, standard_input)) read_standard_input(stop_if_interrupted);
  for (size_t i = 0; i < scenes.size(); ++i) {
    scenes[i].file = options.operands[i];
    const bool piped = options.operands[i] == standard_input;
    scenes[i].name = piped ? "stdin" : fs::path(options.operands[i]).stem().string();
    const string usual = scenes[i].name + (purpose == Purpose::bench ? ".bench" : "");
    scenes[i].folder = folder_of(options, scenes[i].name, (fs::path("output") / usual).string());
  }
  return scenes;
}

vector<PlannedScene> plan_scenes(const Options& options, Purpose purpose) {
  return plan_scenes(named_scenes(options, purpose), options, purpose);
}

vector<PlannedScene> plan_scenes(vector<PlannedScene> scenes, const Options& options, Purpose purpose,
                                 const function<void(PlannedScene&)>& inspected) {
  Planning planning{options, purpose, inspected};
  return plan_scenes(std::move(scenes), [&](PlannedScene& planned) { check(planned, planning); });
}

vector<PlannedScene> plan_scenes(vector<PlannedScene> scenes, const function<void(PlannedScene&)>& check_one) {
  refuse_shared_folders(scenes);
  for (PlannedScene& planned : scenes) {
    stop_if_interrupted();

    try {
      check_one(planned);
    } catch (const SceneError& error) {
      mark_failed(planned, error.count, error.what(), error.records);
    } catch (const std::bad_alloc&) {
      mark_failed(planned, "not enough memory for this scene");
    } catch (const std::exception& error) {
      mark_failed(planned, error.what());
    }
  }
  return scenes;
}

void refuse_other_content(vector<PlannedScene>& scenes, const Options& options) {
  for (PlannedScene& planned : scenes) {
    const FolderContent content = planned.found.content;
    const bool more = content == FolderContent::more;
    const bool other = content == FolderContent::other_run || content == FolderContent::touched;
    if (planned.errors > 0 || !(other || more) || options.force) continue;

    const string& obstacle = planned.found.obstacle;
    mark_failed(planned, fmt::format("the folder {} holds {}\n  write elsewhere with -o, or overwrite it with --force",
                                     printable(planned.folder),
                                     !other             ? "more outputs of this scene, which this run would remove"
                                     : obstacle.empty() ? "another run, or files that no run wrote"
                                                        : obstacle));
  }
}

string error_count(const vector<PlannedScene>& scenes) {
  size_t errors = 0, wrong = 0;
  for (const PlannedScene& scene : scenes) {
    errors += scene.errors;
    wrong += scene.errors > 0 ? 1 : 0;
  }
  if (errors == 0) return "";
  const string text = counted(errors, "error", "errors");
  return scenes.size() == 1 ? text : fmt::format("{} in {} of {} scenes", text, wrong, scenes.size());
}

}  // namespace carom
