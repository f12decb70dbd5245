#pragma once
// The table of fields as a JSON Schema, with which editors and other programs complete and check scene files.

#include "std.h"

namespace carom {

/// A JSON Schema, draft-07, of files that are a map of the kind `root` ("scene").
/// The loader refuses all that it refuses.
/// The loader also refuses errors that types, ranges and keys cannot express.
/// These are unknown names, contradictory values, overlaps and missing files.
string json_schema(string_view root);

}  // namespace carom
