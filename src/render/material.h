#pragma once
// The look of surfaces: the light that they send to the eye. One text serves the shaders of all kinds of things.

namespace carom {

/// For a fragment shader behind Lighting::shader(), in the camera's frame:
///   float key_light(vec3 p, vec3 l, ivec2 occluders)
/// The part of the key light that the rows of Occluders::append_rows (first, count) let through.
///   vec3 seen_light(vec3 p, vec3 n, vec3 v, vec3 color, ivec2 occluders, bool inside)
/// v: towards the eye. inside: the thing is cut open.
/// WALLS: there are walls, with rows Surfaces::rows(). SOLIDS: occluders may be boxes and cylinders. MESHES: and
/// meshes, by MeshShadows::shader().
extern const char* const material_shader;

}  // namespace carom
