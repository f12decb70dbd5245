#pragma once
// A view of fixed direction and angles: from where does it hold given things?

#include "physics/volume.h"
#include "render/camera.h"
#include "scene/output.h"
#include "std.h"

namespace carom {

/// Slightly from above: the elevation of a camera by default (degrees).
inline constexpr double slight_elevation = 18;

class Frustum {
 public:
  /// Looks from the front, downwards along `up` by `elevation` (degrees), and turned about `up` by `azimuth` (degrees,
  /// counterclockwise from above). A twentieth of the picture stays free at each edge. Of `lens`, up, fov and
  /// fov_horizontal count.
  Frustum(const Camera& lens, Size size, double elevation, double azimuth = 0);

  /// How far things extend beyond the sides: the least of n . x, with each side's inward normal n (m).
  struct Reach {
    array<double, 4> least = {1e300, 1e300, 1e300, 1e300};
    bool empty() const { return least[0] >= 1e300; }
    void add(const Reach& other);
  };
  void add(Reach& reach, const Vec3& center, double radius) const;
  void add(Reach& reach, const Vec3& center, const Volume& volume) const;

  /// The nearest eye that has all of `reach` in view, in the middle of those equally near.
  Vec3 eye(const Reach& reach) const;
  /// The depth of a point as seen from that eye (m).
  double depth(const Reach& reach, const Vec3& point) const { return view_.forward.dot(point - eye(reach)); }
  /// The least distance from `target`, in the middle of the picture, that has all of `reach` in view (m).
  double distance(const Reach& reach, const Vec3& target) const;
  /// The height of the whole picture at a depth (m).
  double height(double depth) const { return 2 * depth * tan_y_ / used; }

  /// Whether a point is in view from an eye, the margins left free.
  bool has(const Vec3& point, const Vec3& eye) const {
    return all_of(normals_, [&](const Vec3& normal) { return normal.dot(point - eye) >= 0; });
  }

  const CameraFrame& view() const { return view_; }
  const Vec3& up() const { return up_; }  // unit
  /// To the level side from which it looks, unit: +z with y up.
  const Vec3& front() const { return front_; }

 private:
  static constexpr double used = 0.9;  // of the picture's width and height

  Vec3 up_, front_;
  CameraFrame view_;
  double tan_x_, tan_y_;    // of half the angles, for what is used
  array<Vec3, 4> normals_;  // unit, inward: left, right, bottom, top
};

}  // namespace carom
