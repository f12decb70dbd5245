#pragma once
// Outlines of all solids of a picture in the plane z = 1 before the eye: ellipses of balls, convex polygons of boxes,
// cylinders and walls.

#include "raster/shot.h"
#include "std.h"

namespace carom::raster {

/// Pixels, ends excluded. A picture's side is at most 16384.
struct PixelBounds {
  int16_t left = 0, top = 0, right = 0, bottom = 0;
  bool empty() const { return left >= right || top >= bottom; }
};

/// A line in the plane z = 1: x, y to pixels inside of it.
struct Edge {
  float a, b, c;
};

/// The ellipse of a ball.
struct BallOutline {
  float x = 0, y = 0;                    // centre
  float xx = 0, xy = 0, yx = 0, yy = 0;  // to units of the half axes
  float per_a = 0, per_b = 0;            // one over these
  float depth2 = 0;                      // m^2, square of half the chord through the centre, times |ray|^2
  float opacity = 1;                     // of a ball that is smaller than a pixel
};

/// Fits into a line of the cache: most are read once a tile.
struct alignas(64) Silhouette {
  float nearest = 0;   // m, least z
  PixelBounds bounds;  // in which the solid may be seen
  bool wide = false;   // a ball that reaches behind the eye: it has no ellipse
  BallOutline ball;
  // Of other solids: edges in pairs that are opposite each other.
  int32_t first_edge = 0, edge_pairs = 0;
};

class Silhouettes {
 public:
  /// Computes the outlines of all solids. The memory of the last picture is used again.
  void fill(const Shot& shot);

  const Silhouette& of(uint32_t solid) const { return all_[solid]; }
  const Edge* edges(const Silhouette& silhouette) const { return edges_.data() + silhouette.first_edge; }

 private:
  PixelBounds add_polygon(const Shot& shot, const Solid& solid, Silhouette& to);

  vector<Silhouette> all_;  // by solid
  vector<Edge> edges_;
};

/// The pixels that a ball, m, may meet, roughly: they are never too few.
PixelBounds bounds_of_ball(const Lens& lens, const Float3& center, float radius);

}  // namespace carom::raster
