#pragma once
// Resolves a path into a scene by the table of fields alone, without a scene.

#include "scene/fields.h"
#include "std.h"

namespace carom {

/// The field at the end of a path such as balls.red.position.z, or the one that it leads into. Null: no such field.
const Field* field_at(string_view path);

/// The path in words: the thing's name and the key's title, "red: position z", "ball: mass", "Default coefficient of
/// restitution"; of a value of `let` its name.
string words_of(string_view path);

/// Whether the path leads to a key for pictures alone, or below one (Field::drawn).
bool is_drawn(string_view path);

}  // namespace carom
