// Tries every pair, then every three, then every four. There are few directions, those of the contacts of one body.
// The factors of two are those of least squares, the factors of three those of Cramer's rule.
#include "numerics/vanishing_sum.h"

#include "std.h"

namespace carom {
namespace {

class VanishingSum {
 public:
  VanishingSum(span<const Vec3> directions, size_t first, double tolerance)
      : directions_(directions), first_(first), tolerance_(tolerance) {}

  vector<size_t> find() {
    for (size_t count = 1; count <= 3; ++count) {
      others_.clear();
      if (!choose(0, count)) continue;
      others_.push_back(first_);
      ranges::sort(others_);
      return others_;
    }
    return {};
  }

 private:
  /// Adds `count` more of the directions from `from` on. Returns whether the sum vanishes with some of them.
  bool choose(size_t from, size_t count) {
    if (count == 0) return vanishes();
    for (size_t k = from; k < directions_.size(); ++k) {
      if (k == first_) continue;
      others_.push_back(k);
      if (choose(k + 1, count - 1)) return true;
      others_.pop_back();
    }
    return false;
  }

  bool vanishes() const {
    const Vec3& n = directions_[first_];
    const auto other = [&](size_t k) -> const Vec3& { return directions_[others_[k]]; };
    Vec3 factors(1, 0, 0);

    // The others balance the first one with these factors.
    if (others_.size() == 2) {
      const double cosine = other(0).dot(other(1)), a = -n.dot(other(0)), b = -n.dot(other(1));
      factors = Vec3(a - cosine * b, b - cosine * a, 0) / (1 - cosine * cosine);
    } else if (others_.size() == 3) {
      const Vec3 all(n.dot(other(1).cross(other(2))), n.dot(other(2).cross(other(0))), n.dot(other(0).cross(other(1))));
      factors = -all / other(0).dot(other(1).cross(other(2)));
    }

    Vec3 sum = n;
    for (size_t k = 0; k < others_.size(); ++k) {
      // False also where it is not a number: of directions that depend on one another.
      if (!(factors[static_cast<Eigen::Index>(k)] > 0)) return false;
      sum += factors[static_cast<Eigen::Index>(k)] * other(k);
    }
    return sum.norm() <= tolerance_;
  }

  span<const Vec3> directions_;
  const size_t first_;
  const double tolerance_;
  vector<size_t> others_;
};

}  // namespace

vector<size_t> vanishing_sum(span<const Vec3> directions, size_t first, double tolerance) {
  return VanishingSum(directions, first, tolerance).find();
}

}  // namespace carom
