#pragma once
// The contents of legends: what colours and arrows of a scene's pictures mean.
#include <string>
#include <vector>

#include "scene/color_map.h"
#include "scene/colors.h"

namespace carom {

struct Scene;

/// A title above a strip of a colour map, or above a list of colours with names.
struct Legend {
  struct Entry {
    Color color;
    std::string name;
  };
  std::string title;  // "speed (m/s)"; may be empty above a list
  ColorMap map = ColorMap::viridis;
  std::string min, max;        // the numbers at the strip's ends
  std::vector<Entry> entries;  // empty: a strip
};

/// One for each different colouring in the order of the bodies, and one for the arrows.
/// A list of more than 12 names ends with the number of those left out.
std::vector<Legend> legends_of(const Scene& scene);

}  // namespace carom
