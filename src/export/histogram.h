#pragma once
// Counts in equal intervals, and their outline in a plot.

#include "export/plot.h"
#include "std.h"

namespace carom {

struct Histogram {
  double width = 1;         // of an interval
  vector<uint64_t> counts;  // interval i is from i width to (i + 1) width
  uint64_t total() const;
  double end() const { return width * double(counts.size()); }
};

/// The number of intervals for so many values: 2 n^(1/3), the rule of Rice University.
int intervals_for(uint64_t values);

/// A band with a step for each interval: from lower[i] to upper[i]. Both begin at 0 and have one length.
vector<PlotPoint> stairs(double width, const vector<double>& lower, const vector<double>& upper);

}  // namespace carom
