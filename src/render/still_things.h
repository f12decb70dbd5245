#pragma once
// What stands still in a scene as triangles, and the volumes of bodies, for programs that draw triangles. Corners come
// of roots alone, so that they are the same on every machine.
#include <vector>

#include "render/model.h"

namespace carom {

struct MeshUse;
struct Scene;

/// The planes, walls and obstacles that are visible, in the order of the file. A plane is cut off at a cube around
/// `seen`, the walls and the obstacles, and where other visible planes have their backs. Throws RenderError for a mesh
/// that cannot be read.
std::vector<StillThing> still_things(const Scene& scene, const Extent& seen);

/// The ball of radius 1: 2048 triangles, their corners on it, with its normals.
Mesh round_ball();
/// The upright cylinder of radius 1 and half height 1: 64 sides, their edges on it.
Mesh round_cylinder();

/// A mesh's vertices p at `middle` + scale * p (by axis); normals follow.
Mesh placed(const Mesh& mesh, const Vec3& scale, const Vec3& middle);

/// The mesh that is drawn in place of a volume about the origin. Throws RenderError.
Mesh drawn_mesh(const MeshUse& use);

}  // namespace carom
