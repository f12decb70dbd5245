// Rows are in the order of time and of bodies, so that a body's name is found by going on from the previous one.
#include "run/stored_trajectory.h"

#include "run/measure.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/joined.h"

namespace carom {

bool read_motion(const vector<string_view>& cells, size_t first, Vec3& position, Vec3& velocity) {
  constexpr size_t numbers = 6;
  if (first + numbers > cells.size()) return false;
  for (size_t k = 0; k < numbers; ++k) {
    const auto number = number_in(cells[first + k]);
    if (!number) return false;
    (k < 3 ? position : velocity)[int(k % 3)] = *number;
  }
  return true;
}

TrajectoryLayout::TrajectoryLayout(const StoredTable& table)
    : columns_(table.columns().size()), wide_(!table.find("body")) {
  for (size_t first = 1; wide_ && first + motion_cells <= columns_; first += motion_cells) {
    const string& column = table.columns()[first];
    bodies_.push_back(column.substr(0, column.size() - 1 - name_of(Quantity::x).size()));
  }
}

string bodies_in_table(const Scene& scene) {
  const optional<TrajectoryOutput>& written = scene.requested.trajectory;
  return written && written->bodies.size() < scene.world.body_count() ? string(joined(written->on, ", ")) : string();
}

StoredTrajectory::StoredTrajectory(Descriptor file, const Scene& scene)
    : table_(std::move(file)), layout_(table_), row_(table_.next()) {
  const optional<TrajectoryOutput>& written = scene.requested.trajectory;
  if (written) bodies_ = written->bodies;
  for (Entity body = 0; bodies_.empty() && body < scene.world.body_count(); ++body)
    names_.push_back(scene.roster.name(body));
  for (const Entity body : bodies_) names_.push_back(scene.roster.name(body));
}

bool StoredTrajectory::next() {
  while (is_here()) row_ = table_.next();
  if (row_ == nullptr) return false;
  instant_ = row_->front();
  const auto time = number_in(instant_);
  if (!time) throw ForeignRow();
  time_ = *time;
  return true;
}

}  // namespace carom
