#pragma once
// A scene and its motion as a binary glTF 2 file, for Blender and its like: a node a body, a node a fixed thing, the
// camera, the lights. assimp writes meshes, materials and animation; what it has no words for is put in afterwards.
#include <string>

#include "render/model.h"

namespace carom {

struct Scene;

/// Bodies have a translation a key, exact to float, and straight lines between; from a merge on the smaller body has
/// scale 0, the joint one its new size. Colours are in linear light, y is up, times in seconds. Throws RenderError.
std::string glb(const Scene& scene, const KeyedMotion& motion);

}  // namespace carom
