// Lists the runs in named folders and checks that each is complete and unchanged.
// The varied values come from the sweep's file, or else from comparing all scenes, of which one at a time is in memory.
#include "study/run_list.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <tuple>

#include "files/folder_names.h"
#include "files/folder_writer.h"
#include "files/manifest.h"
#include "files/publication.h"
#include "files/run_folder.h"
#include "files/stored_file.h"
#include "scene/expand.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "scene/scene_values.h"
#include "std.h"
#include "study/sweep_folder.h"
#include "yaml/joined.h"
#include "yaml/source.h"

namespace carom {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t longest_hashed = 256 << 20;  // bytes
/// Maximum number of bad folders in the message.
constexpr size_t most_listed = 10;

/// The names in a path, from its end: "r0001", "runs", "sweep".
vector<string> names_of(const string& path) {
  const fs::path whole = fs::path(absolute(path)).lexically_normal();
  vector<string> names;
  for (const fs::path& name : whole)
    if (!name.empty() && name != "/") names.push_back(name.string());
  ranges::reverse(names);
  return names;
}

/// The fault of a run's folder. Empty: it is a complete or a failed run.
string fault_of(ListedRun& run) {
  settle_folder(run.folder);
  const Descriptor folder = open_folder(AT_FDCWD, run.folder, true);
  if (!folder) return "there is no such folder";

  const auto manifest = read_manifest(folder.get(), manifest_name);
  const bool has_summary =
      manifest && any_of(manifest->files, [](const FileRecord& file) { return file.name == summary_name; });
  if (!has_summary) {
    if (stored_size(folder.get(), failure_file)) return "";
    return "it holds no whole run: run its scene again";
  }

  for (const FileRecord& file : manifest->files) {
    // It belongs to a series.
    if (!is_plain_name(file.name)) continue;

    // A file that the comparison reads is checked by its hash, unless that takes long.
    const bool is_read = file.bytes <= longest_hashed &&
                         (file.name.ends_with(".csv") || file.name.ends_with(".csv.gz") || file.name == "scene.yaml");
    const bool same = stored_size(folder.get(), file.name) == file.bytes &&
                      (!is_read || read_record(folder.get(), file.name).value_or(FileRecord{}).sha256 == file.sha256);
    if (!same) return fmt::format("{} has changed since the run: run its scene again", file.name);
  }
  run.done = true;
  return "";
}

/// Sorts r0002 before r0010 and r9999 before r10000: by the text before the last digits, then by their number.
bool is_earlier(const string& a, const string& b) {
  const auto split = [](const string& name) {
    // npos + 1: 0.
    const size_t digits = name.find_last_not_of("0123456789") + 1;
    const size_t first = min(name.find_first_not_of('0', digits), name.size());
    return std::tuple(name.substr(0, digits), name.size() - first, name.substr(first), name);
  };
  return split(a) < split(b);
}

vector<string> runs_of_sweep(const string& folder) {
  vector<string> found;
  const string runs = (fs::path(folder) / "runs").string();
  const Descriptor opened = open_folder(AT_FDCWD, runs, true);
  vector<string> names = opened ? folder_names(opened.get()) : vector<string>();
  ranges::sort(names, is_earlier);
  for (const string& name : names)
    if (is_plain_name(name) && open_folder(opened.get(), name, true)) found.push_back((fs::path(runs) / name).string());
  return found;
}

/// Sets the ids to the last names of the paths. Equal ids are extended by the names before, without `runs`.
void name_all(vector<ListedRun>& runs) {
  vector<vector<string>> names;  // of each folder once
  map<vector<string>, vector<size_t>> folders;
  for (size_t i = 0; i < runs.size(); ++i) {
    vector<string> all = names_of(runs[i].folder);
    if (all.size() > 1) all.erase(std::remove(all.begin() + 1, all.end(), "runs"), all.end());
    const auto [found, fresh] = folders.try_emplace(all);
    found->second.push_back(i);
    if (fresh) names.push_back(std::move(all));
  }

  // Equal ids grow by a name of their paths, until none are equal or the names end.
  vector<string> ids;
  for (const auto& all : names) ids.push_back(all.empty() ? "run" : all[0]);
  vector<size_t> used(names.size(), 1);
  for (bool longer = true; longer;) {
    longer = false;

    map<string, vector<size_t>> same;
    for (size_t k = 0; k < ids.size(); ++k) same[ids[k]].push_back(k);
    for (const auto& [id, numbers] : same) {
      for (const size_t k : numbers) {
        if (numbers.size() < 2 || used[k] >= names[k].size()) continue;
        ids[k] = names[k][used[k]++] + "/" + ids[k];
        longer = true;
      }
    }
  }

  map<string, int> taken;  // counts folders that are named twice
  for (size_t k = 0; k < names.size(); ++k)
    for (const size_t i : folders[names[k]]) {
      const int before = taken[ids[k]]++;
      runs[i].id = before == 0 ? ids[k] : fmt::format("{} ({})", ids[k], before + 1);
    }
}

bool is_parameter(const string& path) {
  return path != "scene" && path != "title" && path != "caption" && !path.starts_with("output.") &&
         !path.starts_with("measures.");
}

/// The numbers of these runs in a sweep, by their ids. Empty if one does not belong to it.
vector<size_t> numbers_in(const Sweep& sweep, const vector<ListedRun>& runs) {
  vector<size_t> numbers;
  // The runs are in the order of the sweep.
  size_t number = 0;
  for (const ListedRun& run : runs) {
    while (number < sweep.size() && sweep.id(number) != run.id) ++number;
    if (number == sweep.size()) return {};
    numbers.push_back(number++);
  }
  return numbers;
}

vector<SceneValue> values_of(const ListedRun& run) {
  const Descriptor folder = open_folder(AT_FDCWD, run.folder, true);
  const auto text = folder ? read_text(folder.get(), "scene.yaml", max_source_bytes) : nullopt;
  if (!text && run.done) throw ExportError(fmt::format("{} has no scene.yaml: run its scene again", run.folder));
  if (!text) return {};
  return scene_values(run.folder + "/scene.yaml", without_tables(*text));
}

}  // namespace

vector<ListedRun> list_runs(const vector<string>& folders, const function<void()>& stop_check) {
  vector<ListedRun> runs;
  for (const string& folder : folders) {
    const vector<string> below = runs_of_sweep(folder);
    for (const string& run : below) runs.push_back({"", run, false});
    if (below.empty()) runs.push_back({"", folder, false});
  }

  vector<string> wrong;
  for (ListedRun& run : runs) {
    stop_check();
    if (const string why = fault_of(run); !why.empty()) wrong.push_back(fmt::format("{}: {}", run.folder, why));
  }

  if (wrong.size() > most_listed) {
    const size_t more = wrong.size() - most_listed;
    wrong.resize(most_listed);
    wrong.push_back(fmt::format("and {} more", more));
  }
  if (!wrong.empty()) throw ExportError(joined(wrong, "\n  "));

  name_all(runs);
  return runs;
}

string digest_of(const vector<ListedRun>& runs, const function<void()>& stop_check) {
  Sha256 hash;
  for (const ListedRun& run : runs) {
    stop_check();
    const Descriptor folder = open_folder(AT_FDCWD, run.folder, true);
    const auto text =
        folder ? read_text(folder.get(), run.done ? manifest_name : failure_file, largest_manifest) : nullopt;
    hash.add(fmt::format("{}\n{}\n", run.id, sha256(text.value_or(""))));
  }
  return hash.hex();
}

namespace {

/// The expressions of runs' scenes. A value follows from `let` if one expression makes it in all of them.
class SharedExpressions {
 public:
  void add(const ListedRun& run) {
    const Descriptor folder = open_folder(AT_FDCWD, run.folder, true);
    const auto manifest = folder ? read_manifest(folder.get(), manifest_name) : nullopt;
    ExpressionTexts own = manifest ? manifest->expressions : ExpressionTexts();
    if (exchange(first_, false)) {
      texts_ = std::move(own);
      return;
    }
    std::erase_if(texts_, [&](const auto& text) {
      const auto found = own.find(text.first);
      return found == own.end() || found->second != text.second;
    });
  }

  /// `everywhere`: all scenes have the path.
  bool make(const string& path, bool everywhere) const {
    const bool exists = everywhere || repeat_of(texts_, path) != nullptr;
    return exists && (!everywhere || expression_at(texts_, path) != nullptr);
  }

 private:
  bool first_ = true;
  ExpressionTexts texts_;
};

}  // namespace

RunSet::RunSet(vector<ListedRun> runs, const function<void()>& stop_check) : runs_(std::move(runs)) {
  SharedExpressions expressions;
  // Of all scenes, each path once, in the order of the first scene with it.
  vector<SceneValue> all;
  map<string, size_t> known;  // its paths

  // By path: the number of scenes with it.
  vector<size_t> counts;
  set<size_t> varying;
  size_t scenes = 0;

  for (const ListedRun& run : runs_) {
    stop_check();
    const vector<SceneValue> values = values_of(run);
    if (values.empty()) continue;
    ++scenes;
    expressions.add(run);

    for (const SceneValue& value : values) {
      if (!is_parameter(value.path)) continue;
      const auto [found, fresh] = known.emplace(value.path, all.size());
      if (fresh) {
        all.push_back(value);
        counts.push_back(0);
      }
      ++counts[found->second];
      if (all[found->second].text != value.text) varying.insert(found->second);
    }
  }

  // A path that a scene lacks varies too.
  for (size_t k = 0; k < all.size(); ++k) {
    if (counts[k] == scenes && !varying.contains(k)) continue;
    if (expressions.make(all[k].path, counts[k] == scenes)) continue;
    numbers_.emplace(all[k].path, parameters_.size());
    parameters_.push_back({all[k].path, all[k].unit});
  }

  // Runs are repeats if, without the seed, there are fewer scenarios than runs.
  const auto seed = numbers_.find("seed");
  if (seed == numbers_.end()) return;

  set<string> scenarios;
  for (size_t i = 0; i < runs_.size(); ++i) {
    Sha256 hash;
    const ComparedRun compared = run(i);
    for (size_t p = 0; p < compared.values.size(); ++p)
      if (p != seed->second) hash.add(compared.values[p] + "\n");
    scenarios.insert(hash.hex());
  }
  if (scenarios.size() < runs_.size()) seed_ = seed->second;
}

RunSet::RunSet(vector<ListedRun> runs, Sweep sweep) : runs_(std::move(runs)) {
  const ComparisonPlan plan = comparison_plan(sweep, {});
  parameters_ = plan.parameters;
  seed_ = plan.seed;
  in_sweep_ = numbers_in(sweep, runs_);
  sweep_ = std::move(sweep);
}

ComparedRun RunSet::run(size_t number) const {
  if (sweep_) return compared_run(*sweep_, in_sweep_[number], runs_[number].folder);
  ComparedRun run{runs_[number].id, runs_[number].folder, vector<string>(parameters_.size())};
  if (parameters_.empty()) return run;
  for (SceneValue& value : values_of(runs_[number]))
    if (const auto found = numbers_.find(value.path); found != numbers_.end())
      run.values[found->second] = std::move(value.text);
  return run;
}

optional<Sweep> sweep_of(const string& folder, const vector<ListedRun>& runs) {
  const string file = (fs::path(folder) / stored_sweep).string();
  if (!is_sweep_file(file)) return nullopt;
  Sweep sweep = load_sweep(file);
  if (runs.empty() || numbers_in(sweep, runs).empty()) return nullopt;
  return sweep;
}

}  // namespace carom
