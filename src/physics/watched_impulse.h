#pragma once
// Contacts whose impulses a simulator sums.

#include "physics/entity.h"
#include "physics/extremes.h"
#include "std.h"

namespace carom {

/// The contacts of some things with others, or with anything, in a part of the run.
struct WatchedImpulse {
  vector<EntityRange> a{};
  optional<vector<EntityRange>> b{};  // none: with anything
  TimeWindow window{};

  friend bool operator==(const WatchedImpulse&, const WatchedImpulse&) = default;
};

}  // namespace carom
