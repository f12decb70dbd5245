// Steps are drawn as a band whose ends jump, which needs no form of its own.
#include "export/histogram.h"

#include <numeric>

#include "std.h"

namespace carom {

uint64_t Histogram::total() const {
  return std::accumulate(counts.begin(), counts.end(), uint64_t{0});
}

int intervals_for(uint64_t values) {
  return int(ceil(2 * std::cbrt(double(values))));
}

vector<PlotPoint> stairs(double width, const vector<double>& lower, const vector<double>& upper) {
  vector<PlotPoint> points;
  for (size_t i = 0; i < upper.size(); ++i)
    for (const size_t edge : {i, i + 1}) points.push_back({double(edge) * width, upper[i], "", lower[i], upper[i]});
  return points;
}

}  // namespace carom
