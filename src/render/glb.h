#pragma once
// A scene and its motion as a binary glTF 2 file, for Blender and similar programs. It has a node for each body and for
// each fixed thing, the camera and the lights.

#include "render/model.h"
#include "std.h"

namespace carom {

struct Scene;

/// Bodies have a translation for each keyframe, exact to float, with linear interpolation. From a merge on, the smaller
/// body has scale 0, and the joint one its new size. A camera that moves has keyframes too; its field of view is that
/// of the first. Colours are in linear light, y is up, times are in seconds. Meshes in colours of their own have base
/// colours, textures (PNG) and holes. Throws RenderError.
string glb(const Scene& scene, const KeyedMotion& motion);

}  // namespace carom
