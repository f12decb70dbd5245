#pragma once
// Folders that were named -> the runs in them, and in which values their scenes differ.
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compare/comparison.h"
#include "scene/sweep.h"

namespace carom {

/// A run's folder, and what it is called beside the others.
struct ListedRun {
  std::string id, folder;
  bool done = false;  // false: it failed, by its error.txt
};

/// The runs of folders: each is a run's, or a sweep's, and then its runs/* are meant. Ids are the folders' names, with
/// more of the path where two are the same. Throws ExportError, which tells of every folder that is neither.
/// `look`: called often, may throw; so below.
std::vector<ListedRun> list_runs(
    const std::vector<std::string>& folders, const std::function<void()>& look = [] {});

/// SHA-256 of all that says which runs these are: ids and manifests.
std::string digest_of(
    const std::vector<ListedRun>& runs, const std::function<void()>& look = [] {});

/// Runs and what was varied in them.
class RunSet {
 public:
  /// What their scenes differ in, found with one of them in memory. Title and outputs are no parameters.
  explicit RunSet(
      std::vector<ListedRun> runs, const std::function<void()>& look = [] {});
  /// What the sweep varied whose runs these are, as its file says.
  RunSet(std::vector<ListedRun> runs, Sweep sweep);

  const std::vector<Parameter>& parameters() const { return parameters_; }
  /// The seed's number among the parameters, if runs differ in nothing else: repeats.
  std::optional<std::size_t> seed() const { return seed_; }
  const std::vector<ListedRun>& runs() const { return runs_; }
  /// Run `number` with its values; those that its scene does not have are empty.
  ComparedRun run(std::size_t number) const;

 private:
  std::vector<ListedRun> runs_;
  std::vector<Parameter> parameters_;
  std::map<std::string, std::size_t> numbers_;  // of parameters, by path
  std::optional<std::size_t> seed_;
  std::optional<Sweep> sweep_;
  std::vector<std::size_t> in_sweep_;  // by run: its number in the sweep
};

/// The sweep whose folder this is and whose runs, all of them, these are; none if it is no sweep's.
std::optional<Sweep> sweep_of(const std::string& folder, const std::vector<ListedRun>& runs);

}  // namespace carom
