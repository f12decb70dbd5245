#pragma once
// Contact among many bodies by a primal-dual interior point (Mehrotra, SIAM J. Optim. 2 (1992) 575).
// A proximal Newton method then finds which rows press. Residuals in twice as many digits refine the solution.
// Every system is (1 + J^T D J) dy = r on the bodies. It is sparse and never singular, however many contacts depend on
// each other.

#include "solver/contact_island.h"
#include "std.h"

namespace carom {

class ContactInteriorPoint {
 public:
  explicit ContactInteriorPoint(const ContactIsland& island);
  ~ContactInteriorPoint();

  /// An estimate of the multiplications and additions of one factorisation.
  double operations() const;

  Judgement solve(ContactSolution& solution);
  /// The same for an island with dependent rows: of all forces with that motion, those with the least sum of squares
  /// of force over scale. Proximal steps from forces of zero add what the rows span, and nothing else.
  Judgement solve_least(ContactSolution& solution);
  /// Forces over scales, by row, near those of the rows. They leave as little motion as doubles allow. Targets must be
  /// 0.
  vector<double> correct_hold();

 private:
  class Method;
  unique_ptr<Method> method_;
};

}  // namespace carom
