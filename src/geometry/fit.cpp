// The smallest enclosing sphere, circle or box of a cloud of points. Sphere and circle take the farthest point into a
// basis of at most four points, again and again (Gärtner 1999). Weights that are wrong by rounding only give a smaller
// sphere, so that points nearly in a line or a plane need no special case.
#include "geometry/fit.h"

#include <Eigen/QR>

#include "std.h"

namespace carom {
namespace {

using Points = span<const Vec3>;

/// Up to four points and their weights in the centre of their smallest sphere.
struct Basis {
  array<Vec3, 4> points;
  array<double, 4> weights{};
  int count = 0;
  Vec3 center = Vec3::Zero();
  double square = 0;
};

// The smallest sphere by its dual. For all weights w >= 0 of sum 1, with c = sum w p,
//   sum w |p - c|^2 <= R^2.
// Equality holds for the points that determine the smallest sphere, with the weights of its centre among them.
// Weights that are wrong by rounding, as for points nearly in a line or a plane, give a smaller value and never win.
// The farthest point's distance from c bounds R from above.
void weigh(Basis& basis) {
  double sum = 0;
  for (int i = 0; i < basis.count; ++i) sum += basis.weights[i];
  basis.center.setZero();
  for (int i = 0; i < basis.count; ++i) {
    basis.weights[i] /= sum;
    basis.center += basis.weights[i] * basis.points[i];
  }
  basis.square = 0;
  for (int i = 0; i < basis.count; ++i)
    basis.square += basis.weights[i] * (basis.points[i] - basis.center).squaredNorm();
}

/// Weights of the point equally far from all points of the basis, in their affine hull. False: it is not between them,
/// so that fewer points determine the sphere.
bool solve(Basis& basis) {
  const int n = basis.count - 1;
  if (n == 0) {
    basis.weights[0] = 1;
    weigh(basis);
    return true;
  }

  // With V = (p_i - p_0) = Q R: c = V m and V^T c = |p_i - p_0|^2 / 2. So R^T (Q^T c) = |..|^2 / 2 and R m = Q^T c.
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> edges(3, n);
  for (int i = 0; i < n; ++i) edges.col(i) = basis.points[i + 1] - basis.points[0];
  const Eigen::ColPivHouseholderQR<decltype(edges)> qr(edges);
  if (qr.rank() < n) return false;

  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;
  const auto triangle = qr.matrixR().topLeftCorner(n, n).template triangularView<Eigen::Upper>();
  Column m = qr.colsPermutation().transpose() * Column(0.5 * edges.colwise().squaredNorm().transpose());
  triangle.transpose().solveInPlace(m);
  triangle.solveInPlace(m);
  m = qr.colsPermutation() * m;

  // The weights of all points. A negative one: fewer points determine the sphere.
  basis.weights[0] = 1 - m.sum();
  for (int i = 0; i < n; ++i) basis.weights[i + 1] = m[i];
  for (int i = 0; i < basis.count; ++i)
    if (!(basis.weights[i] >= 0)) return false;
  weigh(basis);
  return true;
}

/// The smallest sphere around the basis and one more point outside of it: the largest of the smallest spheres around
/// their subsets. Only those with the new point can have grown.
Basis joined(const Basis& basis, const Vec3& point) {
  Basis best = basis;
  for (unsigned subset = 0; subset < 1U << basis.count; ++subset) {
    Basis candidate;
    candidate.points[0] = point;
    candidate.count = 1;
    for (int i = 0; i < basis.count && candidate.count < 5; ++i) {
      if (!(subset >> i & 1U)) continue;
      if (candidate.count < 4) candidate.points[candidate.count] = basis.points[i];
      ++candidate.count;
    }

    if (candidate.count < 5 && solve(candidate) && candidate.square > best.square) best = candidate;
  }
  return best;
}

/// Centre of the smallest sphere. Each pass takes in the farthest point (Gärtner 1999).
/// The radius grows until no point is outside by more than rounding. A dozen passes are many.
Vec3 sphere_center(Points points) {
  Basis basis;
  basis.points[0] = points.front();
  basis.count = 1;
  solve(basis);

  Vec3 best = basis.center;
  double best_square = infinity;
  while (true) {
    double square = -1;
    const Vec3* farthest = nullptr;
    for (const Vec3& p : points) {
      const double s = (p - basis.center).squaredNorm();
      if (s > square) square = s, farthest = &p;
    }

    // Rounding ends the growth.
    if (square < best_square) best_square = square, best = basis.center;
    if (square <= basis.square) return best;
    const Basis next = joined(basis, *farthest);
    if (!(next.square > basis.square)) return best;
    basis = next;
  }
}

double farthest_from(const Vec3& center, Points points) {
  double square = 0;
  for (const Vec3& p : points) square = max(square, (p - center).squaredNorm());
  // Rounded up, so that no point is outside by the rounding of its own distance.
  return sqrt(square) * (1 + 2 * numeric_limits<double>::epsilon());
}

}  // namespace

Fit tightest(Shape shape, Points points) {
  if (points.empty()) throw std::invalid_argument("there are no points to fit a volume around");
  Vec3 low = points.front(), high = points.front();
  for (const Vec3& p : points) {
    if (!p.allFinite()) throw std::invalid_argument("a point is not finite");
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }

  const Vec3 extent = high - low, middle = low + 0.5 * extent;
  if (!extent.allFinite()) throw std::invalid_argument("the points are too far apart");
  const double size = extent.maxCoeff();
  if (!(size > 0)) throw std::invalid_argument("all points are in one place: a volume around them has no size");

  // Near the origin and near size 1 the exponent's range loses no square.
  const double across = shape == Shape::cylinder ? max(extent.x(), extent.z()) : size;
  if (!(across > 0))
    throw std::invalid_argument("the points have no extent along x and z: a cylinder around them has no radius");
  const double unit = std::ldexp(1.0, std::ilogb(across));

  vector<Vec3> near;
  if (shape != Shape::box) {
    near.reserve(points.size());
    // A cylinder's points are taken as seen from above.
    const Vec3 seen = shape == Shape::sphere ? Vec3(1, 1, 1) : Vec3(1, 0, 1);
    for (const Vec3& p : points) near.push_back(((p - middle) / unit).cwiseProduct(seen));
  }

  Fit fit{{shape, Vec3::Zero()}, middle};
  if (shape != Shape::box) {
    const Vec3 center = sphere_center(near);
    fit.center += center * unit;

    // From the centre as rounded.
    for (size_t i = 0; i < points.size(); ++i) {
      near[i] = (points[i] - fit.center) / unit;
      if (shape == Shape::cylinder) near[i].y() = 0;
    }
    const double radius = farthest_from(Vec3::Zero(), near) * unit;
    fit.volume = shape == Shape::sphere ? Volume::sphere(radius) : Volume::cylinder(radius, 0);
  }

  // Extents along the axes.
  if (shape != Shape::sphere) {
    const bool box = shape == Shape::box;
    for (int axis = 0; axis < 3; ++axis) {
      if (!box && axis != 1) continue;
      if (extent[axis] == 0)
        throw std::invalid_argument(string("the points have no extent along ") + "xyz"[axis] + ": a " +
                                    (box ? "box" : "cylinder") + " around them has no thickness");
      fit.volume.half[axis] = max(high[axis] - fit.center[axis], fit.center[axis] - low[axis]);
    }
  }
  return fit;
}

}  // namespace carom
