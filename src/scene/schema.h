#pragma once
// The table of fields as a JSON Schema, so that editors complete and check scene files and other programs can.
#include <string>
#include <string_view>

namespace carom {

/// A JSON Schema, draft-07, of the files that are a map of the kind `root` ("scene"). What it refuses the loader
/// refuses; what it accepts and the loader refuses is what takes more than types, ranges and keys to see: names that
/// mean nothing, values that contradict one another, overlaps, files that are not there.
std::string json_schema(std::string_view root);

}  // namespace carom
