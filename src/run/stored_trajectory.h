#pragma once
// trajectory.csv of a finished run, in either layout: a row for each body, or (wide) one for each instant.

#include "files/run_folder.h"
#include "files/stored_table.h"
#include "numerics/vec3.h"
#include "physics/entity.h"
#include "std.h"

namespace carom {

struct Scene;

/// Reads the six numbers of a motion from cell `first` on; m, m/s.
/// False: a cell is empty, because the body has merged into another.
bool read_motion(const vector<string_view>& cells, size_t first, Vec3& position, Vec3& velocity);

/// Where the motions are in a row.
class TrajectoryLayout {
 public:
  explicit TrajectoryLayout(const StoredTable& table);
  bool is_wide() const { return wide_; }

  /// Calls take(body, first) for each motion in a row: the body's name, and the first of the six cells.
  template <typename Take>
  void for_each(const vector<string_view>& row, const Take& take) const {
    if (row.size() != columns_) return;
    if (!wide_) take(row[1], 2);
    for (size_t k = 0; k < bodies_.size(); ++k) take(bodies_[k], 1 + motion_cells * k);
  }

 private:
  static constexpr size_t motion_cells = 6;
  size_t columns_;
  bool wide_;
  vector<string> bodies_;  // of the wide layout
};

/// Thrown for a row that is not one of the scene's.
struct ForeignRow : ExportError {
  ForeignRow() : ExportError("trajectory.csv has a row that is not one of this scene's") {}
};

/// The bodies that have rows in the scene's trajectory.csv, as in its `on`. Empty: all have.
string bodies_in_table(const Scene& scene);

/// The motions of a scene's bodies, instant by instant. One row is in memory.
class StoredTrajectory {
 public:
  /// `file`: the open table. `scene`: that of its run.
  StoredTrajectory(Descriptor file, const Scene& scene);

  /// Goes on to the next instant. False: the end. Throws ForeignRow.
  bool next();
  double time() const { return time_; }  // s

  /// Calls take(body, row, first) for the motions of this instant. A body that has merged into another has none, or
  /// empty cells. Throws ForeignRow.
  template <typename Take>
  void read(const Take& take) {
    size_t body = 0;  // of those with rows
    for (; is_here(); row_ = table_.next()) {
      if (row_->size() != table_.columns().size()) throw ForeignRow();
      layout_.for_each(*row_, [&](string_view name, size_t first) {
        // Wide, a row has every body.
        while (body < names_.size() && names_[body] != name && !layout_.is_wide()) ++body;
        if (body == names_.size() || names_[body] != name) throw ForeignRow();
        take(bodies_.empty() ? Entity(body) : bodies_[body], *row_, first);
        ++body;
      });
      if (layout_.is_wide() && body != names_.size()) throw ForeignRow();
    }
  }

 private:
  bool is_here() const { return row_ != nullptr && row_->front() == instant_; }

  StoredTable table_;
  TrajectoryLayout layout_;
  vector<Entity> bodies_;  // those with rows; empty: all
  vector<string> names_;   // of the bodies with rows
  /// The first row that has not been read. Null: none.
  const vector<string_view>* row_;
  string instant_;
  double time_ = 0;
};

}  // namespace carom
