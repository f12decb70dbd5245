#include "commands/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "commands/text.h"
#include "scene/diagnostics.h"
#include "scene/output.h"

namespace carom {

namespace {

constexpr std::size_t help_width = 56;  // columns of an option's text

// Examples first, then usage, and option lines without CLI11's notes on types and repetition.
class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(const CommandText& command) : command_(command) {
    column_width(26);
    label("Positionals", "Scenes");
  }
  std::string make_description(const CLI::App*) const override {
    return fmt::format("carom {}: {}\n\nExamples:\n{}", command_.name, command_.line, command_.examples);
  }
  std::string make_usage(const CLI::App*, std::string) const override {
    return fmt::format("\nUsage:\n  carom {} SCENE... [OPTIONS]\n", command_.name);
  }
  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string value = option->get_type_name();
    return value.empty() || option->get_positional() ? "" : " " + value;
  }

 private:
  const CommandText& command_;
};

/// Words of the command line by option; every option that takes a value may come several times until it is read.
struct Words {
  std::vector<std::string> scenes, output, set, only, seed, jobs, progress, color;
  std::vector<std::string> steps, repeat, budget, reference;  // of bench
  bool force = false, quiet = false, json = false;
};

CLI::Option* add_value(CLI::App& app, const std::string& names, std::vector<std::string>& words,
                       const std::string& type, const std::string& help) {
  return app.add_option(names, words, help)
      ->type_name(type)
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_options(CLI::App& app, const CommandText& command, Words& words) {
  app.add_option("SCENE", words.scenes, "scene files (YAML)")->type_name("");
  add_value(
      app, "-o,--output", words.output, "DIR",
      fmt::format("the {}'s folder; with several scenes, the folder that\nholds theirs (output/<scene file's stem>{})",
                  command.bench ? "bench" : "run", command.bench ? ".bench" : ""));
  add_value(app, "--set", words.set, "PATH=VALUE",
            "change a value of the scene, balls.red.mass=2 say;\nmay be repeated");
  if (command.outputs)
    add_value(
        app, "--only", words.only, "LIST",
        wrapped(fmt::format("write these outputs alone, of {}; one that the scene does not ask for is written with "
                            "default settings",
                            fmt::join(output_names(), ", ")),
                0, help_width));
  add_value(app, "--seed", words.seed, "N", "the scene's seed");
  if (command.bench) {
    add_value(app, "--steps", words.steps, "FROM:TO",
              "step sizes in s, from FROM down to TO by halves (by\nthe scene: ten halvings)");
    add_value(app, "--repeat", words.repeat, "N", "timed runs of each row, at most (5)");
    add_value(app, "--budget", words.budget, "SECONDS",
              "of CPU time for each scene, roughly; steps that cost\nmore are left out (20)");
    add_value(app, "--reference", words.reference, "ENGINE",
              "exact or stepped (exact, if it has all that the scene\nasks for)");
  }
  if (command.progress) {
    add_value(app, "-j,--jobs", words.jobs, "N", "at most N scenes at a time; changes no result");
    app.add_flag("--force", words.force,
                 command.bench
                     ? "overwrite other content of the folder"
                     : "overwrite other content of the folder, run again what\nis up to date, lift the budget")
        ->disable_flag_override();
    add_value(app, "--progress", words.progress, "HOW",
              "auto, bar, lines or none (auto: a bar on a terminal,\nlines elsewhere)");
  } else {
    app.add_flag("--force", words.force, "lift the budget")->disable_flag_override();
  }
  add_value(app, "--color", words.color, "WHEN",
            "auto, always or never (auto: on a terminal, unless\nNO_COLOR is set)");
  app.add_flag("--json", words.json, "results as one JSON document")->disable_flag_override();
  app.add_flag("-q,--quiet", words.quiet, "nothing but errors, and the document of --json")->disable_flag_override();
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  const std::string name = nearest(word, {known.begin(), known.end()});
  return name.empty() ? "" : fmt::format("; did you mean {}?", carom::quoted(name));
}

// "-output x" would read as "-o utput": a long option after a single dash is never meant so.
void refuse_single_dash(const CLI::App& app, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (word == "--") return;
    if (word.size() < 4 || word[0] != '-' || word[1] == '-') continue;
    const std::string name = word.substr(1, word.find('=') - 1);
    for (const CLI::Option* option : app.get_options()) {
      if (option->check_lname(name)) {
        throw UsageError(fmt::format("no option {}; did you mean `--{}`?", carom::quoted(word), name));
      }
    }
  }
}

void refuse_unknown(const CLI::App& app) {
  const std::vector<std::string> extras = app.remaining();
  if (extras.empty()) return;
  std::vector<std::string> known;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  const std::string word = extras.front().substr(0, extras.front().find('='));
  throw UsageError(
      fmt::format("no option {}{}", carom::quoted(word), word.starts_with("--") ? did_you_mean(word, known) : ""));
}

std::optional<std::string> single(const std::vector<std::string>& words, std::string_view option) {
  if (words.empty()) return std::nullopt;
  if (words.size() > 1) throw UsageError(fmt::format("{} is given {} times", option, words.size()));
  if (words.front().empty()) throw UsageError(fmt::format("{} is given an empty value", option));
  return words.front();
}

template <typename Choice>
Choice chosen(const std::vector<std::string>& words, std::string_view option, const std::vector<std::string>& names) {
  const std::optional<std::string> word = single(words, option);
  if (!word) return Choice{};
  const auto found = std::find(names.begin(), names.end(), *word);
  if (found == names.end()) {
    throw UsageError(fmt::format("{} is {}, not {}{}", option, fmt::join(names, ", "), carom::quoted(*word),
                                 did_you_mean(*word, names)));
  }
  return static_cast<Choice>(found - names.begin());
}

std::optional<std::uint64_t> read_whole(const std::vector<std::string>& words, std::string_view option,
                                        std::uint64_t least, std::uint64_t most) {
  const std::optional<std::string> word = single(words, option);
  if (!word) return std::nullopt;
  std::uint64_t value = 0;
  const char* end = word->data() + word->size();
  const auto [stop, error] = std::from_chars(word->data(), end, value);
  if (error != std::errc() || stop != end || value < least || value > most) {
    throw UsageError(
        fmt::format("{} is a whole number from {} to {}, not {}", option, least, most, carom::quoted(*word)));
  }
  return value;
}

/// A positive number.
double read_number(const std::string& word, std::string_view option) {
  double value = 0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stop != end || !(value > 0) || !std::isfinite(value))
    throw UsageError(fmt::format("{} takes a number above 0, not {}", option, carom::quoted(word)));
  return value;
}

BenchOptions read_bench(const Words& words) {
  constexpr double most_halvings = 30;
  BenchOptions bench;
  if (const auto steps = single(words.steps, "--steps")) {
    const std::size_t colon = steps->find(':');
    bench.longest = read_number(steps->substr(0, colon), "--steps");
    bench.shortest = colon == std::string::npos ? bench.longest : read_number(steps->substr(colon + 1), "--steps");
    if (!(*bench.shortest <= *bench.longest))
      throw UsageError(fmt::format("--steps goes from the longest step to the shortest, 0.1:0.001 say, not {}",
                                   carom::quoted(*steps)));
    if (std::log2(*bench.longest / *bench.shortest) > most_halvings)
      throw UsageError(
          fmt::format("--steps halves at most {} times, not as often as {}", most_halvings, carom::quoted(*steps)));
  }
  bench.repeat = static_cast<int>(read_whole(words.repeat, "--repeat", 1, 1000).value_or(5));
  if (const auto budget = single(words.budget, "--budget")) bench.budget = read_number(*budget, "--budget");
  if (!words.reference.empty())
    bench.reference =
        chosen<int>(words.reference, "--reference", {"exact", "stepped"}) == 0 ? Engine::exact : Engine::stepped;
  return bench;
}

std::optional<std::vector<std::string>> read_only(const std::vector<std::string>& words) {
  if (words.empty()) return std::nullopt;
  std::vector<std::string> only;
  for (const std::string& list : words) {
    for (std::size_t begin = 0; begin <= list.size();) {
      const std::size_t end = std::min(list.find(',', begin), list.size());
      const std::string name = list.substr(begin, end - begin);
      begin = end + 1;
      const auto& known = output_names();
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        throw UsageError(fmt::format("--only takes {}, not {}{}", fmt::join(known, ", "), carom::quoted(name),
                                     did_you_mean(name, known)));
      }
      if (std::find(only.begin(), only.end(), name) == only.end()) only.push_back(name);
    }
  }
  return only;
}

Options read(const CommandText& command, const Words& words) {
  Options options;
  options.scenes = words.scenes;
  options.output = single(words.output, "--output");
  options.set = words.set;
  for (const std::string& set : words.set) {
    if (const std::size_t equals = set.find('='); equals == std::string::npos || equals == 0) {
      throw UsageError(fmt::format("--set takes path=value, balls.red.mass=2 say, not {}", carom::quoted(set)));
    }
  }
  options.only = read_only(words.only);
  options.seed = read_whole(words.seed, "--seed", 0, std::numeric_limits<std::uint64_t>::max());
  options.jobs = read_whole(words.jobs, "--jobs", 1, 4096).value_or(options.jobs);
  options.progress = chosen<ProgressChoice>(words.progress, "--progress", {"auto", "bar", "lines", "none"});
  options.color = chosen<ColorChoice>(words.color, "--color", {"auto", "always", "never"});
  options.bench = read_bench(words);
  options.force = words.force;
  options.quiet = words.quiet;
  options.json = words.json;
  if (options.scenes.empty()) {
    throw UsageError(fmt::format("name a scene file: carom {} scenes/two_bowling_balls.yaml", command.name));
  }
  return options;
}

// CLI11's texts begin with the option's name; what it minds is either a value too few or one too many.
std::string in_our_words(const CLI::ParseError& error) {
  const std::string text = error.what();
  std::string name = text.substr(0, text.find_first_of(": "));
  if (!name.starts_with('-')) name.insert(0, "--");
  if (text.find("disallowed flag override") != std::string::npos) return fmt::format("{} takes no value", name);
  if (error.get_name() == "ArgumentMismatch") return fmt::format("{} needs a value", name);
  return text;
}

}  // namespace

const std::vector<std::string>& output_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const OutputKind& kind : output_kinds()) all.emplace_back(kind.name);
    return all;
  }();
  return names;
}

ParsedOptions parse_options(const CommandText& command, const std::vector<std::string>& words) {
  CLI::App app;
  app.formatter(std::make_shared<HelpFormatter>(command));
  app.set_help_flag("-h,--help", "this text");
  app.allow_extras();
  if (!command.notes.empty()) app.footer(command.notes);
  Words found;
  add_options(app, command, found);
  refuse_single_dash(app, words);
  const auto mark = std::find(words.begin(), words.end(), "--");  // all that follows is scenes
  try {
    app.parse(std::vector<std::string>(std::reverse_iterator(mark), words.rend()));  // CLI11 reads from the back
  } catch (const CLI::CallForHelp&) {
    return {{}, app.help()};
  } catch (const CLI::ParseError& error) {
    refuse_unknown(app);
    throw UsageError(in_our_words(error));
  }
  refuse_unknown(app);
  if (mark != words.end()) found.scenes.insert(found.scenes.end(), mark + 1, words.end());
  return {read(command, found), std::nullopt};
}

}  // namespace carom
