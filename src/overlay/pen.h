#pragma once
// Lines, arrows and outlines as coverage of pixels. Edges are smooth: a pixel at the distance d from an edge is covered
// by the part 1/2 - d.

#include "overlay/font.h"
#include "std.h"

namespace carom {

/// A point of a picture, in pixels from its upper left corner, y downwards.
struct PixelPoint {
  double x = 0, y = 0;
  friend PixelPoint operator+(const PixelPoint& a, const PixelPoint& b) { return {a.x + b.x, a.y + b.y}; }
  friend PixelPoint operator-(const PixelPoint& a, const PixelPoint& b) { return {a.x - b.x, a.y - b.y}; }
  friend PixelPoint operator*(double factor, const PixelPoint& a) { return {factor * a.x, factor * a.y}; }
};

// Each adds to what is covered. What lies outside is left out.

/// A line with round ends.
void draw_line(const PixelPoint& from, const PixelPoint& to, double width, Coverage& covered);
/// A shaft of this width and a head of three to four times the width. A short arrow is a head alone, in proportion.
void draw_arrow(const PixelPoint& from, const PixelPoint& to, double width, Coverage& covered);
/// An upright rectangle.
void draw_box(const PixelPoint& upper_left, const PixelPoint& lower_right, Coverage& covered);
void draw_disc(const PixelPoint& center, double radius, Coverage& covered);

/// What lies within `radius` pixels of what is covered, with that itself: an outline that letters are read by on any
/// ground.
Coverage outline_of(const Coverage& covered, double radius);

}  // namespace carom
