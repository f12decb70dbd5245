// Compares collisions.csv row by row as text, because equal runs have equal bytes.
// Positions at the end come from the last rows of trajectory.csv, so that only the end of a large file is read.
#include "study/run_difference.h"

#include <fmt/format.h>

#include <tuple>

#include "compare/compared_run.h"
#include "compare/end_of_trajectory.h"
#include "files/run_folder.h"
#include "files/stored_file.h"
#include "std.h"

namespace carom {
namespace {

/// The rows of collisions.csv in order.
class Collisions {
 public:
  explicit Collisions(const RunRecord& run) : table_(open_table(run, "collisions.csv")) {
    for (const char* name : {"time_s", "kind", "a", "b", "separation_speed_m_per_s"})
      columns_.push_back(table_.find(name));
  }

  bool next() {
    cells_ = table_.next();
    count_ += is_collision() ? 1 : 0;
    return cells_ != nullptr;
  }

  uint64_t count() const { return count_; }  // collisions so far
  bool is_collision() const { return cells_ != nullptr && cell(1) != "rest"; }
  bool ended() const { return cells_ == nullptr; }

  CollisionFacts facts() const {
    return {number_in(cell(0)).value_or(0), string(cell(1)), string(cell(2)), string(cell(3)),
            number_in(cell(4)).value_or(0)};
  }
  bool is_same(const Collisions& other) const {
    return cell(0) == other.cell(0) && cell(1) == other.cell(1) && cell(2) == other.cell(2) && cell(3) == other.cell(3);
  }
  bool ends_the_same(const Collisions& other) const { return *cells_ == *other.cells_; }
  /// The first column with different cells, and the two cells.
  std::tuple<string, string, string> first_difference(const Collisions& other) const {
    size_t column = columns_[4].value_or(table_.columns().size());
    if (cell(4) == other.cell(4))
      for (column = 0; column < cells_->size() && column < other.cells_->size(); ++column)
        if ((*cells_)[column] != (*other.cells_)[column]) break;
    const auto text = [column](const Collisions& of) { return string(of.table_.cell(column)); };
    return {column < table_.columns().size() ? table_.columns()[column] : string(), text(*this), text(other)};
  }

 private:
  string_view cell(size_t k) const { return table_.cell(columns_[k]); }

  StoredTable table_;
  vector<optional<size_t>> columns_;
  const vector<string_view>* cells_ = nullptr;
  uint64_t count_ = 0;
};

void need_collisions(const RunRecord& run) {
  if (!has_file(run, "collisions.csv"))
    throw ExportError(
        fmt::format("{} has no collisions.csv: run its scene again with the output `collisions` (--only "
                    "collisions,trajectory)",
                    run.run.folder));
}

CollisionDifference collision_difference(const RunRecord& run_a, const RunRecord& run_b) {
  need_collisions(run_a);
  need_collisions(run_b);
  CollisionDifference difference;
  Collisions a(run_a), b(run_b);

  while (true) {
    a.next();
    b.next();
    if (a.ended() || b.ended() || !a.is_same(b)) break;

    if (!difference.outcome && !a.ends_the_same(b)) {
      difference.outcome = difference.same;
      difference.outcome_a = a.facts();
      difference.outcome_b = b.facts();
      tie(difference.column, difference.cell_a, difference.cell_b) = a.first_difference(b);
    }
    if (a.is_collision()) ++difference.same;
  }

  difference.part = !a.ended() || !b.ended();
  if (!a.ended()) difference.next_a = a.facts();
  if (!b.ended()) difference.next_b = b.facts();

  // The rest is only counted.
  while (!a.ended()) a.next();
  while (!b.ended()) b.next();
  difference.count_a = a.count();
  difference.count_b = b.count();
  return difference;
}

EndDifference end_difference(const RunRecord& run_a, const RunRecord& run_b) {
  const TrajectoryEnd a = end_of_trajectory(run_a.folder.get()), b = end_of_trajectory(run_b.folder.get());
  EndDifference difference;
  difference.time_a = a.time;
  difference.time_b = b.time;

  map<string_view, const EndMotion*> of_b;
  for (const EndMotion& motion : b.bodies) of_b.emplace(motion.body, &motion);

  for (const EndMotion& motion : a.bodies) {
    const auto found = of_b.find(motion.body);
    if (found == of_b.end()) {
      difference.only_a.push_back(motion.body);
      continue;
    }

    const double distance = (motion.position - found->second->position).norm();
    if (difference.bodies++ == 0 || distance > difference.greatest) {
      difference.greatest = distance;
      difference.body = motion.body;
    }
    of_b.erase(found);
  }

  for (const EndMotion& motion : b.bodies)
    if (of_b.contains(motion.body)) difference.only_b.push_back(motion.body);
  return difference;
}

RunRecord whole_run(const ListedRun& run) {
  if (!run.done)
    throw ExportError(fmt::format("{} failed (see its error.txt): there is nothing to compare", run.folder));
  return read_run({run.id, run.folder, {}}, {});
}

}  // namespace

bool RunDifference::equal() const {
  return values.empty() && !collisions.part && !collisions.outcome && end && end->greatest == 0 &&
         end->only_a.empty() && end->only_b.empty() && end->time_a == end->time_b;
}

RunDifference difference_of(const string& a, const string& b) {
  const vector<ListedRun> runs = list_runs({a, b});
  if (runs.size() != 2)
    throw ExportError(fmt::format("{} and {} are not two runs: name run folders, such as {}", a, b,
                                  runs.empty() ? "output/half" : runs.front().folder));

  RunDifference difference{runs[0], runs[1], {}, {}, {}, {}};
  const RunRecord record_a = whole_run(runs[0]), record_b = whole_run(runs[1]);

  const RunSet scenes(runs);
  const ComparedRun of_a = scenes.run(0), of_b = scenes.run(1);
  for (size_t k = 0; k < scenes.parameters().size(); ++k)
    difference.values.push_back(
        {scenes.parameters()[k].path, scenes.parameters()[k].unit, of_a.values[k], of_b.values[k]});

  difference.collisions = collision_difference(record_a, record_b);
  for (const RunRecord* run : {&record_a, &record_b})
    if (difference.no_end.empty() && !has_file(*run, "trajectory.csv")) difference.no_end = run->run.folder;
  if (difference.no_end.empty()) difference.end = end_difference(record_a, record_b);
  return difference;
}

}  // namespace carom
