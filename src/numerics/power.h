#pragma once
// Powers with the same bits on every machine, which <cmath> does not promise.

namespace carom {

/// x^y, right to 4 units in the last place, and rounded once or twice for whole y.
/// 0^0 is 1. The result is infinite for 0^y with y < 0 and on overflow, NaN for x < 0 and a y that is not whole.
double power(double x, double y);

}  // namespace carom
