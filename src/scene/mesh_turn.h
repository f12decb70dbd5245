#pragma once
// How a mesh is turned from the axes of its file to those of the world.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

/// Rows of a rotation matrix. It is never a reflection.
using MeshTurn = array<Vec3, 3>;

inline const MeshTurn no_turn = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};

/// A point or a direction of the file in the axes of the world.
inline Vec3 turned(const MeshTurn& turn, const Vec3& p) {
  return {turn[0].dot(p), turn[1].dot(p), turn[2].dot(p)};
}

/// The axis of the file that is up.
enum class UpAxis : uint8_t { x, y, z };

/// Turns this axis of the file to y, and then about x, y and z of the world by these angles (degrees). An angle that
/// is a multiple of 90 turns exactly.
MeshTurn mesh_turn(UpAxis up, const Vec3& angles);

}  // namespace carom
