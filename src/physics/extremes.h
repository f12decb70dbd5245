#pragma once
// The least and the greatest value of a quantity of some bodies over a run.
#include <limits>

#include "physics/entity.h"
#include "physics/quantity.h"

namespace carom {

/// A quantity of the bodies `first` to `first` + `count` - 1.
struct WatchedQuantity {
  Quantity quantity = Quantity::x;
  Entity first = 0, count = 1;

  bool has(Entity body) const { return body >= first && body - first < count; }
  friend bool operator==(const WatchedQuantity&, const WatchedQuantity&) = default;
};

/// A value in the quantity's unit, and the first time at which it is taken (s). NaN: there is none.
struct Extreme {
  double value = std::numeric_limits<double>::quiet_NaN();
  double time = std::numeric_limits<double>::quiet_NaN();
};

struct Extremes {
  Extreme least, greatest;

  /// Takes the value at a time (s).
  void take(double value, double time) {
    if (!(value > least.value) && (value != least.value || time < least.time)) least = {value, time};
    if (!(value < greatest.value) && (value != greatest.value || time < greatest.time)) greatest = {value, time};
  }
};

}  // namespace carom
