#pragma once
// How large the labels of bodies are, and how many of them a picture can hold.

#include "scene/output.h"
#include "std.h"

namespace carom {

/// The size of letters (pixels) of values in a picture.
inline double small_letters(Size picture) {
  return max(picture.height / 38.0, 7.5);
}

/// The number of bodies whose labels, of so many values each, cover about an eighth of a picture.
size_t most_labels(Size picture, int values);

}  // namespace carom
