// The complementarity problem by a primal-dual interior-point method (Mehrotra, SIAM J. Optim. 2 (1992) 575): where
// bodies press on one another nearly as often as they can move, the problem is so ill-conditioned that conjugate
// gradients need many thousands of iterations, and this a dozen.
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "physics/complementarity.h"

namespace carom {

namespace {

/// Unknowns: y, velocities times the root of the mass, and by pair x, its force, and s, by how much its motion exceeds
/// its target, both scaled so that the pair's own effect on itself is 1. Newton's method on y = free + J^T x,
/// s = J y - target, x s = less and less.
class InteriorPoint {
 public:
  InteriorPoint(std::span<const double> inverse_mass, std::span<const Vec3> u, std::span<const PressedPair> pairs)
      : bodies_(u.size()), rows_(pairs.size()), x_(pairs.size()), s_(pairs.size()) {
    for (std::size_t i = 0; i < bodies_; ++i) free_.push_back(u[i] / std::sqrt(inverse_mass[i]));
    for (std::size_t c = 0; c < rows_.size(); ++c) {
      const PressedPair& p = pairs[c];
      const bool fixed = p.b == PressedPair::none;
      const double scale = 1 / std::sqrt(inverse_mass[p.a] + (fixed ? 0 : inverse_mass[p.b]));
      rows_[c] = {scale * std::sqrt(inverse_mass[p.a]) * p.normal,
                  fixed ? Vec3(Vec3::Zero()) : Vec3(scale * std::sqrt(inverse_mass[p.b]) * p.normal),
                  scale * p.target,
                  scale * p.slack,
                  scale,
                  p.a,
                  p.b};
      x_[c] = std::max(p.force, 0.0) / scale;
    }
    lay_out();
  }

  bool run(int iterations) {
    // Bodies wedged between others could press without bound: contacts yield to forces far beyond all that is needed.
    double least_slack = rows_[0].slack, greatest = 0;
    for (std::size_t c = 0; c < rows_.size(); ++c) {
      least_slack = std::min(least_slack, rows_[c].slack);
      greatest = std::max(greatest, -excess(free_, c));
    }
    if (greatest > 0) yielding_ = 1e-3 * least_slack / greatest;
    y_ = pushed(x_);
    double off = 0;
    for (std::size_t c = 0; c < rows_.size(); ++c) {
      const double r = excess(y_, c);
      off = std::max(off, x_[c] > 0 ? std::abs(std::min(r, x_[c])) : -r);
    }
    if (off == 0) return true;
    for (std::size_t c = 0; c < rows_.size(); ++c) {
      x_[c] = std::max(x_[c], off);
      s_[c] = std::max(excess(y_, c), off);
    }
    for (int k = 0; k < iterations; ++k) {
      if (good()) return true;
      if (!step()) return false;
    }
    return good();
  }

  /// kg times the unit of u, by pair.
  double force(std::size_t c) const { return x_[c] > s_[c] ? x_[c] * rows_[c].scale : 0; }

 private:
  struct Row {
    Vec3 left, right;  // of J: -left at body a, right at body b
    double target, slack, scale;
    std::uint32_t a, b;
    std::array<int, 9> at{};  // of its off-diagonal block, among the matrix's values
  };

  double held(std::size_t c) const { return s_[c] + yielding_ * x_[c]; }
  double along(const std::vector<Vec3>& y, std::size_t c) const {
    const Row& r = rows_[c];
    return (r.b == PressedPair::none ? 0 : r.right.dot(y[r.b])) - r.left.dot(y[r.a]);
  }
  double excess(const std::vector<Vec3>& y, std::size_t c) const { return along(y, c) - rows_[c].target; }
  void push(std::vector<Vec3>& y, std::size_t c, double x) const {
    const Row& r = rows_[c];
    y[r.a] -= x * r.left;
    if (r.b != PressedPair::none) y[r.b] += x * r.right;
  }
  std::vector<Vec3> pushed(const std::vector<double>& x) const {
    std::vector<Vec3> y = free_;
    for (std::size_t c = 0; c < rows_.size(); ++c) push(y, c, x[c]);
    return y;
  }

  /// The matrix 1 + J^T D J has a block for every body and one for every pair of bodies.
  void lay_out() {
    const auto n = static_cast<int>(3 * bodies_);
    std::vector<Eigen::Triplet<double>> entries;
    const auto block = [&](std::uint32_t i, std::uint32_t j) {
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          if (i > j || k >= l) entries.emplace_back(3 * static_cast<int>(i) + k, 3 * static_cast<int>(j) + l, 0.0);
    };
    for (std::uint32_t i = 0; i < bodies_; ++i) block(i, i);
    for (const Row& r : rows_)
      if (r.b != PressedPair::none) block(std::max(r.a, r.b), std::min(r.a, r.b));
    matrix_.resize(n, n);
    matrix_.setFromTriplets(entries.begin(), entries.end());
    const auto place = [&](std::uint32_t i, int k, std::uint32_t j, int l) {
      const int* inner = matrix_.innerIndexPtr();
      const int column = 3 * static_cast<int>(j) + l;
      return static_cast<int>(std::lower_bound(inner + matrix_.outerIndexPtr()[column],
                                               inner + matrix_.outerIndexPtr()[column + 1],
                                               3 * static_cast<int>(i) + k) -
                              inner);
    };
    diagonal_.resize(bodies_);
    for (std::uint32_t i = 0; i < bodies_; ++i)
      for (int k = 0, m = 0; k < 3; ++k)
        for (int l = 0; l <= k; ++l) diagonal_[i][static_cast<std::size_t>(m++)] = place(i, k, i, l);
    for (Row& r : rows_)
      if (r.b != PressedPair::none)
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l)
            r.at[static_cast<std::size_t>(3 * k + l)] = place(std::max(r.a, r.b), k, std::min(r.a, r.b), l);
    factors_.analyzePattern(matrix_);
  }

  void fill_in() {
    double* value = matrix_.valuePtr();
    std::fill(value, value + matrix_.nonZeros(), 0.0);
    for (const auto& d : diagonal_)
      for (std::size_t k : {0u, 2u, 5u}) value[d[k]] = 1;
    for (std::size_t c = 0; c < rows_.size(); ++c) {
      const Row& r = rows_[c];
      const double weight = x_[c] / held(c);
      const auto square = [&](std::uint32_t i, const Vec3& v) {
        for (int k = 0, m = 0; k < 3; ++k)
          for (int l = 0; l <= k; ++l) value[diagonal_[i][static_cast<std::size_t>(m++)]] += weight * v[k] * v[l];
      };
      square(r.a, r.left);
      if (r.b == PressedPair::none) continue;
      square(r.b, r.right);
      const Vec3 &high = r.a > r.b ? r.left : r.right, &low = r.a > r.b ? r.right : r.left;
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) value[r.at[static_cast<std::size_t>(3 * k + l)]] -= weight * high[k] * low[l];
    }
  }

  bool good() const {
    std::vector<double> x = x_;
    for (std::size_t c = 0; c < rows_.size(); ++c)
      if (!(x_[c] > s_[c])) x[c] = 0;
    const std::vector<Vec3> y = pushed(x);
    for (std::size_t c = 0; c < rows_.size(); ++c) {
      const double r = excess(y, c);
      if (!((x[c] > 0 ? std::abs(std::min(r, x[c])) : -r) <= rows_[c].slack)) return false;
    }
    return true;
  }

  bool step() {
    const std::size_t m = rows_.size();
    fill_in();
    factors_.factorize(matrix_);
    if (factors_.info() != Eigen::Success) return false;
    const std::vector<Vec3> image = pushed(x_);
    std::vector<double> missing(m), product(m), dx(m), ds(m);
    double gap = 0;
    for (std::size_t c = 0; c < m; ++c) {
      missing[c] = excess(y_, c) + yielding_ * x_[c] - s_[c];
      product[c] = -x_[c] * s_[c];
      gap -= product[c];
    }
    std::vector<Vec3> dy(bodies_);
    const auto solve = [&] {
      for (std::size_t i = 0; i < bodies_; ++i) dy[i] = image[i] - y_[i];
      for (std::size_t c = 0; c < m; ++c) push(dy, c, (product[c] - x_[c] * missing[c]) / held(c));
      Eigen::VectorXd b(static_cast<int>(3 * bodies_));
      for (std::size_t i = 0; i < bodies_; ++i) b.segment<3>(static_cast<int>(3 * i)) = dy[i];
      b = factors_.solve(b).eval();
      for (std::size_t i = 0; i < bodies_; ++i) dy[i] = b.segment<3>(static_cast<int>(3 * i));
      for (std::size_t c = 0; c < m; ++c) {
        const double way = along(dy, c) + missing[c];
        dx[c] = (product[c] - x_[c] * way) / held(c);
        ds[c] = way + yielding_ * dx[c];
      }
    };
    const auto room = [&] {
      double length = 1;
      for (std::size_t c = 0; c < m; ++c) {
        if (dx[c] < 0) length = std::min(length, -x_[c] / dx[c]);
        if (ds[c] < 0) length = std::min(length, -s_[c] / ds[c]);
      }
      return length;
    };
    solve();  // straight at the goal: how far does that get?
    double length = room(), left = 0;
    for (std::size_t c = 0; c < m; ++c) left += (x_[c] + length * dx[c]) * (s_[c] + length * ds[c]);
    const double ratio = left / gap, aim = ratio * ratio * ratio * gap / static_cast<double>(m);
    for (std::size_t c = 0; c < m; ++c) product[c] += aim - dx[c] * ds[c];
    solve();
    length = std::min(1.0, 0.995 * room());
    for (std::size_t c = 0; c < m; ++c) {
      x_[c] += length * dx[c];
      s_[c] += length * ds[c];
      if (!(x_[c] > 0) || !(s_[c] > 0)) return false;
    }
    for (std::size_t i = 0; i < bodies_; ++i) y_[i] += length * dy[i];
    return true;
  }

  std::size_t bodies_;
  std::vector<Row> rows_;
  std::vector<Vec3> free_, y_;
  std::vector<double> x_, s_;
  double yielding_ = 0;                 // what a force of 1 lets the motion fall short by
  Eigen::SparseMatrix<double> matrix_;  // lower half
  std::vector<std::array<int, 6>> diagonal_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factors_;
};

}  // namespace

bool press_apart_directly(std::span<const double> inverse_masses, std::span<Vec3> u, std::span<PressedPair> pairs) {
  if (pairs.empty()) return true;
  const double unit = power_of_two_near(inverse_masses);
  std::vector<double> inverse_mass(inverse_masses.begin(), inverse_masses.end());
  for (double& w : inverse_mass) w /= unit;
  std::vector<PressedPair> scaled(pairs.begin(), pairs.end());
  for (PressedPair& p : scaled) p.force *= unit;
  InteriorPoint method(inverse_mass, u, scaled);
  const bool done = method.run(60);
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    PressedPair& p = pairs[c];
    const double force = method.force(c);
    p.force = force / unit;
    u[p.a] -= inverse_mass[p.a] * force * p.normal;
    if (p.b != PressedPair::none) u[p.b] += inverse_mass[p.b] * force * p.normal;
  }
  return done;
}

}  // namespace carom
