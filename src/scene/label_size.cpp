#include "scene/label_size.h"

#include "std.h"

namespace carom {
namespace {

constexpr double label_width = 6, line_height = 1.3;  // of a value, in the size of letters
constexpr double covered = 0.125;                     // of the picture

}  // namespace

size_t most_labels(Size picture, int values) {
  const double letters = small_letters(picture);
  const double one = label_width * line_height * letters * letters * max(values, 1);
  return size_t(max(1.0, covered * picture.width * picture.height / one));
}

}  // namespace carom
