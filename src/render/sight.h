#pragma once
// Lines of sight: which fixed things hide bodies from the eye. Planes hide nothing (raster/ground.inc), and of hollow
// obstacles only what is behind a body is drawn.

#include "render/camera.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

/// Whether a volume about `center` lies between the eye and a point. One around the eye does not.
bool is_between(const Volume& volume, const Vec3& center, const Vec3& eye, const Vec3& point);

class Sight {
 public:
  /// `scene` must outlive this object.
  explicit Sight(const Scene& scene);

  /// Whether the scene has things that can hide.
  bool may_hide() const { return !opaque_.empty(); }
  /// The number of these things.
  size_t count() const { return opaque_.size(); }
  /// The fixed things that hide most of a body, each or else together, ascending. `world`: the
  /// scene's with the times that events have set. `time`: s.
  vector<Entity> hiders(const World& world, double time, const Vec3& eye, const CameraFrame& view, const Vec3& center,
                        double radius) const;
  /// Whether any of them hides a point.
  bool is_hidden(const World& world, double time, const Vec3& eye, const Vec3& point) const;

 private:
  bool hides(const World& world, Entity e, const Vec3& at, const Vec3& eye, const Vec3& point) const;

  const Scene& scene_;
  vector<Entity> opaque_;
};

}  // namespace carom
