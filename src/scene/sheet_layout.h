#pragma once
// The sizes in a contact sheet, and which sheets are possible. A scene is checked by them, and a sheet is made by them.

#include "scene/output.h"
#include "std.h"

namespace carom {

inline constexpr int sheet_gap = 8;  // pixels between the pictures and around them

struct SheetLayout {
  int64_t width, height;              // pixels, of one picture
  int64_t total_width, total_height;  // pixels, of the sheet
};

/// `shape`: the size of the pictures elsewhere. Without a size of its own, the sheet has pictures of this shape.
SheetLayout layout_of(const SheetOutput& sheet, Size shape);

/// A sheet that cannot be made, and what to change.
struct SheetProblem {
  string message, remedy;
};
optional<SheetProblem> problem_of(const SheetOutput& sheet, Size shape);

}  // namespace carom
