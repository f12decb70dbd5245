#pragma once
// A parallel projection is a perspective one from so far away that it cannot be told from it. Rays, outlines, shadows
// and lines then need no second form. The distance is a compromise: a nearer eye shows perspective, and from a farther
// one floats (eye.h) resolve less.

#include "render/camera.h"

namespace carom {

/// The distance of the eye, in that of a camera with the scene's field of view.
inline constexpr double times_farther = 1000;

/// The same camera so much farther from its target, with a field of view that is so much narrower.
Camera from_afar(Camera camera);
/// The same camera nearer again.
Camera from_near(Camera camera);

}  // namespace carom
