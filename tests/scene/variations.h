#pragma once
// Valid scenes, and ways to make them wrong: every key of the table of fields taken away, added, and given
// every kind of value.
#include <nlohmann/json.hpp>

#include "std.h"

namespace carom {

struct Variation {
  string what;  // "balls.red.mass is null"
  string text;  // JSON, which is YAML
};

/// Valid scenes that together have every key of the table. They need the file box.stl beside them, and of any
/// run a body `former`.
vector<string> right_scenes();

/// Every scene that is one change away: every key that it has or could have, by every change. `visited` gets
/// "kind.key" of those that it has.
vector<Variation> vary(const string& scene, set<string>& visited);

}  // namespace carom
