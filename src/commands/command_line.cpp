// Declares the options of the table to CLI11 and replaces its texts. Its own texts name types of options and no
// remedies.
#include "commands/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "commands/option_table.h"
#include "std.h"
#include "yaml/diagnostics.h"

namespace carom {

namespace {

string operands_text(const Command& command) {
  if (command.most == 0) return "";
  const string text = " " + command.operand + (command.most > 1 ? "..." : "");
  return command.least == 0 ? " [" + text.substr(1) + "]" : text;
}

// Examples first, then usage, and option lines without CLI11's notes on types and repetition.
class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(const Command& command) : command_(command) {
    column_width(26);
    label("Positionals", "Operands");
  }
  string make_description(const CLI::App*) const override {
    return fmt::format("carom {}: {}\n\nExamples:\n{}", command_.name, command_.line, command_.examples);
  }
  string make_usage(const CLI::App*, string) const override {
    return fmt::format("\nUsage:\n  carom {}{} [OPTIONS]\n", command_.name, operands_text(command_));
  }
  string make_option_opts(const CLI::Option* option) const override {
    const string value = option->get_type_name();
    return value.empty() || option->get_positional() ? "" : " " + value;
  }

 private:
  const Command& command_;
};

/// An option of the table and its values on the command line; it may be repeated until it is read.
struct Given {
  OptionUse use;
  vector<string> words;
};

void add_option(CLI::App& app, Given& given) {
  const Option& option = option_named(given.use.name);
  const string names = option.letter.empty() ? string(option.name) : fmt::format("{},{}", option.letter, option.name);
  const string help(given.use.help);

  if (option.value.empty()) {
    app.add_flag_function(
           names, [&given](int64_t count) { given.words.assign(size_t(count), ""); }, help)
        ->disable_flag_override();
    return;
  }

  app.add_option(names, given.words, help)
      ->type_name(string(option.value))
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

// "-output x" would parse as "-o utput": a long option after a single dash is an error.
void refuse_single_dash(const CLI::App& app, const vector<string>& words) {
  for (const string& word : words) {
    if (word == "--") return;
    if (word.size() < 4 || word[0] != '-' || word[1] == '-') continue;
    const string name = word.substr(1, word.find('=') - 1);
    for (const CLI::Option* option : app.get_options()) {
      if (option->check_lname(name)) {
        throw UsageError(fmt::format("no option {}; did you mean `--{}`?", in_backticks(word), name));
      }
    }
  }
}

void refuse_unknown(const CLI::App& app) {
  const vector<string> extras = app.remaining();
  if (extras.empty()) return;
  vector<string> known;
  for (const CLI::Option* option : app.get_options()) {
    for (const string& name : option->get_lnames()) known.push_back("--" + name);
  }
  const string word = extras.front().substr(0, extras.front().find('='));
  throw UsageError(
      fmt::format("no option {}{}", in_backticks(word), word.starts_with("--") ? did_you_mean(word, known) : ""));
}

// CLI11's texts begin with the option's name; the error is a missing value or one too many.
string in_our_words(const CLI::ParseError& error) {
  const string text = error.what();
  string name = text.substr(0, text.find_first_of(": "));
  if (!name.starts_with('-')) name.insert(0, "--");
  if (text.find("disallowed flag override") != string::npos) return fmt::format("{} takes no value", name);
  if (error.get_name() == "ArgumentMismatch") return fmt::format("{} needs a value", name);
  return text;
}

void check_operands(const Command& command, const vector<string>& operands) {
  if (operands.size() < command.least) throw UsageError(fmt::format(fmt::runtime(command.missing), command.name));
  if (operands.size() <= command.most) return;
  const string& extra = operands[command.most];
  throw UsageError(command.most == 0
                       ? fmt::format("unexpected {}", in_backticks(extra))
                       : fmt::format("it takes {}, not {} too",
                                     command.most == 1 ? "one " + command.operand
                                                       : fmt::format("{} {}", command.most, command.operand),
                                     in_backticks(extra)));
}

}  // namespace

ParsedOptions parse_options(const Command& command, const vector<string>& words) {
  CLI::App app;
  app.formatter(make_shared<HelpFormatter>(command));
  app.set_help_flag("-h,--help", "show this help");
  app.allow_extras();
  if (!command.notes.empty()) app.footer(command.notes);

  ParsedOptions parsed;
  Options& options = parsed.options;
  options.command = command.name;
  if (command.most > 0) app.add_option(command.operand, options.operands, command.operand_help)->type_name("");
  vector<Given> given;
  for (const OptionUse& use : options_of(command)) given.push_back({use, {}});
  for (Given& option : given) add_option(app, option);
  refuse_single_dash(app, words);

  // Every word after "--" is an operand.
  const auto mark = ranges::find(words, "--");
  try {
    // CLI11 reads from the back.
    app.parse(vector<string>(std::reverse_iterator(mark), words.rend()));
  } catch (const CLI::CallForHelp&) {
    parsed.help = app.help();
    return parsed;
  } catch (const CLI::ParseError& error) {
    refuse_unknown(app);
    throw UsageError(in_our_words(error));
  }

  refuse_unknown(app);
  if (mark != words.end()) options.operands.insert(options.operands.end(), mark + 1, words.end());
  for (const Given& option : given)
    if (!option.words.empty()) option_named(option.use.name).read(options, option.words);
  check_operands(command, options.operands);
  return parsed;
}

}  // namespace carom
