#pragma once
// Prints the scenes of a command line: each as it ends, and at the end the document of --json or a line of counts.
#include <nlohmann/json.hpp>

#include "commands/scene_outcome.h"
#include "std.h"

namespace carom {

class OutcomeList {
 public:
  explicit OutcomeList(const Options& options) : options_(options) {}

  void add(SceneOutcome outcome);
  /// `wall`: s, of all of them.
  void end(double wall);
  size_t count(const string& status) { return counts_[status]; }

 private:
  string total(double wall);

  const Options& options_;
  nlohmann::ordered_json entries_ = nlohmann::ordered_json::array();
  map<string, size_t> counts_;  // of scenes, by status
};

}  // namespace carom
