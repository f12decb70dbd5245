#pragma once
// The still things of a scene as triangles, and the volumes of bodies, for programs that draw triangles.
// Corners are computed by square roots alone, so that they are the same on every machine.

#include "render/model.h"
#include "std.h"

namespace carom {

struct MeshUse;
struct Scene;

/// The visible planes, walls and obstacles, in the order of the file. A plane is cut off at a cube around `seen`, the
/// walls and the obstacles. It is also cut off where it is behind other visible planes. Throws RenderError for a mesh
/// that cannot be read.
/// `painted`: obstacles drawn as meshes have the colours of their files.
vector<StillThing> still_things(const Scene& scene, const Extent& seen, bool painted);

/// The cube from -1 to 1.
Mesh unit_box();
/// The ball of radius 1 as 2048 triangles, with corners on the sphere and its normals.
Mesh round_ball();
/// The upright cylinder of radius 1 and half height 1 with 64 sides. Their edges lie on it.
Mesh round_cylinder();

/// A mesh with its vertices p at `middle` + scale * p (by axis), and normals to match.
Mesh placed(const Mesh& mesh, const Vec3& scale, const Vec3& middle);

/// The mesh that is drawn in place of a volume about the origin, with paint if it has colours of its own. Throws
/// RenderError.
Mesh drawn_mesh(const MeshUse& use);
/// Turns the axes of the file to those of the world.
void turn_mesh(Mesh& mesh, const MeshTurn& turn);

}  // namespace carom
