// Turns options into a Sweep as if its file had them, so that `sweep`, `gather` and `submit` agree on the runs.
#include "commands/sweep_setup.h"

#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <filesystem>

#include "commands/interrupt.h"
#include "commands/option_table.h"
#include "commands/text.h"
#include "compare/comparison.h"
#include "numerics/processors.h"
#include "overlay/text_notes.h"
#include "render/mesh.h"
#include "run/start_reader.h"
#include "scene/grid_text.h"
#include "scene/output_kinds.h"
#include "scene/resolve.h"
#include "scene/scene.h"
#include "std.h"
#include "study/sweep_folder.h"
#include "yaml/values.h"

namespace carom {

namespace fs = std::filesystem;

namespace {

bool varies(const Sweep& sweep, string_view path) {
  return contains(sweep.paths, path);
}

void set_for_all(Sweep& sweep, const string& text, string_view option) {
  const size_t equals = text.find('=');
  const string path = text.substr(0, equals), value = text.substr(equals + 1);
  if (varies(sweep, path))
    throw UsageError(fmt::format("{} sets {}, which varies in this sweep", option, in_backticks(path)));
  // The last of several values counts.
  std::erase_if(sweep.set_values, [&](const SweepValue& set) { return set.text.starts_with(path + "="); });
  // In a file an unquoted # begins a comment; here it can only be a colour.
  sweep.set_values.push_back(
      {path + "=" + (value.starts_with('#') ? in_quotes(value) : value), fmt::format("--set {}", text)});
}

/// The number in a variable of Slurm.
optional<size_t> slurm(const char* name) {
  const char* text = std::getenv(name);
  if (text == nullptr) return nullopt;
  size_t value = 0;
  const char* end = text + string_view(text).size();
  const auto [stop, error] = std::from_chars(text, end, value);
  if (error != std::errc() || stop != end)
    throw UsageError(fmt::format("{} is {}, which is not a number", name, in_backticks(text)), "use --shard I/N");
  return value;
}

/// Whether the operand is a scene, varied by options alone.
bool varies_scene(const Options& options) {
  return !options.sweep.grid.empty() || (options.sweep.repeat && !is_sweep_file(options.operands.front()));
}

/// Options of samples need ranges, and ranges need them.
void refuse_samples(const Options& options) {
  const SweepWords& words = options.sweep;
  const string& file = options.operands.front();
  const bool samples = words.random || words.latin;
  if ((!words.grid.empty() || samples) && is_sweep_file(file))
    throw UsageError(fmt::format("{} a scene; {} is a sweep",
                                 words.grid.empty() ? "--random and --latin vary" : "--grid varies", printable(file)),
                     fmt::format("add to its {}", words.grid.empty() ? "`random` or `latin`" : "`grid`"));

  if (words.random && words.latin) throw UsageError("--random and --latin exclude one another", "remove one of them");
  const auto open = ranges::find_if(words.grid, is_open_range);
  if (open != words.grid.end() && !samples)
    throw UsageError(fmt::format("--grid {} has no count", printable(*open)),
                     fmt::format("add one, such as {}:6, or draw from it with --latin 50", printable(*open)));

  if (open == words.grid.end() && samples)
    throw UsageError(fmt::format("{0} {1} draws from ranges, and there are none", words.random ? "--random" : "--latin",
                                 words.random.value_or(words.latin.value_or(0))),
                     "add --grid PATH=FROM:TO");
}

}  // namespace

Sweep read_sweep(const Options& options) {
  const string& file = options.operands.front();
  SweepOptions how{options.seed, options.sweep.random, options.sweep.latin, options.sweep.repeat, false};
  how.color = !options.json && uses_color(options.color, STDERR_FILENO);
  refuse_samples(options);
  Sweep sweep = varies_scene(options) ? grid_sweep(file, options.sweep.grid, how) : load_sweep(file, how);

  for (const string& set : options.set) set_for_all(sweep, set, "--set");
  if (options.seed && sweep.seeds > 0) {
    if (*options.seed > numeric_limits<uint64_t>::max() - sweep.seeds)
      throw UsageError(fmt::format("--seed {} leaves too few seeds for {} repeats", *options.seed, sweep.seeds));
    sweep.first_seed = options.seed;
  } else if (options.seed) {
    set_for_all(sweep, fmt::format("seed={}", *options.seed), "--seed");
  }

  if (options.sweep.skip_invalid) sweep.skip_invalid = true;
  if (options.only) {
    sweep.only.clear();
    for (const string& name : *options.only) sweep.only.push_back({name, "--only"});
  }

  const auto add = [&](const string& name, const char* option) {
    const auto is_named = [&](const SweepMeasure& measure) { return measure.name == name; };
    if (none_of(sweep.measures, is_named)) sweep.measures.push_back({name, option});
  };
  for (const string& name : options.compare.measures) add(name, "--measures");
  if (!options.sweep.best.empty()) add(options.sweep.best, "--best");
  return sweep;
}

string sweep_folder_of(const Options& options) {
  if (options.output) return *options.output;
  const string stem = fs::path(options.operands.front()).stem().string();
  return (fs::path("output") / (varies_scene(options) ? stem + ".sweep" : stem)).string();
}

SweepSettings sweep_settings(const Options& options) {
  SweepSettings settings;
  settings.load.budget.enforced = !options.force;
  settings.load.color = !options.json && uses_color(options.color, STDERR_FILENO);

  // Every scenario has the base's meshes, so each mesh is read once.
  auto known = make_shared<map<string, vector<Vec3>>>();
  settings.load.measure_fault = measure_fault;
  settings.load.mesh_points = [known](const string& path) {
    const auto found = known->find(path);
    return found != known->end() ? found->second : known->emplace(path, read_mesh_points(path)).first->second;
  };
  settings.load.former_state = start_reader(settings.load);

  settings.jobs = options.execution.jobs.value_or(processors());
  settings.shard = shard_of(options);
  settings.force = options.force;
  settings.checkpoint_s = options.execution.checkpoint_s.value_or(settings.checkpoint_s);

  settings.restrict = [](const Output& requested, const Sweep& sweep) {
    if (sweep.only.empty()) return requested;
    vector<string> only;
    for (const SweepValue& name : sweep.only) only.push_back(name.text);
    return restricted(requested, only);
  };
  settings.stop_check = stop_if_interrupted;
  return settings;
}

namespace {

/// `where`: "file:line:column", or an option.
ErrorRecord placed(const string& where, const string& message) {
  ErrorRecord record{where, 0, 0, message, {}, suggestion_in(message)};
  const size_t last = where.rfind(':'), middle = where.rfind(':', last == 0 ? 0 : last - 1);
  if (last == string::npos || middle == string::npos || middle == last) return record;
  const auto line = parse_index(where.substr(middle + 1, last - middle - 1)),
             column = parse_index(where.substr(last + 1));
  if (line && column) record = {where.substr(0, middle), *line, *column, message, {}, record.near};
  return record;
}

/// The scenario that stands for all. None: it is invalid.
optional<Scene> first_valid(SweepJob& job) {
  const size_t most = job.sweep().skip_invalid ? job.sweep().size() : 1;
  for (size_t number = 0; number < most; ++number) {
    try {
      return job.scene(number);
    } catch (const SceneError&) {
      continue;
    }
  }
  return nullopt;
}

}  // namespace

void check_comparison(SweepJob& job) {
  const Sweep& sweep = job.sweep();
  const optional<Scene> first = first_valid(job);
  if (!first) return;
  const Scene& scene = *first;

  string errors;
  vector<ErrorRecord> records;
  const auto check = [&](const string& where, const auto& work) {
    try {
      work();
    } catch (const MeasureError& error) {
      errors += fmt::format("{}: error: {}\n", where, error.what());
      records.push_back(placed(where, error.what()));
    }
  };

  for (const SweepMeasure& measure : sweep.measures) check(measure.where, [&] { parse_measure(measure.name, scene); });
  for (const SweepChart& chart : sweep.charts) {
    check(chart.where, [&] {
      ComparisonPlan plan = comparison_plan(sweep, job.base_text());
      plan.measures.clear();
      plan.charts = {{chart.x, chart.y, chart.by}};
      check_charts(plan);
      for (const Measure& measure : measures_of(plan)) parse_measure(measure.name, scene);
    });
  }
  if (!records.empty()) throw SceneError(errors, records.size(), records);
}

vector<string> notes_on_start(SweepJob& job) {
  const bool is_ascii = all_of(job.base_text(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  if (is_ascii && !may_read_files(job.sweep(), job.base_text())) return {};
  const optional<Scene> first = first_valid(job);
  if (!first) return {};
  vector<string> notes = first->made_from.notes;
  for (string& note : text_notes(*first)) notes.push_back(std::move(note));
  return notes;
}

Shard shard_of(const Options& options) {
  if (options.shard) return *options.shard;
  const auto task = slurm("SLURM_ARRAY_TASK_ID"), count = slurm("SLURM_ARRAY_TASK_COUNT");
  if (!task || !count) return {};
  const size_t step = max<size_t>(slurm("SLURM_ARRAY_TASK_STEP").value_or(1), 1);
  const size_t least = slurm("SLURM_ARRAY_TASK_MIN").value_or(1);
  const Shard shard{*task < least ? 0 : (*task - least) / step + 1, *count};
  if (shard.index < 1 || shard.index > shard.count || (*task - least) % step != 0)
    throw UsageError("SLURM_ARRAY_TASK_ID is not within its array, or the array has gaps", "use --shard I/N");
  return shard;
}

}  // namespace carom
