// Extents of the three volumes in closed form.
#include "physics/volume.h"

#include <numbers>

#include "std.h"

namespace carom {

double Volume::reach() const {
  switch (shape) {
    case Shape::sphere:
      return half.x();
    case Shape::cylinder:
      return sqrt(half.x() * half.x() + half.y() * half.y());
    case Shape::box:
      break;
  }
  return half.norm();
}

double Volume::size() const {
  constexpr double pi = std::numbers::pi;
  switch (shape) {
    case Shape::sphere:
      return 4.0 / 3 * pi * half.x() * half.x() * half.x();
    case Shape::cylinder:
      return pi * half.x() * half.x() * 2 * half.y();
    case Shape::box:
      break;
  }
  return 8 * half.x() * half.y() * half.z();
}

double Volume::support(const Vec3& n) const {
  switch (shape) {
    case Shape::sphere:
      return half.x();
    case Shape::cylinder:
      return half.x() * sqrt(n.x() * n.x() + n.z() * n.z()) + half.y() * std::abs(n.y());
    case Shape::box:
      break;
  }
  return half.dot(n.cwiseAbs());
}

}  // namespace carom
