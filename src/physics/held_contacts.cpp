#include "physics/held_contacts.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace carom {

namespace {

struct Ends {
  double of_a, of_b;  // 1/kg
  double scale;       // 1 / sqrt(of_a + of_b)
};

Ends ends(std::span<const double> inverse_mass, const PressedPair& p) {
  const double of_a = inverse_mass[p.a], of_b = p.b == PressedPair::none ? 0 : inverse_mass[p.b];
  return {of_a, of_b, 1 / std::sqrt(of_a + of_b)};
}

}  // namespace

void hold(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<PressedPair> pairs) {
  const auto m = static_cast<Eigen::Index>(pairs.size());
  if (m == 0) return;
  Eigen::MatrixXd matrix(m, m);
  Eigen::VectorXd wanted(m);
  for (Eigen::Index c = 0; c < m; ++c) {
    const PressedPair& p = pairs[static_cast<std::size_t>(c)];
    const Ends of_p = ends(inverse_mass, p);
    const Vec3 w = p.b == PressedPair::none ? Vec3(-u[p.a]) : Vec3(u[p.b] - u[p.a]);
    wanted[c] = of_p.scale * (p.target - p.normal.dot(w));
    for (Eigen::Index d = 0; d <= c; ++d) {
      const PressedPair& q = pairs[static_cast<std::size_t>(d)];
      double shared = 0;  // 1/kg, with the sign of how the two move what they share
      if (p.a == q.a) shared += of_p.of_a;
      if (p.b == q.b && p.b != PressedPair::none) shared += of_p.of_b;
      if (p.a == q.b) shared -= of_p.of_a;
      if (p.b == q.a) shared -= of_p.of_b;
      matrix(c, d) = matrix(d, c) =
          c == d ? 1 : of_p.scale * ends(inverse_mass, q).scale * shared * p.normal.dot(q.normal);
    }
  }
  const Eigen::VectorXd forces = matrix.ldlt().solve(wanted);
  for (Eigen::Index c = 0; c < m; ++c) {
    PressedPair& p = pairs[static_cast<std::size_t>(c)];
    const Ends of_p = ends(inverse_mass, p);
    p.force = of_p.scale * forces[c];
    u[p.a] -= of_p.of_a * p.force * p.normal;
    if (p.b != PressedPair::none) u[p.b] += of_p.of_b * p.force * p.normal;
  }
}

}  // namespace carom
