#pragma once
// The parts of a glTF file that assimp 5.2's exporter loses or changes, and the corrected file.
// The exporter writes no cameras and no lights, and drops a node at (1, 1, 1).
// It marks every material as a volume, and all motion between keyframes as linear.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

struct GlbCamera {
  double aspect, fov_y, near, far;  // width by height; radians; m
};

struct GlbLight {
  string name;
  bool directional;        // along the node's -z; otherwise from its position to all sides
  array<float, 3> linear;  // colour
  double intensity;        // lux, or candela
};

struct GlbNode {
  string name;
  Vec3 translation = Vec3::Zero();           // m
  array<double, 4> rotation = {0, 0, 0, 1};  // quaternion: x, y, z, w
  Vec3 scale = Vec3::Ones();
  vector<unsigned> meshes = {};  // of assimp's scene
  optional<GlbCamera> camera = nullopt;
  optional<GlbLight> light = nullopt;
};

/// The rotation with these axes x, y, z, which are orthogonal unit vectors.
array<double, 4> rotation_to(const Vec3& x, const Vec3& y, const Vec3& z);

/// The name of node i in assimp's scene. No scene file has it, so that it is never changed.
string exported_name(size_t node);

/// Returns assimp's file with corrected nodes. Scales change in steps. Throws RenderError.
string mended_glb(string_view file, const string& title, const vector<GlbNode>& nodes);

}  // namespace carom
