#include "scene/mesh_turn.h"

#include "numerics/degrees.h"
#include "std.h"

namespace carom {
namespace {

/// The turn with a rotation by `angle` degrees about an axis after it.
MeshTurn rotated(const MeshTurn& turn, size_t axis, double angle) {
  const SinCos of = sin_cos_degrees(angle);
  const size_t next = (axis + 1) % 3, last = (axis + 2) % 3;
  MeshTurn out = turn;
  out[next] = of.cos * turn[next] - of.sin * turn[last];
  out[last] = of.sin * turn[next] + of.cos * turn[last];
  return out;
}

}  // namespace

MeshTurn mesh_turn(UpAxis up, const Vec3& angles) {
  MeshTurn turn = no_turn;
  if (up == UpAxis::z) turn = rotated(turn, 0, -90);
  if (up == UpAxis::x) turn = rotated(turn, 2, 90);
  for (size_t axis = 0; axis < 3; ++axis) turn = rotated(turn, axis, angles[ptrdiff_t(axis)]);
  return turn;
}

}  // namespace carom
