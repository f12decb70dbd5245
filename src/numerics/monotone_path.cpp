#include "numerics/monotone_path.h"

namespace carom {
namespace {

MonotoneCubic along(int axis, const std::vector<double>& at, const std::vector<Vec3>& point) {
  std::vector<double> value;
  for (const Vec3& p : point) value.push_back(p[axis]);
  return {at, std::move(value)};
}

}  // namespace

MonotonePath::MonotonePath(const std::vector<double>& at, const std::vector<Vec3>& point)
    : x_(along(0, at, point)), y_(along(1, at, point)), z_(along(2, at, point)) {}

}  // namespace carom
