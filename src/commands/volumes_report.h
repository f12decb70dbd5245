#pragma once
// The volumes of bodies and obstacles in the report of `check`.
#include <nlohmann/json.hpp>

#include "std.h"

namespace carom {

struct Scene;

/// "low and high each a box of 1 x 1 x 1 m; post a cylinder of radius 0.1 m and height 2 m": of all obstacles and of
/// all bodies except plain balls, at most ten kinds; empty: there are none.
string volumes_text(const Scene& scene);

/// By name, groups without members left out: {"crate": {"box": [1, 1, 1]}, ...}
nlohmann::ordered_json volumes_json(const Scene& scene);

}  // namespace carom
