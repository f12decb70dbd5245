#include "numerics/monotone_path.h"

#include "std.h"

namespace carom {
namespace {

MonotoneCubic along(int axis, const vector<double>& at, const vector<Vec3>& point) {
  vector<double> value;
  for (const Vec3& p : point) value.push_back(p[axis]);
  return {at, std::move(value)};
}

}  // namespace

MonotonePath::MonotonePath(const vector<double>& at, const vector<Vec3>& point)
    : x_(along(0, at, point)), y_(along(1, at, point)), z_(along(2, at, point)) {}

}  // namespace carom
