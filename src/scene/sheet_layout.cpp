// Divides a sheet of a given size among its pictures, or gives each picture a size and adds them up. Numbers have 64
// bits, because a sheet is measured before it is refused.
#include "scene/sheet_layout.h"

#include <fmt/format.h>

#include "std.h"

namespace carom {
namespace {

constexpr int whole_width = 1920;             // pixels, target
constexpr int most_width = 480;               // pixels, of one picture
constexpr int least_side = 32;                // pixels, of one picture; nothing is recognisable below
constexpr int64_t most_pixels = 100'000'000;  // 300 MB in memory

int64_t with_gaps(int64_t count, int64_t side) {
  return count * (side + sheet_gap) + sheet_gap;
}

/// The side of a picture if `count` of them and the gaps fill `whole` as far as possible.
int64_t side_within(int64_t whole, int64_t count) {
  return max<int64_t>((whole - sheet_gap * (count + 1)) / max<int64_t>(count, 1), 0);
}

}  // namespace

SheetLayout layout_of(const SheetOutput& sheet, Size shape) {
  if (sheet.size) {
    return {side_within(sheet.size->width, sheet.columns), side_within(sheet.size->height, sheet.rows),
            sheet.size->width, sheet.size->height};
  }
  const int64_t width = clamp<int64_t>(side_within(whole_width, sheet.columns), least_side, most_width);
  const double exact_height = double(width) * shape.height / max(shape.width, 1);
  const int64_t height = max<int64_t>(std::llround(min(exact_height, 1e6)), 1);
  return {width, height, with_gaps(sheet.columns, width), with_gaps(sheet.rows, height)};
}

optional<SheetProblem> problem_of(const SheetOutput& sheet, Size shape) {
  const SheetLayout layout = layout_of(sheet, shape);
  const string sheet_text = fmt::format("a contact sheet of {} x {} pictures", sheet.columns, sheet.rows);

  if (sheet.size && min(layout.width, layout.height) < least_side)
    return SheetProblem{fmt::format("{} in {} x {} pixels: each would have {} x {}", sheet_text, layout.total_width,
                                    layout.total_height, layout.width, layout.height),
                        fmt::format("expected a `size` of at least [{}, {}], or fewer columns or rows",
                                    with_gaps(sheet.columns, least_side), with_gaps(sheet.rows, least_side))};

  if (layout.total_height <= most_pixels && layout.total_width * layout.total_height <= most_pixels) return nullopt;
  return SheetProblem{
      fmt::format("{} would have {} x {} pixels", sheet_text, layout.total_width, layout.total_height),
      sheet.size ? fmt::format("expected a `size` of at most {} pixels in all", most_pixels)
                 : fmt::format("expected a `size` of the sheet, such as [{}, {}]: without one, its pictures have the "
                               "shape of {} x {}",
                               whole_width, 1080, shape.width, shape.height)};
}

}  // namespace carom
