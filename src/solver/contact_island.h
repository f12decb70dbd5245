#pragma once
// An island of contacts that share bodies, in units of its own. The methods behind contact_problem.h work on it.
// The certificate that judges their solutions is here too.

#include "numerics/compensated.h"
#include "solver/contact_constraint.h"
#include "std.h"

namespace carom {

/// 2^exponent times a number, as std::ldexp computes it, but faster.
class PowerOfTwo {
 public:
  explicit PowerOfTwo(int exponent)
      : half_(std::ldexp(1.0, exponent / 2)), rest_(std::ldexp(1.0, exponent - exponent / 2)) {}
  double operator*(double x) const { return x * half_ * rest_; }
  Vec3 operator*(const Vec3& x) const { return x * half_ * rest_; }

 private:
  double half_, rest_;
};

/// The unit of motion is a power of two near the greatest free motion or target. That of inverse mass is one near the
/// greatest. Other units therefore give the same digits. In y = u / root every contact is a row of unit length.
struct ContactIsland {
  struct Row {
    uint32_t a = 0, b = 0;  // b = ContactConstraint::fixed: an immovable thing
    bool bilateral = false;
    Vec3 normal = Vec3::Zero();  // from a to b
    double target = 0, slack = 0;
    double scale = 0;                                // 1 / (|normal| sqrt(1/m_a + 1/m_b)): makes the length 1
    Vec3 left = Vec3::Zero(), right = Vec3::Zero();  // the row in y: -left at a, right at b
    double force = 0;                                // a guess
    bool moves_b() const { return b != ContactConstraint::fixed; }
    /// The row times y (3 for each body).
    double dot(const double* y) const {
      const double* p = y + 3 * a;
      double sum = -(left.x() * p[0] + left.y() * p[1] + left.z() * p[2]);
      if (!moves_b()) return sum;
      const double* q = y + 3 * b;
      return sum + (right.x() * q[0] + right.y() * q[1] + right.z() * q[2]);
    }
    /// y += t times the row.
    void add_to(double* y, double t) const {
      for (int k = 0; k < 3; ++k) y[3 * a + uint32_t(k)] -= t * left[k];
      if (!moves_b()) return;
      for (int k = 0; k < 3; ++k) y[3 * b + uint32_t(k)] += t * right[k];
    }
  };

  vector<double> inverse_mass, root;  // by body; root: of inverse_mass
  vector<Vec3> free;                  // by body
  vector<Row> rows;
  double speed = 0;         // the greatest free motion or target, in [1/2, 2) unless all are 0
  int motion_exponent = 0;  // of the unit of motion
  int mass_exponent = 0;    // of the unit of inverse mass
  double mass_ratio = 1;    // the heaviest over the lightest
  bool unilateral = true;   // no row is bilateral

  // By body: log2 of its mass over the true one. Empty: all are true (close_mass_gaps).
  vector<int> heavier{};

  size_t unknowns() const { return 3 * free.size(); }
  /// The effect of the data's rounding on a row of unit length times the motion.
  double noise_scale(const Row& r) const { return r.scale * (std::abs(r.target) + (r.moves_b() ? 2 : 1) * speed); }
  /// Makes light bodies heavier by powers of two, until no gap between the masses of two bodies is more than 2^60. What
  /// is lighter by that changes no digit of a heavier body's motion, and rows of such bodies no longer look alike.
  void close_mass_gaps();
  /// By row: log2 of the true force over the one here; empty: 0. Forces that light bodies alone bear have their scale.
  vector<int> force_exponents(const vector<DoubleDouble>& force) const;
  /// An estimate of the longest of the shortest paths between rows, in steps between rows that share a body.
  /// It is the distance between the row farthest from the first one and the row farthest from that.
  size_t reach() const;
  /// Computes all that follows from inverse_mass, free, and the rows' bodies, normals, targets, slacks and guesses.
  void scale();
};

/// Answers have twice as many digits, so that refinement can remove the rounding of the factors.
struct ContactSolution {
  vector<DoubleDouble> motion;  // 3 for each body, in the island's unit
  vector<DoubleDouble> force;   // by row, in the island's unit
  vector<DoubleDouble> push;    // scratch: M (motion - free)
  vector<double> lacking;       // scratch: the imbalance
};

/// normal . (u_b - u_a) - target.
double excess(const ContactIsland::Row& row, const vector<DoubleDouble>& motion);

/// Stores free + M^-1 N force - motion, by coordinate, in solution.lacking. It is 0 for an exact solution.
void find_imbalance(const ContactIsland& island, ContactSolution& solution);

/// The certificate of a solution. It is the exact solution of data that differ by `change`, relative to each row's own
/// scale. Rows that press are off their target by that, and others fall short of it. The same holds for the difference
/// between motion and forces, relative to the greatest given motion or the body's own. `within_slack`: no row is
/// farther off than its slack (than rounding, where the slack is 0).
struct Judgement {
  double change = 0;
  bool within_slack = true;
};
Judgement judge(const ContactIsland& island, ContactSolution& solution);

/// The accepted change: 90 roundings, as many as the methods allow in their decisions.
inline constexpr double accepted_change = 90 * 0x1p-53;

}  // namespace carom
