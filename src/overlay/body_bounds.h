#pragma once
// Where bodies are in a picture.

#include "overlay/moment.h"
#include "std.h"

namespace carom {

/// Where a body is in a picture, in pixels from its upper left corner, y downwards.
struct BodyBounds {
  double left = 0, top = 0, right = 0, bottom = 0;
  friend bool operator==(const BodyBounds&, const BodyBounds&) = default;
};

/// The bounds of a body that is in front of the camera; for a cylinder that of the box around it. None: it is not.
optional<BodyBounds> bounds_of(const Moment& moment, Entity body);

}  // namespace carom
