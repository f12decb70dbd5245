#pragma once
// The curve of a rope that hangs between two points: a catenary.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

/// The points of a rope of this length (m) after its start `from`, until `to`, for strokes between them. `down`: the
/// unit direction of gravity; zero: the rope is drawn straight. Strokes are off the curve by at most `error` (m),
/// unless that takes more than 64 of them. A rope that is not longer than the distance of its ends is one stroke.
vector<Vec3> hanging_curve(const Vec3& from, const Vec3& to, double length, const Vec3& down, double error);

}  // namespace carom
