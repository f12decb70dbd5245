#pragma once
// How things look: what light their surfaces send to the eye. One text for the shaders of all kinds of things.

namespace carom {

/// For a fragment shader behind Lighting::shader(), in the camera's frame:
///   float key_light(vec3 p, vec3 l, ivec2 occluders)
/// what the rows of Occluders::append_rows (first, count) let through;
///   vec3 seen_light(vec3 p, vec3 n, vec3 v, vec3 color, ivec2 occluders, bool inside)
/// v: to the eye; inside: of a thing that is cut open.
/// WALLS: there are some, whose rows are Surfaces::rows(); SOLIDS: occluders may be boxes and cylinders; MESHES: and
/// meshes, by MeshShadows::shader().
extern const char* const material_shader;

}  // namespace carom
