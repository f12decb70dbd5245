#pragma once
// The chart of a run's energy over time.
#include "export/chart.h"
#include "std.h"

namespace carom {

class EnergyChart {
 public:
  explicit EnergyChart(const Scene& scene);
  /// By ascending time (s); J.
  void add(double time, double kinetic, double potential);
  Plot plot() const;

  void keep(auto& archive) { archive(instants_, kinetic_, potential_, total_); }

 private:
  const Scene& scene_;
  uint64_t instants_ = 0;
  ThinnedLine kinetic_, potential_, total_;
};

}  // namespace carom
