#pragma once
// A path into a scene against the table of fields alone, whatever the scene has.
#include <string_view>

#include "scene/fields.h"

namespace carom {

/// The field that a path such as balls.red.position.z leads to or into; null: no field of any scene.
const Field* field_at(std::string_view path);

}  // namespace carom
