#pragma once
// The parts of a glTF file that assimp 5.2's exporter loses or changes, and the corrected file.
// The exporter writes no cameras and no lights, and drops a node at (1, 1, 1).
// It marks every material as a volume, and all motion between keyframes as linear.
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "numerics/vec3.h"

namespace carom {

struct GlbCamera {
  double aspect, fov_y, near, far;  // width by height; radians; m
};

struct GlbLight {
  std::string name;
  bool directional;             // along the node's -z; otherwise from its position to all sides
  std::array<float, 3> linear;  // colour
  double intensity;             // lux, or candela
};

struct GlbNode {
  std::string name;
  Vec3 translation = Vec3::Zero();                // m
  std::array<double, 4> rotation = {0, 0, 0, 1};  // quaternion: x, y, z, w
  Vec3 scale = Vec3::Ones();
  std::vector<unsigned> meshes = {};  // of assimp's scene
  std::optional<GlbCamera> camera = std::nullopt;
  std::optional<GlbLight> light = std::nullopt;
};

/// The rotation with these axes x, y, z, which are orthogonal unit vectors.
std::array<double, 4> rotation_to(const Vec3& x, const Vec3& y, const Vec3& z);

/// The name of node i in assimp's scene. No scene file has it, so that it is never changed.
std::string exported_name(std::size_t node);

/// Returns assimp's file with corrected nodes. Scales change in steps. Throws RenderError.
std::string mended_glb(std::string_view file, const std::string& title, const std::vector<GlbNode>& nodes);

}  // namespace carom
