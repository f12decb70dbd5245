#pragma once
// The least and the greatest value of a quantity of some bodies over a run or a window of it, and its mean.

#include "numerics/compensated.h"
#include "physics/entity.h"
#include "physics/quantity.h"
#include "std.h"

namespace carom {

/// A part of a run, ends included.
struct TimeWindow {
  double from = 0;          // s
  double until = infinity;  // s

  bool has(double time) const { return from <= time && time <= until; }
  friend bool operator==(const TimeWindow&, const TimeWindow&) = default;
};

/// A quantity of the bodies `first` to `first` + `count` - 1.
struct WatchedQuantity {
  Quantity quantity = Quantity::x;
  Entity first = 0, count = 1;
  TimeWindow window{};
  bool mean = false;  // the mean is wanted, and not the extremes

  bool has(Entity body) const { return body >= first && body - first < count; }
  friend bool operator==(const WatchedQuantity&, const WatchedQuantity&) = default;
};

/// The extreme value in the quantity's unit, and the first time at which the quantity has it but for rounding (s). NaN:
/// there is none.
struct Extreme {
  double value = numeric_limits<double>::quiet_NaN();
  double time = numeric_limits<double>::quiet_NaN();
  double then = numeric_limits<double>::quiet_NaN();  // the value at that time

  /// Takes the value at a time (s) if it is beyond the extreme in this direction, 1 or -1. Only one that is beyond by
  /// more than `rounding` has a later time.
  void take(double direction, double other, double at, double rounding) {
    const double beyond = direction * (other - value);
    if (!(direction * (other - then) <= rounding) || (beyond >= -rounding && at < time)) time = at, then = other;
    if (!(beyond <= 0)) value = other;
  }
};

struct Extremes {
  Extreme least, greatest;
  Sum integral;  // over time, of all bodies: the quantity's unit times s
  Sum seconds;   // that it covers, of all bodies

  /// The mean over time and bodies, each as long as it is in the world. NaN: there is no such time.
  double mean() const { return integral.value() / seconds.value(); }

  /// Takes the value at a time (s). `rounding`: the error of values until then, in the quantity's unit.
  void take(double value, double time, double rounding = 0) {
    least.take(-1, value, time, rounding);
    greatest.take(1, value, time, rounding);
  }
};

}  // namespace carom
