#pragma once
// How `check` tells of the volumes of bodies and obstacles.
#include <nlohmann/json.hpp>
#include <string>

namespace carom {

struct Scene;

/// "low and high each a box of 1 x 1 x 1 m; post a cylinder of radius 0.1 m and height 2 m": of all obstacles and of
/// all bodies that are no plain balls, at most ten kinds; empty: there are none.
std::string volumes_text(const Scene& scene);

/// Of each name of the scene, but for those without members: {"crate": {"box": [1, 1, 1]}, ...}
nlohmann::ordered_json volumes_json(const Scene& scene);

}  // namespace carom
