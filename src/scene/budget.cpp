// Limits are compared in double, so that the product of instants and bodies cannot overflow.
// The number of steps is exact for a given step. For a tolerance it is a lower bound: steps of 64 default steps.
#include "scene/budget.h"

#include <fmt/format.h>

#include "physics/force.h"
#include "scene/engines.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

Budget Budget::without_outputs() const {
  Budget budget = *this;
  budget.frames = budget.rows = budget.keys = budget.files = numeric_limits<uint64_t>::max();
  return budget;
}

optional<double> steps_of(const Scene& scene) {
  const Simulate& simulate = scene.simulate;
  if (engine_of(scene.world, simulate) == Engine::exact || simulate.duration == 0) return nullopt;
  if (simulate.step) return ceil(simulate.duration / *simulate.step);
  const double fine = default_step(scene.world, scene.initial);
  return ceil(simulate.duration / (simulate.tolerance ? 64 * fine : fine));
}

vector<Excess> excesses(const Output& output, double duration, double bodies, const Budget& budget) {
  vector<Excess> found;
  for (const OutputKind& kind : output_kinds()) {
    if (kind.rows.empty() || !kind.asked(output)) continue;
    const double instants = ceil(duration / kind.every(output)) + 1;
    const double rows = instants * (kind.name == "trajectory" ? rows_of(*output.trajectory, bodies) : bodies);

    const uint64_t most_rows = kind.in_memory ? budget.keys : budget.rows;
    if (rows > double(most_rows)) {
      const bool wide = kind.name == "trajectory" && output.trajectory->wide;
      found.push_back({&kind, rows, wide ? "motions of bodies in trajectory.csv" : string(kind.rows), most_rows});
    } else if (!kind.series.folder.empty() && instants > double(budget.files)) {
      found.push_back({&kind, instants, fmt::format("files in {}/", kind.series.folder), budget.files});
    }
  }
  return found;
}

}  // namespace carom
