#pragma once
// One still camera for motions that several cameras frame.

#include "render/camera.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

/// The nearest camera that looks as the first one does, and has in its view whatever each of the cameras has in its
/// own, farther than its eye. For cameras of other directions that holds for the plane through their target. Pictures
/// have this size. At least one camera.
Camera common_view(span<const Camera> cameras, Size size);

}  // namespace carom
