// The reflected solids are seen through the pixels in which the plane shows them, so that the image needs no rays of
// its own. Axes are reflected too: boxes and cylinders then stay what they are.
#include "render/mirrored.h"

#include "std.h"

namespace carom {

raster::Shot mirrored(const raster::Shot& shot, const raster::Ground& ground) {
  using raster::dot;
  using raster::Float3;

  const Float3& n = ground.normal;
  const auto turned = [&](Float3& v, float height) {
    const float way = 2 * (dot(n, v) + height);
    for (size_t i = 0; i < 3; ++i) v[i] -= way * n[i];
  };
  const auto direction = [&](Float3& v) { turned(v, 0); };
  const auto point = [&](Float3& v) { turned(v, ground.height); };

  raster::Shot image = shot;
  for (Float3& axis : image.lens.axes) direction(axis);
  for (array<Float3, 3>& axes : image.walls)
    for (Float3& axis : axes) direction(axis);
  for (raster::Lamp& lamp : image.lighting.lamps) lamp.near ? point(lamp.vector) : direction(lamp.vector);
  if (image.floor.present) {
    // n . (p - 2 (m . p + h) m) + d, with the mirror's normal m and height h.
    const float slope = dot(image.floor.normal, n);
    image.floor.height -= 2 * ground.height * slope;
    direction(image.floor.normal);
  }

  // What is behind the plane is not mirrored.
  std::erase_if(image.solids, [&](const raster::Solid& s) { return dot(n, s.center) + ground.height < -s.radius; });
  for (raster::Solid& solid : image.solids) {
    point(solid.center);
    solid.shadow_only = false;
    if (solid.kind == raster::SolidKind::mesh) solid.kind = shot.meshes[solid.part].volume;
  }

  image.grounds.clear();
  image.halos.clear();
  image.meshes.clear();
  image.mesh_pixels = nullptr;
  image.backdrop.none = true;
  return image;
}

}  // namespace carom
