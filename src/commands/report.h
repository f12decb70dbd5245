#pragma once
// The form of results: aligned lines, or one JSON document.
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "commands/command_line.h"
#include "commands/plan.h"
#include "run/run_scene.h"

namespace carom {

/// A block of "label  text" lines under a heading, wrapped to the width of stdout's terminal.
class Block {
 public:
  Block(const Palette& palette, std::size_t width) : palette_(palette), width_(width) {}
  void heading(std::string_view name, std::string_view title);
  void line(std::string_view label, std::string_view text);
  /// The same, highlighted.
  void warning(std::string_view label, std::string_view text);
  /// Rows of equal length, the first the heading; the first column left-aligned, numbers right-aligned.
  void table(const std::vector<std::vector<std::string>>& rows);
  const std::string& text() const { return text_; }

 private:
  Palette palette_;
  std::size_t width_;
  std::string text_;
};

/// Names of a whole run's files, sorted, those of frames/ included; empty if there is no whole run.
std::vector<std::string> files_in(const std::string& folder);

/// Warnings of the whole run in a folder.
std::vector<Warning> warnings_in(const std::string& folder);
/// A line for each.
void describe(Block& block, const std::vector<Warning>& warnings);
/// A line about so many runs, if there are any.
void describe_doubtful(Block& block, std::size_t runs);
/// Lines about a finished run.
void describe(Block& block, const PlannedScene& planned, const RunResult& result);
/// The same as JSON members, named as summary.csv's columns are.
nlohmann::ordered_json summary_json(const Summary& summary);
/// A list of objects with the members `code` and `text`.
nlohmann::ordered_json warnings_json(const std::vector<Warning>& warnings);
/// Bodies that met and stayed together; not every member has a column.
nlohmann::ordered_json contact_json(const Summary& summary);
/// J, by force: "forces.0.drag_J".
nlohmann::ordered_json work_json(const Summary& summary);
nlohmann::ordered_json facts_json(const RunResult& result);

/// {"carom": version, "command": ..., "scenes": [...]}, the whole of what --json prints. An object's members stand as
/// they are instead of scenes.
std::string document(std::string_view command, nlohmann::ordered_json scenes);

/// One error to stderr, after the program's name.
void complain(const Options& options, std::string_view text);
/// The same for what is no error. With --quiet nothing is shown.
void remark(const Options& options, std::string_view text);

}  // namespace carom
