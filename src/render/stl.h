#pragma once
// STL files, text or binary, to the corners of their triangles.

#include "std.h"

namespace carom {

/// Three corners for each triangle, in the order of the file. Words of a text may be in capitals, several solids are
/// one, and an empty one is none. Bytes behind the last triangle of a binary file are left alone. Throws
/// runtime_error with the fault and its line or triangle.
vector<array<float, 3>> stl_corners(string_view bytes);

}  // namespace carom
