// A row has an option's names, its help and the function that stores its value. A new option is one row.
#include "commands/option_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cstdlib>

#include "commands/text.h"
#include "run/measure.h"
#include "scene/output_kinds.h"
#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/joined.h"

namespace carom {

namespace {

using Words = vector<string>;

const string& single(const Words& words, string_view option) {
  if (words.size() > 1) throw UsageError(fmt::format("{} is given {} times", option, words.size()));
  if (words.front().empty()) throw UsageError(fmt::format("{} is given an empty value", option));
  return words.front();
}

template <typename Choice>
Choice chosen(const Words& words, string_view option, span<const string_view> names) {
  const string& word = single(words, option);
  const auto found = ranges::find(names, word);
  if (found == names.end()) {
    throw UsageError(fmt::format("{} takes {}, not {}{}", option, joined(names, ", "), in_backticks(word),
                                 did_you_mean(word, {names.begin(), names.end()})));
  }
  return static_cast<Choice>(found - names.begin());
}

/// None: the text is no such number, or has more than it.
template <typename Number>
optional<Number> parsed(string_view text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end ? optional(value) : nullopt;
}

uint64_t whole(const Words& words, string_view option, uint64_t least, uint64_t most) {
  const string& word = single(words, option);
  const auto value = parsed<uint64_t>(word);
  if (!value || *value < least || *value > most)
    throw UsageError(
        fmt::format("{} takes a whole number from {} to {}, not {}", option, least, most, in_backticks(word)));
  return *value;
}

/// A positive number.
double number(const string& word, string_view option) {
  const auto value = parsed<double>(word);
  if (!value || !(*value > 0) || !isfinite(*value))
    throw UsageError(fmt::format("{} takes a number above 0, not {}", option, in_backticks(word)));
  return *value;
}

/// A time of a run, in s.
double time_of(const string& word, string_view option) {
  const auto value = parsed<double>(word);
  if (!value || !(*value >= 0) || !isfinite(*value))
    throw UsageError(fmt::format("{} takes a time in seconds, such as 1.25, not {}", option, in_backticks(word)));
  return *value;
}

void read_set(Options& options, const Words& words) {
  options.set = words;
  for (const string& set : words) {
    if (const size_t equals = set.find('='); equals == string::npos || equals == 0)
      throw UsageError(fmt::format("--set takes path=value, such as balls.red.mass=2, not {}", in_backticks(set)));
  }
}

/// The parts between commas, of all words. A comma in parentheses separates nothing.
vector<string> split_lists(const Words& words) {
  vector<string> parts;
  for (const string& list : words) {
    int depth = 0;
    parts.emplace_back();

    for (const char c : list) {
      depth += c == '(' ? 1 : c == ')' ? -1 : 0;
      if (c == ',' && depth <= 0)
        parts.emplace_back();
      else
        parts.back() += c;
    }
  }
  return parts;
}

void read_only(Options& options, const Words& words) {
  vector<string> only;
  for (const string& name : split_lists(words)) {
    const auto& known = output_names();
    if (!contains(known, name)) {
      throw UsageError(
          fmt::format("--only takes {}, not {}{}", joined(known, ", "), in_backticks(name), did_you_mean(name, known)));
    }
    if (!contains(only, name)) only.push_back(name);
  }
  options.only = std::move(only);
}

void read_charts(Options& options, const Words& words) {
  for (const string& text : split_lists(words)) {
    const size_t first = text.find(':'), second = text.find(':', first + 1);
    ChartWords chart{text.substr(0, first), {}, {}};
    if (first != string::npos) chart.y = text.substr(first + 1, second - first - 1);
    if (first != string::npos && second != string::npos) chart.by = text.substr(second + 1);
    const bool lacks_by = second != string::npos && first != string::npos && chart.by.empty();
    if (chart.x.empty() || chart.y.empty() || lacks_by || chart.by.find(':') != string::npos)
      throw UsageError(fmt::format("--charts takes x:y or x:y:by, such as restitution.default:energy_lost_J, not {}",
                                   in_backticks(text)));
    options.compare.charts.push_back(std::move(chart));
  }
}

void read_steps(Options& options, const Words& words) {
  constexpr double most_halvings = 30;
  const string& steps = single(words, "--steps");
  const size_t colon = steps.find(':');
  BenchOptions& bench = options.bench;
  bench.longest = number(steps.substr(0, colon), "--steps");
  bench.shortest = colon == string::npos ? bench.longest : number(steps.substr(colon + 1), "--steps");
  if (!(*bench.shortest <= *bench.longest))
    throw UsageError(
        fmt::format("--steps takes the longest and the shortest step, such as 0.1:0.001, not {}", in_backticks(steps)));
  if (std::log2(*bench.longest / *bench.shortest) > most_halvings)
    throw UsageError(
        fmt::format("--steps takes at most {} halvings, fewer than {}", most_halvings, in_backticks(steps)));
}

string_view only_help() {
  constexpr size_t width = 56;  // columns
  static const string text = wrapped(
      fmt::format("write only these outputs, of {}; one that the scene lacks is written with default settings; frames, "
                  "video and sheet take theirs from each other",
                  joined(output_names(), ", ")),
      0, width);
  return text;
}

/// "2/5"
Shard read_shard(const string& word) {
  const string_view text = word;
  const size_t slash = min(text.find('/'), text.size());
  const auto index = parsed<size_t>(text.substr(0, slash));
  const auto count = parsed<size_t>(text.substr(min(slash + 1, text.size())));
  if (!index || !count || *index < 1 || *index > *count)
    throw UsageError(fmt::format("--shard takes I/N, such as 1/4 to 4/4, not {}", in_backticks(word)));
  return {*index, *count};
}

constexpr array<string_view, 4> progress_names = {"auto", "bar", "lines", "none"};
constexpr array<string_view, 3> color_names = {"auto", "always", "never"};
constexpr array<string_view, 2> reference_names = {"exact", "stepped"};

const Option table[] = {
    {"--output", "-o", "DIR",
     "the run's folder; with several scenes, the folder that\nholds theirs (output/<scene file's stem>)",
     [](Options& o, const Words& w) { o.output = single(w, "--output"); }},
    {"--set", "", "PATH=VALUE", "change a value of the scene, such as balls.red.mass=2;\nmay be repeated", read_set},
    {"--only", "", "LIST", only_help(), read_only},
    {"--grid", "", "PATH=FROM:TO:COUNT",
     "vary a value of a scene, restitution.default=0.5:1:6\nor balls.red.mass=1,2,5; several give all combinations;\n"
     "FROM:TO without a count is a range of --random or --latin",
     [](Options& o, const Words& w) {
       for (const string& grid : w)
         if (const size_t equals = grid.find('='); equals == string::npos || equals == 0)
           throw UsageError(
               fmt::format("--grid takes path=from:to:count or path=value,value, not {}", in_backticks(grid)));
       o.sweep.grid = w;
     }},
    {"--random", "", "N",
     "N runs with numbers drawn at random from the ranges\n--grid PATH=FROM:TO or FROM:TO:log (uniform logarithm)",
     [](Options& o, const Words& w) { o.sweep.random = whole(w, "--random", 1, 1'000'000); }},
    {"--latin", "", "N", "the same as a Latin hypercube: a number from each of N\nequal parts of a range",
     [](Options& o, const Words& w) { o.sweep.latin = whole(w, "--latin", 1, 1'000'000); }},
    {"--skip-invalid", "", "", "leave out runs whose scene is invalid, and list them",
     [](Options& o, const Words&) { o.sweep.skip_invalid = true; }},
    {"--shard", "", "I/N",
     "run part I of N, from 1 on; gather joins the parts (in a\nSlurm job array: the task's part)",
     [](Options& o, const Words& w) { o.shard = read_shard(single(w, "--shard")); }},
    {"--slurm", "", "", "write the script for Slurm", [](Options& o, const Words&) { o.submit.slurm = true; }},
    {"--parts", "", "N", "tasks of the array (one for 50 runs, at most 16)",
     [](Options& o, const Words& w) { o.submit.parts = whole(w, "--parts", 1, 1'000'000); }},
    {"--batch", "", "OPTION", "an additional option of sbatch, such as\n--batch=--time=1:00:00; may be repeated",
     [](Options& o, const Words& w) {
       for (const string& option : w)
         if (!option.starts_with("-") || option.find('\n') != string::npos)
           throw UsageError(fmt::format("--batch takes an option of sbatch, such as --batch=--time=1:00:00, not {}",
                                        in_backticks(option)));
       o.submit.batch = w;
     }},
    {"--plan", "", "", "show the runs, their values and which are done",
     [](Options& o, const Words&) { o.sweep.plan = true; }},
    {"--seed", "", "N", "the scene's seed",
     [](Options& o, const Words& w) { o.seed = whole(w, "--seed", 0, numeric_limits<uint64_t>::max()); }},
    {"--steps", "", "FROM:TO", "step sizes in s, from FROM down to TO by halving (set by\nthe scene: ten halvings)",
     read_steps},
    {"--repeat", "", "N", "at most N timed runs of each row (5)",
     [](Options& o, const Words& w) {
       o.sweep.repeat = whole(w, "--repeat", 1, 1'000'000);
       o.bench.repeat = int(*o.sweep.repeat);
     }},
    {"--budget", "", "SECONDS", "approximate CPU time for each scene; steps that cost\nmore are left out (20)",
     [](Options& o, const Words& w) { o.bench.budget = number(single(w, "--budget"), "--budget"); }},
    {"--reference", "", "ENGINE", "exact or stepped (exact, if it supports the scene)",
     [](Options& o, const Words& w) {
       o.bench.reference = chosen<int>(w, "--reference", reference_names) == 0 ? Engine::exact : Engine::stepped;
     },
     reference_names},
    {"--measures", "", "LIST",
     "what to compare: columns of summary.csv, or values at\nthe run's end such as balls.red.speed_m_per_s",
     [](Options& o, const Words& w) { o.compare.measures = split_lists(w); }},
    {"--best", "", "EXPRESSION",
     "the run with the highest value of a measure, or of an\nexpression such as '-energy_lost_J / hits(red)'",
     [](Options& o, const Words& w) { o.sweep.best = measure_text(single(w, "--best")); }},
    {"--charts", "", "LIST", "x:y or x:y:by; x and by are varied paths, y a measure\n(chosen from the varied paths)",
     read_charts},
    {"--collisions", "", "", "a sheet of the workbook with the first collisions of each\nrun",
     [](Options& o, const Words&) { o.compare.collisions = true; }},
    {"--video", "", "", "a film", [](Options& o, const Words&) { o.compare.video = true; }},
    {"--jobs", "-j", "N", "N scenes at a time (1); changes no result",
     [](Options& o, const Words& w) { o.execution.jobs = whole(w, "--jobs", 1, 4096); }},
    {"--threads", "", "N", "threads of each run (its share of the processors); changes\nno result",
     [](Options& o, const Words& w) { o.execution.threads = whole(w, "--threads", 1, 64); }},
    {"--checkpoint", "", "SECONDS",
     "keep a long run so often, so that it goes on from there\nafter an interrupt (60); 0: never",
     [](Options& o, const Words& w) { o.execution.checkpoint_s = time_of(single(w, "--checkpoint"), "--checkpoint"); }},
    {"--force", "", "", "overwrite other content of the folder, run again what\nis up to date, lift the budget",
     [](Options& o, const Words&) { o.force = true; }},
    {"--accuracy", "", "", "the expected error by its sources; takes four or more runs",
     [](Options& o, const Words&) { o.accuracy = true; }},
    {"--verbose", "-v", "", "also the expected error by its sources; takes four or\nmore runs",
     [](Options& o, const Words&) { o.accuracy = true; }},
    {"--watch", "", "", "run scenes again whenever they, their meshes or textures\nare saved, until Ctrl-C",
     [](Options& o, const Words&) { o.execution.watch = true; }},
    {"--at", "", "SECONDS", "draw one picture, at this time",
     [](Options& o, const Words& w) { o.at = time_of(single(w, "--at"), "--at"); }},
    {"--page", "", "", "the whole format as a page of Markdown", [](Options& o, const Words&) { o.page = true; }},
    {"--progress", "", "HOW", "auto, bar, lines or none (auto: a bar on a terminal,\nlines elsewhere)",
     [](Options& o, const Words& w) { o.progress = chosen<ProgressChoice>(w, "--progress", progress_names); },
     progress_names},
    {"--color", "", "WHEN", "auto, always or never (auto: on a terminal, unless\nNO_COLOR is set)",
     [](Options& o, const Words& w) { o.color = chosen<ColorChoice>(w, "--color", color_names); }, color_names},
    {"--json", "", "", "results as one JSON document", [](Options& o, const Words&) { o.json = true; }},
    {"--quiet", "-q", "", "print only errors, and the document of --json",
     [](Options& o, const Words&) { o.quiet = true; }},
};

}  // namespace

span<const Option> all_options() {
  return table;
}

const Option& option_named(string_view name) {
  for (const Option& option : table) {
    if (option.name == name) return option;
  }
  std::abort();  // a command names an option that the table does not have
}

vector<OptionUse> options_of(const Command& command) {
  vector<OptionUse> options = command.options;
  for (const string_view name : {"--color", "--json", "--quiet"}) options.push_back({name});
  for (OptionUse& use : options)
    if (use.help.empty()) use.help = option_named(use.name).help;
  return options;
}

const vector<string>& output_names() {
  static const vector<string> names = [] {
    vector<string> all;
    for (const OutputKind& kind : output_kinds()) all.emplace_back(kind.name);
    return all;
  }();
  return names;
}

string did_you_mean(string_view word, const vector<string>& known) {
  const string name = nearest(word, {known.begin(), known.end()});
  return name.empty() ? "" : fmt::format("; did you mean {}?", in_backticks(name));
}

}  // namespace carom
