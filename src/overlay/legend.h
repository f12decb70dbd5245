#pragma once
// The contents of legends: what colours and arrows of a scene's pictures mean.

#include "scene/color_map.h"
#include "scene/colors.h"
#include "std.h"

namespace carom {

struct Scene;

/// A title above a strip of a colour map, or above a list of colours with names.
struct Legend {
  struct Entry {
    Color color;
    string name;
  };
  string title;  // "speed (m/s)"; may be empty above a list
  ColorMap map = ColorMap::viridis;
  string min, max;        // the numbers at the strip's ends
  vector<Entry> entries;  // empty: a strip
};

/// One for each different colouring in the order of the bodies, and one for the arrows.
/// A list of more than 12 names ends with the number of those left out.
vector<Legend> legends_of(const Scene& scene);

}  // namespace carom
