#pragma once
// The scene format as plain data: every kind of map in a scene, and every key of it.
// This one table is the source of the decoder, the messages about wrong keys and values, the resolved scene, and --set.
// The schema, the page of the format and `carom explain` come from it too.

#include "scene/field.h"
#include "std.h"

namespace carom {

/// Every kind of a scene file, "scene" first.
span<const Kind> kinds();
/// Every kind of a sweep file, "sweep" first.
span<const Kind> sweep_kinds();
/// The kinds of each sort of file. The file itself is a map of the first of them.
vector<span<const Kind>> families();
/// Null: there is none of this name.
const Kind* find_kind(string_view name);
const Kind& kind_named(string_view name);  // must exist

/// The rows of a sweep file (sweep_fields.cpp), which sweep_kinds() completes.
span<const Kind> sweep_rows();

}  // namespace carom
