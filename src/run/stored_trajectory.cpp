// Rows are in the order of time and of bodies, so that a body's name is found by going on from the previous one.
#include "run/stored_trajectory.h"

#include <algorithm>
#include <limits>

#include "files/run_folder.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

namespace {

constexpr size_t motion_cells = 6;
constexpr double merged = std::numeric_limits<double>::quiet_NaN();

[[noreturn]] void refuse_table() {
  throw ExportError("trajectory.csv has a row that is not one of this scene's");
}

}  // namespace

bool read_motion(const vector<string_view>& cells, size_t first, Vec3& position, Vec3& velocity) {
  if (first + motion_cells > cells.size()) return false;
  for (size_t k = 0; k < motion_cells; ++k) {
    const auto number = number_in(cells[first + k]);
    if (!number) return false;
    (k < 3 ? position : velocity)[static_cast<int>(k % 3)] = *number;
  }
  return true;
}

StoredTrajectory::StoredTrajectory(Descriptor file, const Scene& scene)
    : scene_(scene), table_(std::move(file)), wide_(!table_.find("body")) {
  const Entity bodies = scene.world.body_count();
  heights_.resize(bodies);
  if (wide_ && table_.columns().size() != 1 + motion_cells * bodies) refuse_table();
  for (Entity body = 0; !wide_ && body < bodies; ++body) names_.push_back(scene.roster.name(body));
  row_ = table_.next();
}

bool StoredTrajectory::next() {
  if (row_ == nullptr) return false;
  begin_instant();
  if (!wide_) {
    read_long();
    return true;
  }
  for (size_t body = 0; body < heights_.size(); ++body) read_body(body, 1 + motion_cells * body);
  row_ = table_.next();
  return true;
}

void StoredTrajectory::begin_instant() {
  const auto time = number_in(row_->front());
  if (!time) refuse_table();
  time_ = *time;
  std::ranges::fill(heights_, merged);
  velocities_.clear();
  if (time_ >= end_of(scene_)) velocities_.resize(heights_.size());
}

void StoredTrajectory::read_long() {
  const string instant(row_->front());
  for (size_t body = 0; row_ != nullptr && row_->front() == instant; row_ = table_.next(), ++body) {
    if (row_->size() < 2 + motion_cells) refuse_table();
    while (body < names_.size() && names_[body] != (*row_)[1]) ++body;
    if (body == names_.size()) refuse_table();
    read_body(body, 2);
  }
}

void StoredTrajectory::read_body(size_t body, size_t first) {
  if (first + motion_cells > row_->size()) refuse_table();
  // Heights alone are needed before the end, and reading numbers takes most of the time.
  heights_[body] = number_in((*row_)[first + 1]).value_or(merged);
  Vec3 position;
  if (!velocities_.empty()) read_motion(*row_, first, position, velocities_[body]);
}

}  // namespace carom
