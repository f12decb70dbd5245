#pragma once
// A smooth function that nowhere exceeds a given one: the least value around each place, averaged three times. Averages
// reach no farther than the least values are taken, so that each of them is of values below the given one. Other
// smooth curves below, such as splines through the least values, need a search.

#include "std.h"

namespace carom {

/// The values averaged three times, each over `half` values on either side. Beyond the ends the values are those there.
vector<double> smoothed(vector<double> values, size_t half);

/// At most `values`, and constant if `half` is at least a third of their number. From one value to the next it changes
/// by at most their range over 2 half + 1.
vector<double> smooth_minorant(const vector<double>& values, size_t half);

}  // namespace carom
