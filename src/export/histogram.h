#pragma once
// Counts in equal intervals, and their outline in a plot.
#include <cstdint>
#include <vector>

#include "export/plot.h"

namespace carom {

struct Histogram {
  double width = 1;                   // of an interval
  std::vector<std::uint64_t> counts;  // interval i is from i width to (i + 1) width
  std::uint64_t total() const;
  double end() const { return width * static_cast<double>(counts.size()); }
};

/// The number of intervals for so many values: 2 n^(1/3), the rule of Rice University.
int intervals_for(std::uint64_t values);

/// A band with a step for each interval: from lower[i] to upper[i]. Both begin at 0 and have one length.
std::vector<PlotPoint> stairs(double width, const std::vector<double>& lower, const std::vector<double>& upper);

}  // namespace carom
