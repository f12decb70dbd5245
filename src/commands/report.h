#pragma once
// The form of results: aligned lines, or one JSON document.
#include <nlohmann/json.hpp>

#include "commands/options.h"
#include "commands/plan.h"
#include "run/run_scene.h"
#include "std.h"

namespace carom {

/// A block of "label  text" lines under a heading, wrapped to the width of stdout's terminal.
class Block {
 public:
  Block(const Palette& palette, size_t width) : palette_(palette), width_(width) {}
  explicit Block(const Options& options);
  void heading(string_view name, string_view title);
  void line(string_view label, string_view text);
  /// The same, highlighted.
  void warning(string_view label, string_view text);
  /// Rows of equal length, the first the heading; the first column left-aligned, numbers right-aligned.
  void table(const vector<vector<string>>& rows);
  const string& text() const { return text_; }

 private:
  Palette palette_;
  size_t width_;
  string text_;
};

/// Names of a whole run's files, sorted, those of frames/ included; empty if there is no whole run.
vector<string> files_in(const string& folder);

/// Warnings of the whole run in a folder.
vector<Warning> warnings_in(const string& folder);
/// A line for each.
void describe(Block& block, const vector<Warning>& warnings);
/// A line about so many runs, if there are any.
void describe_doubtful(Block& block, size_t runs);
/// Lines about a finished run.
void describe(Block& block, const PlannedScene& planned, const RunResult& result);
/// The columns of summary.csv as JSON members.
nlohmann::ordered_json summary_json(const Summary& summary);
/// A list of objects with the members `code` and `text`.
nlohmann::ordered_json warnings_json(const vector<Warning>& warnings);
/// Counts of contact, merges and impacts at once; most have no column.
nlohmann::ordered_json contact_json(const Summary& summary);
/// J, by force: "forces.0.drag_J".
nlohmann::ordered_json work_json(const Summary& summary);
nlohmann::ordered_json events_json(const Summary& summary);
/// Wall times, and the memory at its peak. What is neither simulation nor drawing counts as writing.
nlohmann::ordered_json times_json(const RunResult& result);

/// {"carom": version, "command": ..., ...}, the whole of what --json prints. An array becomes the member `scenes`; an
/// object's members are added to the document.
string document(string_view command, nlohmann::ordered_json members);

/// The end of a command: with --json its document of these scenes or members, else the text, unless --quiet. Returns
/// `code`.
int print_end(const Options& options, int code, nlohmann::ordered_json members, string_view text = {});
/// The end of one that does nothing: a line on stderr, and the status and the errors after these members. Returns 2.
int print_refusal(const Options& options, string_view complaint, nlohmann::ordered_json members,
                  const vector<ErrorRecord>& errors);

/// One error to stderr, after the program's name.
void complain(const Options& options, string_view text);
/// The same for what is no error. With --quiet nothing is shown.
void remark(const Options& options, string_view text);

}  // namespace carom
