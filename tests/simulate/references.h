#pragma once
// The reference numbers of tests/data/references/. Apart from build.h, since most tests need no JSON.
#include <nlohmann/json.hpp>

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

/// The file `name`.json.
nlohmann::json reference(const string& name);

/// [x, y, z].
Vec3 vec3(const nlohmann::json& j);

/// "3073/1024" or 1.5.
double number(const nlohmann::json& j);

}  // namespace carom
