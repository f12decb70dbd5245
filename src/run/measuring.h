#pragma once
// The measures of a run, taken as it goes on.
#include <span>
#include <vector>

#include "physics/collision.h"
#include "physics/extremes.h"
#include "physics/state.h"
#include "run/measure_scope.h"

namespace carom {

/// What is known at the end of a run.
struct RunEnd {
  const State& state;  // the last one
  const Summary& summary;
  std::span<const Extremes> extremes;  // by Measuring::watched()
};

class Measuring {
 public:
  /// `scene` must outlive this object. Throws MeasureError where a measure names what the scene does not have.
  Measuring(const Scene& scene, std::vector<Measure> measures);

  /// Whether a measure counts collisions.
  bool needs_collisions() const { return !meetings_.empty(); }
  /// The quantities with extremes, which the simulator has to watch.
  const std::vector<WatchedQuantity>& watched() const { return watched_; }
  /// Takes collisions, in order.
  void record(std::span<const Collision> collisions);
  /// The values of the measures, in their order.
  std::vector<Measured> values(const RunEnd& run) const;

 private:
  /// The collisions between two things, or of one thing with anything.
  struct Meeting {
    std::vector<std::string> things;
    std::vector<EntityRange> a, b;  // of the names in `things`
    double count = 0;
    double first;  // s, NaN: none
  };

  void prepare(const Measure& measure);
  double value(const Measure& measure, const RunEnd& run) const;
  double at_end(const Measure& measure, Entity body, const State& end) const;
  double evaluated(const Measure& measure, const RunEnd& run) const;
  double counted(const Measure& measure, const RunEnd& run) const;
  const Extremes& extremes(const Measure& measure, const RunEnd& run) const;

  const Scene& scene_;
  const std::vector<Measure> measures_;
  std::vector<Meeting> meetings_;
  std::vector<WatchedQuantity> watched_;
};

}  // namespace carom
