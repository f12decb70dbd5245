// Contact among many bodies: a primal-dual interior point (Mehrotra, SIAM J. Optim. 2 (1992) 575), then a proximal
// Newton method. The interior point comes near the solution in few factorisations, however many contacts there are. It
// does not find the exact set of rows that press. The proximal Newton method finds that set. Its contacts yield a
// little, so that dependent contacts make no system singular. Refinement with residuals in double-double then removes
// what yielding and rounding have left.
#include "solver/contact_interior_point.h"

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

#include "std.h"

namespace carom {

namespace {

using Row = ContactIsland::Row;
using Vector = vector<double>;

constexpr double no_limit = infinity;
// A share of the effect of a force on its own row, by which a contact yields: at first.
constexpr double loosest = 1;
// The same at last.
constexpr double tightest = 1e-8;
// The same where forces are to be the least ones: it is a share of their squares.
constexpr double least_yield = 1e-10;
// After so many factorisations a guess is given up. That is half of the number for an island without a guess.
constexpr int guess_worth = 16;
// A share of the motion: the interior point ends at this error.
constexpr double handed_over = 1e-8;

/// 1 + J^T D J and its factors: a block for every body and one for every pair of bodies.
class ContactMatrix {
 public:
  explicit ContactMatrix(const ContactIsland& island) : island_(island), places_(island.rows.size()) {
    const auto n = int(island.unknowns());
    vector<Eigen::Triplet<double>> entries;

    // Adds the entries of a block that are in the matrix's lower half.
    const auto block = [&](uint32_t i, uint32_t j) {
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          if (i > j || k >= l) entries.emplace_back(3 * int(i) + k, 3 * int(j) + l, 0.0);
    };

    // The pattern: a block for each body, and one for each pair that a row connects.
    for (uint32_t i = 0; i < island.free.size(); ++i) block(i, i);
    for (const Row& r : island.rows)
      if (r.moves_b()) block(max(r.a, r.b), min(r.a, r.b));
    matrix_.resize(n, n);
    matrix_.setFromTriplets(entries.begin(), entries.end());

    // The positions of entries among the matrix's values.
    diagonal_.resize(island.free.size());
    for (uint32_t i = 0; i < diagonal_.size(); ++i)
      for (int k = 0, m = 0; k < 3; ++k)
        for (int l = 0; l <= k; ++l) diagonal_[i][size_t(m++)] = place(i, k, i, l);
    for (size_t c = 0; c < island.rows.size(); ++c) {
      const Row& r = island.rows[c];
      if (!r.moves_b()) continue;
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) places_[c][size_t(3 * k + l)] = place(max(r.a, r.b), k, min(r.a, r.b), l);
    }

    factors_.analyzePattern(matrix_);
  }

  double operations() const { return factors_.operations(); }
  int factorisations() const { return count_; }

  /// Factorises the matrix with D = weight, by row. False: it is not positive definite in floating point.
  bool factorise(const Vector& weight) {
    double* value = matrix_.valuePtr();
    std::fill(value, value + matrix_.nonZeros(), 0.0);

    // Starts from the unit matrix.
    for (const auto& d : diagonal_)
      for (size_t k : {0u, 2u, 5u}) value[d[k]] = 1;

    // Adds the share of each row.
    for (size_t c = 0; c < weight.size(); ++c) {
      if (weight[c] == 0) continue;
      const Row& r = island_.rows[c];
      add_square(value, r.a, weight[c], r.left);
      if (!r.moves_b()) continue;
      add_square(value, r.b, weight[c], r.right);

      const Vec3& high = r.a > r.b ? r.left : r.right;
      const Vec3& low = r.a > r.b ? r.right : r.left;
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) value[places_[c][size_t(3 * k + l)]] -= weight[c] * high[k] * low[l];
    }

    ++count_;
    factors_.factorize(matrix_);
    return factors_.info() == Eigen::Success;
  }

  void solve(Vector& r) const {
    Eigen::Map<Eigen::VectorXd> v(r.data(), static_cast<Eigen::Index>(r.size()));
    v = factors_.solve(v).eval();
  }

 private:
  struct Factors : Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> {
    double operations() const {
      double sum = 0;
      for (Eigen::Index k = 0; k < m_nonZerosPerCol.size(); ++k)
        sum += double(m_nonZerosPerCol[k]) * m_nonZerosPerCol[k];
      return sum;
    }
  };

  void add_square(double* value, uint32_t i, double weight, const Vec3& v) const {
    for (int k = 0, m = 0; k < 3; ++k)
      for (int l = 0; l <= k; ++l) value[diagonal_[i][size_t(m++)]] += weight * v[k] * v[l];
  }
  int place(uint32_t i, int k, uint32_t j, int l) const {
    const int* inner = matrix_.innerIndexPtr();
    const int column = 3 * int(j) + l;
    const int *first = inner + matrix_.outerIndexPtr()[column], *last = inner + matrix_.outerIndexPtr()[column + 1];
    return int(std::lower_bound(first, last, 3 * int(i) + k) - inner);
  }

  const ContactIsland& island_;
  Eigen::SparseMatrix<double> matrix_;  // lower half
  vector<array<int, 6>> diagonal_;
  // Positions of a row's off-diagonal block among the matrix's values.
  vector<array<int, 9>> places_;
  Factors factors_;
  int count_ = 0;
};

/// The weight of the rows that press. It is the same for all.
double weight_of(const Vector& weight) {
  return weight.empty() ? 0 : *ranges::max_element(weight);
}

double greatest(const Vector& v) {
  double most = 0;
  for (const double x : v) most = max(most, std::abs(x));
  return most;
}

}  // namespace

/// The unknowns are y, and for each row its force z and its excess w.
class ContactInteriorPoint::Method {
 public:
  explicit Method(const ContactIsland& island)
      : island_(island), matrix_(island), free_(island.unknowns()), y_(free_.size()), z_(island.rows.size(), 0.0) {
    for (size_t i = 0; i < free_.size(); ++i) free_[i] = island.free[i / 3][int(i % 3)] / island.root[i / 3];
    y_ = free_;
  }

  const ContactMatrix& matrix() const { return matrix_; }

  Judgement solve(ContactSolution& solution) {
    // From forces of a moment ago, the proximal Newton method alone converges in a few factorisations.
    bool guessed = false;
    for (size_t c = 0; c < rows(); ++c) {
      const Row& r = island_.rows[c];
      z_[c] = r.bilateral ? 0 : r.force / r.scale;
      guessed = guessed || z_[c] > 0;
    }

    if (guessed) {
      y_ = image(z_);
      if (find_pressing(tightest, guess_worth)) {
        refine(solution);
        if (const Judgement judgement = judge(island_, solution); judgement.within_slack) return judgement;
      }
      ranges::fill(z_, 0.0);
      y_ = free_;
    }

    // Otherwise the interior point comes near the solution. Contacts then yield less and less.
    if (!approach()) ranges::fill(z_, 0.0);
    for (double rho = loosest; rho > 0.5 * tightest; rho *= 1e-2)
      if (!find_pressing(rho)) break;

    refine(solution);
    return judge(island_, solution);
  }

  Judgement solve_least(ContactSolution& solution) {
    for (double rho = loosest; rho > 0.5 * least_yield; rho *= 1e-2) {
      ranges::fill(z_, 0.0);
      if (!find_pressing(rho)) break;
    }

    refine(solution);
    return judge(island_, solution);
  }

  vector<double> correct_hold() {
    Vector weight(rows());
    Vector former;
    Vector best;
    for (size_t c = 0; c < rows(); ++c) z_[c] = island_.rows[c].force / island_.rows[c].scale;
    double least = no_limit;
    for (int idle = 0;;) {
      // What they leave, as long as that becomes less, or other rows press.
      Vector left = image(z_);
      for (double& each : left) each = -each;
      const double size = greatest(left);
      for (size_t c = 0; c < rows(); ++c) weight[c] = z_[c] > 0 ? 1 / least_yield : 0;
      idle = size < 0.5 * least ? 0 : idle + 1;
      if (size < least) best = z_;
      least = min(least, size);

      const bool same = former == weight;
      if (idle > (same ? 0 : 4) || size == 0) return best;
      if (!same && !matrix_.factorise(weight)) return best;
      former = weight;
      matrix_.solve(left);
      for (size_t c = 0; c < rows(); ++c)
        if (weight[c] > 0) z_[c] = max(z_[c] + island_.rows[c].dot(left.data()) / least_yield, 0.0);
    }
  }

 private:
  size_t rows() const { return z_.size(); }
  double excess_of(const Vector& y, size_t c) const {
    const Row& r = island_.rows[c];
    return r.dot(y.data()) - r.scale * r.target;
  }

  /// Newton's method on y = free + J^T z, w = J y + d and z w = a value that decreases. It ends near the solution, or
  /// when progress ends. False: it got nowhere.
  bool approach() {
    const size_t m = rows();
    double worst = 0;
    double size = greatest(free_);

    // The greatest violation at the start.
    for (size_t c = 0; c < m; ++c) {
      const double e = excess_of(y_, c);
      worst = max(worst, island_.rows[c].bilateral ? std::abs(e) : -e);
    }
    if (worst == 0) return true;
    size = max(size, worst);

    // Every row that is not bilateral starts with a positive force and excess.
    Vector w(m);
    Vector weight(m);
    for (size_t c = 0; c < m; ++c) {
      w[c] = max(excess_of(y_, c), worst);
      z_[c] = island_.rows[c].bilateral ? 0 : worst;
    }

    double least_mean = no_limit;
    double least_off = no_limit;
    for (int idle = 0;;) {
      double gap = 0;
      double off = 0;
      size_t count = 0;

      // What the motion lacks of free + J^T z.
      Vector lacking = image(z_);
      for (size_t i = 0; i < y_.size(); ++i) {
        lacking[i] -= y_[i];
        off = max(off, std::abs(lacking[i]));
      }

      // The rows' weights, errors and products of force and excess.
      for (size_t c = 0; c < m; ++c) {
        if (island_.rows[c].bilateral) {
          weight[c] = 1 / tightest;
          continue;
        }
        weight[c] = z_[c] / w[c];
        gap += z_[c] * w[c];
        off = max(off, std::abs(excess_of(y_, c) - w[c]));
        ++count;
      }

      // It ends near the solution.
      if (count == 0) return true;
      const double mean = gap / double(count);
      if (mean <= handed_over * handed_over * size * size && off <= handed_over * size) return true;

      // Forces grow through a stack, and the mean with them, while the motion approaches what they imply.
      idle = mean < 0.9 * least_mean || off < 0.9 * least_off ? 0 : idle + 1;
      least_mean = min(least_mean, mean);
      least_off = min(least_off, off);
      if (idle > 4) return true;

      // A step that fails is undone.
      const Vector before_y = y_;
      const Vector before_z = z_;
      if (!matrix_.factorise(weight) || !step(lacking, w, gap, count)) {
        y_ = before_y;
        z_ = before_z;
        return isfinite(greatest(y_));
      }
    }
  }

  /// One predictor-corrector step of Mehrotra's method.
  bool step(const Vector& lacking, Vector& w, double gap, size_t count) {
    const size_t m = rows();
    Vector missing(m), product(m), dz(m), dw(m), dy;
    for (size_t c = 0; c < m; ++c) {
      missing[c] = excess_of(y_, c) - (island_.rows[c].bilateral ? 0 : w[c]);
      product[c] = -z_[c] * w[c];
    }

    // Newton's direction for the present `product`.
    const auto solve = [&] {
      dy = lacking;
      for (size_t c = 0; c < m; ++c) {
        const Row& r = island_.rows[c];
        r.add_to(dy.data(), r.bilateral ? -missing[c] / tightest : (product[c] - z_[c] * missing[c]) / w[c]);
      }
      matrix_.solve(dy);

      for (size_t c = 0; c < m; ++c) {
        const Row& r = island_.rows[c];
        const double rate = r.dot(dy.data()) + missing[c];
        dz[c] = r.bilateral ? -rate / tightest : (product[c] - z_[c] * rate) / w[c];
        dw[c] = rate;
      }
    };

    // The step length at which the first force or excess would be zero.
    const auto room = [&] {
      double length = no_limit;
      for (size_t c = 0; c < m; ++c) {
        if (island_.rows[c].bilateral) continue;
        if (dz[c] < 0) length = min(length, -z_[c] / dz[c]);
        if (dw[c] < 0) length = min(length, -w[c] / dw[c]);
      }
      return length;
    };

    // The predictor step goes straight for the solution. Its length sets the corrector's aim.
    solve();
    double length = min(1.0, room());
    double left = 0;
    for (size_t c = 0; c < m; ++c)
      if (!island_.rows[c].bilateral) left += (z_[c] + length * dz[c]) * (w[c] + length * dw[c]);

    // The corrector aims at equal products, and includes the predictor's second-order term.
    const double ratio = left / gap;
    const double aim = ratio * ratio * ratio * gap / double(count);
    for (size_t c = 0; c < m; ++c) product[c] += aim - dz[c] * dw[c];
    solve();
    length = min(1.0, 0.9995 * room());
    if (!(length > 0)) return false;

    // Takes the step, which must leave forces and excesses positive.
    for (size_t c = 0; c < m; ++c) {
      z_[c] += length * dz[c];
      if (island_.rows[c].bilateral) continue;
      w[c] += length * dw[c];
      if (!(z_[c] > 0) || !(w[c] > 0)) return false;
    }

    for (size_t i = 0; i < y_.size(); ++i) y_[i] += length * dy[i];
    return true;
  }

  /// free + J^T z.
  Vector image(const Vector& z) const {
    Vector y = free_;
    for (size_t c = 0; c < rows(); ++c)
      if (z[c] != 0) island_.rows[c].add_to(y.data(), z[c]);
    return y;
  }

  /// The nearest motion where contacts yield: the minimum of |y - free|^2 / 2 + sum max(0, t_c)^2 / (2 rho), t = rho z
  /// - w. The forces are t / rho.
  /// The method is Newton's with exact line searches. It ends when the set of t > 0 is right.
  /// False: there is no progress, or not within so many factorisations.
  bool find_pressing(double rho, int most = numeric_limits<int>::max()) {
    const size_t m = rows();
    Vector t(m), slope(m), weight(m), former, dy;

    double last_off = no_limit;
    for (double last = no_limit; matrix_.factorisations() < most;) {
      // The forces that this motion implies, and its merit.
      Vector forces(m);
      double merit = 0;
      for (size_t c = 0; c < m; ++c) {
        t[c] = rho * z_[c] - excess_of(y_, c);
        const bool presses = t[c] > 0 || island_.rows[c].bilateral;
        weight[c] = presses ? 1 / rho : 0;
        forces[c] = presses ? t[c] / rho : 0;
        merit += t[c] * forces[c];
      }
      for (size_t i = 0; i < y_.size(); ++i) merit += (y_[i] - free_[i]) * (y_[i] - free_[i]);

      // The gradient, with its sign reversed.
      dy = image(forces);
      for (size_t i = 0; i < dy.size(); ++i) dy[i] -= y_[i];
      const double off = greatest(dy);

      if (former == weight && off <= 1e-9 * (greatest(y_) + greatest(free_))) break;
      if (!(merit < last)) break;
      // With the same rows the first step would be exact, but for rounding.
      if (former == weight && !(off < 0.5 * last_off)) break;
      last = merit;
      last_off = off;

      // Newton's step, with the best length along it.
      if (former != weight && !matrix_.factorise(weight)) return false;
      former = weight;
      matrix_.solve(dy);
      for (size_t c = 0; c < m; ++c) slope[c] = island_.rows[c].dot(dy.data());
      const double length = best_length(dy, t, slope, rho);
      if (!isfinite(length)) return false;
      for (size_t i = 0; i < dy.size(); ++i) y_[i] += length * dy[i];
    }

    // The forces of the last motion.
    for (size_t c = 0; c < m; ++c) {
      const double force = z_[c] - excess_of(y_, c) / rho;
      z_[c] = island_.rows[c].bilateral ? force : max(force, 0.0);
    }
    return matrix_.factorisations() < most;
  }

  /// The minimum along dy. The derivative is linear between the points where a row starts or ceases to press.
  double best_length(const Vector& dy, const Vector& t, const Vector& slope, double rho) const {
    // The derivative at 0, and its rate of growth.
    double at = 0;
    double rise = 0;
    for (size_t i = 0; i < dy.size(); ++i) {
      at += dy[i] * (y_[i] - free_[i]);
      rise += dy[i] * dy[i];
    }

    // The points where a row starts or ceases to press.
    vector<pair<double, size_t>> turns;
    const auto presses = [&](size_t c) { return t[c] > 0 || (t[c] == 0 && slope[c] < 0) || island_.rows[c].bilateral; };

    for (size_t c = 0; c < t.size(); ++c) {
      if (presses(c)) {
        at -= t[c] * slope[c] / rho;
        rise += slope[c] * slope[c] / rho;
      }
      if (island_.rows[c].bilateral || slope[c] == 0) continue;
      if (const double turn = t[c] / slope[c]; turn > 0) turns.emplace_back(turn, c);
    }

    // Goes from turn to turn as long as the derivative is negative.
    ranges::sort(turns);
    double from = 0;
    for (const auto& [turn, c] : turns) {
      const double there = at + rise * (turn - from);
      if (there >= 0) break;
      at = there;
      from = turn;
      rise += (t[c] > 0 ? -1 : 1) * slope[c] * slope[c] / rho;
    }

    return from - at / rise;
  }

  /// The same proximal steps with residuals in twice as many digits. Each leaves the share rho / (rho + lambda) of the
  /// error. lambda is the least eigenvalue among the rows that press. The factors' rounding leaves about eps / rho.
  /// Where the first limits progress, contacts are made to yield less.
  void refine(ContactSolution& solution) {
    constexpr double stiffest = 1e-13;
    const size_t n = y_.size();
    const size_t m = rows();
    solution.motion.resize(n);
    solution.force.resize(m);
    for (size_t i = 0; i < n; ++i) solution.motion[i] = {island_.root[i / 3] * y_[i], 0};
    for (size_t c = 0; c < m; ++c) solution.force[c] = {island_.rows[c].scale * z_[c], 0};

    Vector weight(m);
    Vector former;
    Vector lacking;
    Vector short_by(m);
    double last = no_limit;
    double rho = tightest;

    for (int idle = 0;;) {
      // What each row is short by, and whether it presses.
      for (size_t c = 0; c < m; ++c) {
        const Row& r = island_.rows[c];
        short_by[c] = -r.scale * excess(r, solution.motion);
        const bool presses = r.bilateral || solution.force[c].hi / r.scale + short_by[c] / rho > 0;
        weight[c] = presses ? 1 / rho : 0;
        if (!presses) solution.force[c] = {0, 0};
      }

      // The right-hand side: the imbalance of forces, and what rows are short by.
      find_imbalance(island_, solution);
      lacking = solution.lacking;
      for (size_t i = 0; i < n; ++i) lacking[i] /= island_.root[i / 3];
      for (size_t c = 0; c < m; ++c)
        if (weight[c] != 0) island_.rows[c].add_to(lacking.data(), short_by[c] / rho);

      // The correction of the motion.
      const bool same = former == weight;
      if (!same && !matrix_.factorise(weight)) return;
      former = weight;
      matrix_.solve(lacking);
      const double size = greatest(lacking);
      if (!isfinite(size)) return;

      idle = size < 0.5 * last ? 0 : idle + 1;
      const double used = weight_of(weight);
      // Where progress is slow, contacts are made to yield less.
      if (!(size < 0.1 * last) && rho > stiffest) {
        rho *= 1e-1;
        idle = 0;
      }
      if (idle > (same ? 2 : 8)) return;
      last = min(last, size);

      // Adds the correction to the motion and to the forces.
      for (size_t i = 0; i < n; ++i)
        solution.motion[i] = solution.motion[i] + DoubleDouble{island_.root[i / 3] * lacking[i], 0};
      for (size_t c = 0; c < m; ++c) {
        if (weight[c] == 0) continue;
        const Row& r = island_.rows[c];
        const double dz = (short_by[c] - r.dot(lacking.data())) * used;
        solution.force[c] = solution.force[c] + DoubleDouble{r.scale * dz, 0};
        if (!r.bilateral && solution.force[c].hi < 0) solution.force[c] = {0, 0};
      }

      if (size <= 0x1p-92 * greatest(y_)) return;
    }
  }

  const ContactIsland& island_;
  ContactMatrix matrix_;
  Vector free_;  // the free motion, over the roots of inverse masses
  Vector y_;     // the motion, over the same
  Vector z_;     // by row: its force, over its scale
};

ContactInteriorPoint::ContactInteriorPoint(const ContactIsland& island) : method_(make_unique<Method>(island)) {}
ContactInteriorPoint::~ContactInteriorPoint() = default;
double ContactInteriorPoint::operations() const {
  return method_->matrix().operations();
}
Judgement ContactInteriorPoint::solve(ContactSolution& solution) {
  return method_->solve(solution);
}
Judgement ContactInteriorPoint::solve_least(ContactSolution& solution) {
  return method_->solve_least(solution);
}
vector<double> ContactInteriorPoint::correct_hold() {
  return method_->correct_hold();
}

}  // namespace carom
