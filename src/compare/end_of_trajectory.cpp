// Reads lines from the end, so that a file of gigabytes costs as much as a short one.
#include "compare/end_of_trajectory.h"

#include <algorithm>

#include "files/run_folder.h"
#include "files/stored_file.h"
#include "files/stored_table.h"
#include "run/measure.h"
#include "run/stored_trajectory.h"
#include "std.h"

namespace carom {

vector<EndMotion> end_of_trajectory(int folder) {
  constexpr const char* name = "trajectory.csv";
  constexpr size_t motion_size = 6;
  Descriptor head = open_stored(folder, name);
  if (!head) throw ExportError("there is no trajectory.csv");
  const StoredTable table(std::move(head));
  const Descriptor file = open_stored(folder, name);
  const bool wide = !table.find("body");
  vector<EndMotion> motions;
  vector<string_view> cells;
  string unquoted, last_time;
  lines_from_end(file.get(), [&](string_view line) {
    split_cells(line, cells, unquoted);
    if (wide) {
      for (size_t first = 1; first + motion_size <= table.columns().size(); first += motion_size) {
        const string& column = table.columns()[first];
        EndMotion motion{column.substr(0, column.size() - 1 - name_of(Quantity::x).size()), {}, {}};
        if (read_motion(cells, first, motion.position, motion.velocity)) motions.push_back(std::move(motion));
      }
      return false;
    }
    if (cells.size() < 2 + motion_size) return true;
    if (last_time.empty()) last_time = cells[0];
    if (cells[0] != last_time) return false;
    EndMotion motion{string(cells[1]), {}, {}};
    if (read_motion(cells, 2, motion.position, motion.velocity)) motions.push_back(std::move(motion));
    return true;
  });
  if (!wide) std::ranges::reverse(motions);
  return motions;
}

}  // namespace carom
