#pragma once
// Contacts that share bodies and have nothing to do with others, in numbers and units of their own: what the methods
// behind contact_problem.h work on, and the certificate that judges their answers.
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "numerics/compensated.h"
#include "solver/contact_problem.h"

namespace carom {

/// 2^exponent times a number, as std::ldexp and faster.
class PowerOfTwo {
 public:
  explicit PowerOfTwo(int exponent)
      : half_(std::ldexp(1.0, exponent / 2)), rest_(std::ldexp(1.0, exponent - exponent / 2)) {}
  double operator*(double x) const { return x * half_ * rest_; }
  Vec3 operator*(const Vec3& x) const { return x * half_ * rest_; }

 private:
  double half_, rest_;
};

/// The unit of motion is a power of two near the greatest free motion or target, that of inverse mass one near the
/// greatest: other units give the same digits. In y = u / root every contact is a row of unit length.
struct ContactIsland {
  struct Row {
    std::uint32_t a = 0, b = 0;  // b ContactConstraint::fixed: something that nothing moves
    bool bilateral = false;
    Vec3 normal = Vec3::Zero();  // from a to b
    double target = 0, slack = 0;
    double scale = 0;                                // 1 / (|normal| sqrt(1/m_a + 1/m_b)): makes the length 1
    Vec3 left = Vec3::Zero(), right = Vec3::Zero();  // the row in y: -left at a, right at b
    double force = 0;                                // a guess
    bool moves_b() const { return b != ContactConstraint::fixed; }
    /// The row times y (3 a body).
    double dot(const double* y) const {
      const double* p = y + 3 * a;
      double sum = -(left.x() * p[0] + left.y() * p[1] + left.z() * p[2]);
      if (!moves_b()) return sum;
      const double* q = y + 3 * b;
      return sum + (right.x() * q[0] + right.y() * q[1] + right.z() * q[2]);
    }
    /// y += t times the row.
    void add_to(double* y, double t) const {
      for (int k = 0; k < 3; ++k) y[3 * a + static_cast<std::uint32_t>(k)] -= t * left[k];
      if (!moves_b()) return;
      for (int k = 0; k < 3; ++k) y[3 * b + static_cast<std::uint32_t>(k)] += t * right[k];
    }
  };

  std::vector<double> inverse_mass, root;  // by body; root: of inverse_mass
  std::vector<Vec3> free;                  // by body
  std::vector<Row> rows;
  double speed = 0;         // the greatest free motion or target: in [1/2, 2) unless all is 0
  int motion_exponent = 0;  // of the unit of motion
  int mass_exponent = 0;    // of the unit of inverse mass
  double mass_ratio = 1;    // the heaviest over the lightest
  bool unilateral = true;   // no row is bilateral

  std::size_t unknowns() const { return 3 * free.size(); }
  /// What rounding of the data can do to a row of unit length times the motion.
  double noise_scale(const Row& r) const { return r.scale * (std::abs(r.target) + (r.moves_b() ? 2 : 1) * speed); }
  /// From row to row that share a body, how many steps the longest of the shortest paths has, about: from the row that
  /// is farthest from the first one to the one that is farthest from it.
  std::size_t reach() const;
  /// Fills in all that follows from inverse_mass, free, and the rows' bodies, normals, targets, slacks and guesses.
  void scale();
};

/// Twice as many digits: refinement finds what the factors' rounding has left.
struct ContactAnswer {
  std::vector<DoubleDouble> motion;  // 3 a body, in the island's unit
  std::vector<DoubleDouble> force;   // by row, in the island's unit
  std::vector<DoubleDouble> push;    // room for M (motion - free)
  std::vector<double> lacking;       // and for what it lacks
};

/// normal . (u_b - u_a) - target.
double excess(const ContactIsland::Row& row, const std::vector<DoubleDouble>& motion);

/// Leaves in answer.lacking, by coordinate, free + M^-1 N force - motion: 0 for an exact answer.
void find_imbalance(const ContactIsland& island, ContactAnswer& answer);

/// The data of which the answer is the exact solution differ by this, relative to each row's own scale: rows that press
/// are off their target, others short of it. Or bodies do not move as the forces say, relative to the greatest motion
/// given or to their own. `within_slack`: no row is farther off than its slack (where it is 0: than rounding).
struct Judgement {
  double change = 0;
  bool within_slack = true;
};
Judgement judge(const ContactIsland& island, ContactAnswer& answer);

/// What an answer may be off by: 90 roundings, as many as the decisions of the methods allow themselves.
inline constexpr double accepted_change = 90 * 0x1p-53;

}  // namespace carom
