// One task of the array does many runs: scheduling a task takes longer than most runs.
#include "commands/commands.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "commands/report.h"
#include "commands/sweep_setup.h"
#include "commands/text.h"
#include "numerics/processors.h"
#include "program_file.h"
#include "std.h"
#include "yaml/joined.h"

namespace carom {

namespace fs = std::filesystem;

namespace {

constexpr size_t runs_a_part = 50, most_parts = 16;  // without --parts

string words_of(const vector<string>& words) {
  string out;
  for (const string& word : words) out += (out.empty() ? "" : " ") + shell_word(word);
  return out;
}

/// Never parsed as an option, even with a leading dash.
string as_operand(const string& path) {
  return path.starts_with('-') ? "./" + path : path;
}

/// After SIGTERM a task has half a minute to finish its files. --open-mode: a requeued task appends to its log.
constexpr auto script_form = R"(#!/bin/sh
#SBATCH --job-name={0}
#SBATCH --array=1-{1}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task={2}
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=B:TERM@30
#SBATCH --output={0}-%A_%a.log
{3}
# {4} in {7}, as a Slurm job array. `sh` of this file submits the parts and, after them, a job that gathers
# them; `sbatch` of this file submits only the parts.
set -eu
if [ -z "${{SLURM_ARRAY_TASK_ID:-}}" ]; then
  parts=$(sbatch --parsable "$0")
  gather=$(sbatch --parsable --dependency=afterany:"$parts" --job-name={0}-gather --output={0}-gather-%j.log \
    --wrap {5})
  echo "parts: job $parts; gather: job $gather"
  exit
fi
exec {6} --jobs {2} --shard "$SLURM_ARRAY_TASK_ID/{1}"
)";

/// The command of a task, except for its part.
vector<string> sweep_words(const Options& options, const string& folder) {
  vector<string> words = {program_command(), "sweep", as_operand(options.operands.front()), "-o", folder,
                          "--progress",      "lines"};

  const auto add = [&](const string& name, const string& value) {
    words.push_back(name);
    words.push_back(value);
  };

  for (const string& grid : options.sweep.grid) add("--grid", grid);
  for (const string& set : options.set) add("--set", set);
  if (options.only) add("--only", joined(*options.only, ","));
  if (options.sweep.random) add("--random", to_string(*options.sweep.random));
  if (options.sweep.latin) add("--latin", to_string(*options.sweep.latin));
  if (options.sweep.repeat) add("--repeat", to_string(*options.sweep.repeat));
  if (options.sweep.skip_invalid) words.emplace_back("--skip-invalid");

  if (!options.compare.measures.empty()) add("--measures", joined(options.compare.measures, ","));
  if (options.seed) add("--seed", to_string(*options.seed));
  if (options.force) words.emplace_back("--force");
  return words;
}

int submit(const Options& options) {
  Options local = options;
  local.shard = Shard{};
  SweepSettings settings = sweep_settings(local);
  settings.jobs = processors();
  SweepJob job(read_sweep(options), sweep_folder_of(options), settings);
  check_comparison(job);
  job.plan([](const SweepProgress&) {});

  const size_t runs = job.sweep().size() - job.invalid().size();
  const size_t parts =
      min(options.submit.parts.value_or(min((runs + runs_a_part - 1) / runs_a_part, most_parts)), runs);
  const string folder = sweep_folder_of(options);
  const string stem = fs::path(options.operands.front()).stem().string();

  string batch;
  for (const string& line : options.submit.batch) batch += fmt::format("#SBATCH {}\n", line);
  const string name = "carom-" + (stem.empty() ? "sweep" : stem);
  const string script =
      fmt::format(script_form, shell_word(name), parts, options.execution.jobs.value_or(1), batch,
                  counted(runs, "run", "runs"), shell_word(words_of({program_command(), "gather", folder})),
                  words_of(sweep_words(options, folder)), counted(parts, "part", "parts"));

  if (!options.json) write_out(script);
  return print_end(
      options, 0,
      {{"sweep", options.operands.front()}, {"folder", folder}, {"runs", runs}, {"parts", parts}, {"script", script}});
}

int submit_sweep(const Options& options) {
  if (!options.submit.slurm) throw UsageError("name the batch system", "--slurm");
  try {
    return submit(options);
  } catch (const SceneError& error) {
    write_err(error.what());
    return print_refusal(options,
                         fmt::format("{}: there is nothing to submit", counted(error.count, "error", "errors")),
                         {{"sweep", options.operands.front()}}, error.records);
  }
}

}  // namespace

const Command submit_command = {
    "submit",
    submit_sweep,
    "prints a script that runs a sweep as a Slurm job array",
    "  carom submit sweep.yaml --slurm > job.sh\n"
    "  sh job.sh                                             submits the parts and a job that gathers them\n"
    "  sbatch job.sh                                         submits only the parts\n"
    "  carom submit sweep.yaml --slurm --parts 8 -j 4 --batch=--time=1:00:00\n",
    "Each task of the array runs one part of the sweep. A requeued task continues with the missing runs.\n"
    "The sweep's folder must be on a file system that all tasks share. All scenarios are checked before\n"
    "the script is printed.\n\n"
    "Exit codes: 0 done, 2 the command line, the sweep or its scene is wrong.",
    {{"--slurm"},
     {"--parts"},
     {"--batch"},
     {"--output", "the sweep's folder (output/<sweep file's stem>)"},
     {"--grid"},
     {"--random"},
     {"--latin"},
     {"--repeat", repeat_help},
     {"--skip-invalid"},
     {"--measures", measures_help},
     {"--jobs", "processors of a task, and runs at a time in it (1)"},
     {"--set", "change a value of every run, such as\nsimulate.duration=2; may be repeated"},
     {"--only"},
     {"--seed", seed_help},
     {"--force", "lift the budget"}},
    "SWEEP",
    "a sweep file (YAML), or a scene with --grid",
    "name a sweep file: carom {} sweep.yaml --slurm",
    1,
    1};

}  // namespace carom
