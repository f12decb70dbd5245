// Reads lines from the end, so that a file of gigabytes costs as much as a short one.
#include "compare/end_of_trajectory.h"

#include "files/run_folder.h"
#include "files/stored_file.h"
#include "files/stored_table.h"
#include "run/stored_trajectory.h"
#include "std.h"

namespace carom {

TrajectoryEnd end_of_trajectory(int folder) {
  constexpr const char* name = "trajectory.csv";
  Descriptor file = open_stored_table(folder, name);
  if (!file) throw ExportError("there is no trajectory.csv");
  const StoredTable table(std::move(file));
  const TrajectoryLayout layout(table);

  TrajectoryEnd end;
  vector<string_view> cells;
  string changed, instant;
  lines_from_end(table.file(), [&](string_view line) {
    split_cells(line, table.separator(), cells, changed);
    if (instant.empty()) instant = cells[0];
    if (cells[0] != instant) return false;
    layout.for_each(cells, [&](string_view body, size_t first) {
      EndMotion motion{string(body), {}, {}};
      if (read_motion(cells, first, motion.position, motion.velocity)) end.bodies.push_back(std::move(motion));
    });
    return true;
  });

  end.time = number_in(instant).value_or(0);
  if (!layout.is_wide()) ranges::reverse(end.bodies);
  return end;
}

}  // namespace carom
