// Exceptions that leave a command become a line on stderr and an exit code here, the same for all commands.
#include "commands/program.h"

#include <fmt/format.h>

#include "commands/command_line.h"
#include "commands/commands.h"
#include "commands/error_list.h"
#include "commands/interrupt.h"
#include "commands/manual.h"
#include "commands/report.h"
#include "commands/text.h"
#include "std.h"
#include "version.h"
#include "yaml/diagnostics.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

// "run, check and bench"
string command_names() {
  vector<string> names;
  for (const Command& command : commands()) names.push_back(command.name);
  return listed(names, names.size());
}

string program_help() {
  string text =
      "carom turns scenes of balls, walls and planes into exact motion, data and pictures.\n\n"
      "Examples:\n"
      "  carom new first                               writes first.yaml, a scene to start from\n"
      "  carom check scenes/two_bowling_balls.yaml     what a run would do, and every error\n"
      "  carom run scenes/two_bowling_balls.yaml       writes output/two_bowling_balls/\n"
      "  carom run scenes/*.yaml --only collisions     many scenes, only their collisions\n\n"
      "Usage:\n"
      "  carom COMMAND SCENE... [OPTIONS]\n\n"
      "Commands:\n";

  for (const Command& command : commands()) text += fmt::format("  {:24}{}\n", command.name, command.line);
  text +=
      "\nOptions:\n"
      "  -h,--help               this help; after a command, its own\n"
      "  --version               the version, and the commit that it was built from\n"
      "  --man                   the manual page, as man reads it: carom --man | man -l -\n"
      "  --bash-completion       completion for bash: source <(carom --bash-completion)\n";
  return text;
}

const Command* find_command(const string& name) {
  for (const Command& command : commands()) {
    if (command.name == name) return &command;
  }
  return nullptr;
}

[[noreturn]] void refuse_command(const string& word) {
  if (word.starts_with('-')) {
    throw UsageError("options come after the command", fmt::format("carom run SCENE {}", printable(word)));
  }
  vector<string_view> names = {"help"};
  for (const Command& command : commands()) names.push_back(command.name);
  if (const string near = nearest(word, names); !near.empty()) {
    throw UsageError(fmt::format("no command {}; did you mean {}?", in_backticks(word), in_backticks(near)));
  }
  if (word.ends_with(".yaml") || word.ends_with(".yml")) {
    throw UsageError("name a command first", fmt::format("carom run {}", printable(word)));
  }
  throw UsageError(fmt::format("no command {}; the commands are {}", in_backticks(word), command_names()));
}

/// The document of --json for an error that leaves a command without one.
void write_failure(const vector<string>& words, string_view status, const vector<ErrorRecord>& errors) {
  if (!contains(words, "--json") || find_command(words.front()) == nullptr) return;
  Json json = {{"status", string(status)}};
  if (!errors.empty()) json["errors"] = errors_json(errors);
  write_out(document(words.front(), std::move(json)));
}

int usage_error(const string& command, const UsageError& error, const vector<string>& words) {
  const string program = command.empty() ? "carom" : "carom " + command;
  write_failure(words, "wrong", {{"", 0, 0, error.fault, error.remedy, suggestion_in(error.what())}});
  write_err(fmt::format("{}: {}\n  {} --help shows how it is used\n", program, error.what(), program));
  return 2;
}

int dispatch(const vector<string>& words, const string& commit) {
  string name;
  try {
    if (words.empty()) {
      write_err(program_help());
      return 2;
    }

    // What is said without a command.
    string first = words.front();
    vector<string> rest(words.begin() + 1, words.end());
    if (first == "--version") {
      write_out(fmt::format("{}{}\n", program_and_version, commit.empty() ? "" : fmt::format(" ({})", commit)));
      return 0;
    }
    if (first == "--man" || first == "--bash-completion") {
      write_out(first == "--man" ? manual_page() : bash_completion());
      return 0;
    }

    if (first == "help" && !rest.empty()) {  // carom help run
      first = rest.front();
      rest = {"--help"};
    }
    if (first == "--help" || first == "-h" || first == "help") {
      write_out(program_help());
      return 0;
    }

    const Command* command = find_command(first);
    if (command == nullptr) refuse_command(first);
    name = first;
    const ParsedOptions parsed = parse_options(*command, rest);
    if (parsed.help) {
      write_out(*parsed.help);
      return 0;
    }
    return command->run(parsed.options);
  } catch (const UsageError& error) {
    return usage_error(name, error, words);
  }
}

int guarded(const vector<string>& words, const string& commit) {
  try {
    return dispatch(words, commit);
  } catch (const Interrupted& interrupted) {
    write_failure(words, "interrupted", {});
    write_err("carom: interrupted\n");
    return interrupted.exit_code();
  } catch (const std::exception& error) {
    write_failure(words, "failed", error_of_text(reason_of(error)));
    write_err(fmt::format("carom: {}\n", reason_of(error)));
    return 1;
  }
}

}  // namespace

int run_program(const vector<string>& words, const string& commit) {
  const int code = guarded(words, commit);
  string reason;
  if (finish_output(reason)) return code;
  write_err(fmt::format("carom: cannot write to standard output: {}\n", reason));
  return code == 0 ? 1 : code;
}

}  // namespace carom
