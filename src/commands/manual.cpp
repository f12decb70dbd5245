// Writes roff and a bash script from the tables of commands and options. Texts written by hand could lack an option.
#include "commands/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>

#include "commands/commands.h"
#include "commands/option_table.h"
#include "scene/field_places.h"
#include "scene/fields.h"
#include "std.h"
#include "version.h"
#include "yaml/joined.h"

namespace carom {

namespace {

/// Plain text for roff: nothing in it is a request or an escape.
string roff(string_view text) {
  string out;
  bool begins = true;
  for (const char c : text) {
    if (begins && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;

    begins = c == '\n';
  }
  return out;
}

/// Lines without filling.
string example(string_view text) {
  string lines(text);
  while (lines.ends_with('\n')) lines.pop_back();
  return fmt::format(".PP\n.nf\n{}\n.fi\n", roff(lines));
}

/// Paragraphs, filled by roff.
string paragraphs(string_view text) {
  string out;
  for (size_t i = 0; i < text.size();) {
    const size_t end = min(text.find("\n\n", i), text.size());
    out += ".PP\n" + roff(text.substr(i, end - i)) + "\n";
    i = end + 2;
  }
  while (out.ends_with("\n\n")) out.pop_back();
  return out;
}

string option_item(const OptionUse& use) {
  const Option& option = option_named(use.name);
  string names = fmt::format("\\fB{}\\fR", roff(option.name));
  if (!option.letter.empty()) names = fmt::format("\\fB{}\\fR, {}", roff(option.letter), names);
  if (!option.value.empty()) names += fmt::format(" \\fI{}\\fR", roff(option.value));
  return fmt::format(".TP\n{}\n{}\n", names, roff(use.help));
}

bool is_common(string_view name) {
  return name == "--color" || name == "--json" || name == "--quiet";
}

string operands(const Command& command) {
  if (command.most == 0) return "";
  const string word = fmt::format("\\fI{}\\fR{}", roff(command.operand), command.most > 1 ? "..." : "");
  return command.least == 0 ? fmt::format(" [{}]", word) : " " + word;
}

string command_section(const Command& command) {
  string out = fmt::format(
      ".SS carom {}\n.B carom {}\\fR{} [\\fIOPTIONS\\fR]\n.PP\n{}{}.\n", roff(command.name), roff(command.name),
      operands(command), char(std::toupper(static_cast<unsigned char>(command.line[0]))), roff(command.line.substr(1)));
  out += example(command.examples);
  if (!command.notes.empty()) out += paragraphs(command.notes);
  for (const OptionUse& use : options_of(command))
    if (!is_common(use.name)) out += option_item(use);
  return out;
}

/// A word list for the shell.
template <typename Words>
string list(const Words& words) {
  return joined(words, " ");
}

/// Completion of an operand or a value of this name; empty: none.
string offer_for(string_view name) {
  const auto words = [](string_view all) { return fmt::format("_carom_words '{}'", all); };
  if (name == "DIR") return "_carom_files -d";
  if (name == "SCENE" || name == "SWEEP") return "_carom_files -f -X '!*.@(yaml|yml)'";
  if (name == "KEY") return words(list(plain_paths()));
  if (name == "PATH=VALUE" || name == "PATH=FROM:TO:COUNT")
    return fmt::format("_carom_paths '{}'", list(settable_paths()));
  if (name == "KIND") {
    vector<string_view> kinds;
    for (const span<const Kind> family : families()) kinds.push_back(family.front().name);
    return words(list(kinds));
  }
  return "";
}

string offer_for(const Option& option) {
  if (option.name == "--only") return fmt::format("_carom_list '{}'", list(output_names()));
  if (!option.choices.empty()) return fmt::format("_carom_words '{}'", list(option.choices));
  return offer_for(option.value);
}

/// With the names of the commands, and the cases of each and of the options with a value.
constexpr auto completion_script = R"(# bash completion for carom
_carom_words() {{ mapfile -t COMPREPLY < <(compgen -W "$1" -- "$word"); }}
# A list's next word, after its last comma.
_carom_list() {{
  local head=
  case $word in *,*) head=${{word%,*}}, ;; esac
  mapfile -t COMPREPLY < <(compgen -W "$1" -P "$head" -- "${{word#"$head"}}")
  compopt -o nospace
}}
# Paths of a scene, each followed by its value.
_carom_paths() {{
  mapfile -t COMPREPLY < <(compgen -W "$1" -S = -- "$word")
  compopt -o nospace
}}
# Files of a kind, and folders on the way to them.
_carom_files() {{
  local IFS=$'\n' extglob
  extglob=$(shopt -p extglob)
  shopt -s extglob
  mapfile -t COMPREPLY < <(compgen "$@" -- "$word" && [ "$1" = -d ] || compgen -d -- "$word")
  eval "$extglob"
  compopt -o filenames
}}
_carom() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} command=${{COMP_WORDS[1]}} options operand
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    _carom_words '{0} help --help --version --man --bash-completion'
    return
  fi
  # "--color=never" comes as three words.
  if [ "$word" = = ]; then
    word=
  elif [ "$before" = = ]; then
    before=${{COMP_WORDS[COMP_CWORD - 2]}}
  fi
  case $before in
{2}  esac
  case $command in
    help) operand="_carom_words '{0}'" ;;
{1}  esac
  case $word in
    -*) _carom_words "$options" ;;
    *) eval "$operand" ;;
  esac
}}
complete -F _carom carom
)";

}  // namespace

string manual_page() {
  string out = fmt::format(
      ".TH CAROM 1 \"\" \"carom {}\" \"User Commands\"\n"
      ".SH NAME\ncarom \\- exact motion of colliding balls, walls and planes, as data and pictures\n"
      ".SH SYNOPSIS\n.B carom\n\\fICOMMAND\\fR [\\fIOPERAND\\fR...] [\\fIOPTIONS\\fR]\n.br\n.B carom\n\\-\\-help | "
      "\\-\\-version | help \\fICOMMAND\\fR\n"
      ".SH DESCRIPTION\nCarom reads scenes of balls, walls and planes in YAML. It computes their motion from collision "
      "to "
      "collision in closed form, or in time steps, and writes CSV tables, pictures and films.\n"
      "Results go to standard output, progress and errors to standard error.\n"
      ".SH COMMANDS\n",
      program_version);

  for (const Command& command : commands()) out += command_section(command);
  out += ".SH OPTIONS OF EVERY COMMAND\n";
  for (const string_view name : {"--color", "--json", "--quiet"}) out += option_item({name, option_named(name).help});
  out += ".TP\n\\fB\\-h\\fR, \\fB\\-\\-help\\fR\nthe help of the command, examples first\n";

  out +=
      ".SH EXIT STATUS\n"
      ".TP\n0\ndone; also: up to date, nothing to do\n"
      ".TP\n1\nthe run failed\n"
      ".TP\n2\nthe command line or a scene is wrong; nothing was run\n"
      ".TP\n3\na sweep is done and some of its runs failed\n"
      ".TP\n130, 143\ninterrupted; finished files stay, and the same command resumes\n"
      ".SH ENVIRONMENT\n"
      ".TP\nNO_COLOR\nset and not empty: no colour, unless \\-\\-color always\n"
      ".TP\nSLURM_ARRAY_TASK_ID, SLURM_ARRAY_TASK_COUNT\nset by a Slurm job array: the part of a sweep to "
      "run\n"
      ".SH FILES\n"
      ".TP\noutput/<scene file's stem>/\nthe files of a run, without \\-o\n";

  return out;
}

string bash_completion() {
  vector<string> names;
  string of_command, of_value;

  // What each command takes, and each option.
  for (const Command& command : commands()) {
    names.push_back(command.name);
    vector<string_view> options;
    for (const OptionUse& use : options_of(command)) {
      const Option& option = option_named(use.name);
      options.push_back(option.name);
      if (!option.letter.empty()) options.push_back(option.letter);
    }
    const string offer = command.most > 0 ? offer_for(command.operand) : "";
    of_command += fmt::format("    {}) options='{} --help -h' operand=\"{}\" ;;\n", command.name, list(options), offer);
  }

  for (const Option& option : all_options()) {
    if (option.value.empty()) continue;
    const string both =
        option.letter.empty() ? string(option.name) : fmt::format("{} | {}", option.letter, option.name);
    const string offer = offer_for(option);
    of_value += fmt::format("    {}) {}return ;;\n", both, offer.empty() ? "" : offer + "; ");
  }
  return fmt::format(completion_script, list(names), of_command, of_value);
}

}  // namespace carom
