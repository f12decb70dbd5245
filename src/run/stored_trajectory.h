#pragma once
// trajectory.csv of a finished run, instant by instant, in either layout. One instant is in memory.

#include "files/stored_table.h"
#include "numerics/vec3.h"
#include "std.h"

namespace carom {

struct Scene;

/// Reads the six numbers of a motion from cell `first` on; m, m/s.
/// False: a cell is empty, because the body has merged into another.
bool read_motion(const vector<string_view>& cells, size_t first, Vec3& position, Vec3& velocity);

class StoredTrajectory {
 public:
  /// `file`: the open table. `scene`: that of its run, which must outlive this object.
  StoredTrajectory(Descriptor file, const Scene& scene);
  /// Reads the next instant. False: the end. Throws ExportError for a row that is not one of the scene's.
  bool next();
  double time() const { return time_; }  // s
  /// y of the centres in m, by body. NaN: the body has merged into another.
  span<const double> heights() const { return heights_; }
  /// In m/s, by body, and only at the end of the run; empty before.
  span<const Vec3> velocities() const { return velocities_; }

 private:
  void begin_instant();
  void read_long();
  void read_body(size_t body, size_t first);

  const Scene& scene_;
  StoredTable table_;
  bool wide_;
  vector<string> names_;  // by body; of the long layout
  /// The row that follows, which may belong to another instant. Null: none.
  const vector<string_view>* row_ = nullptr;
  double time_ = 0;
  vector<double> heights_;
  vector<Vec3> velocities_;
};

}  // namespace carom
