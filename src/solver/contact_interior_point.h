#pragma once
// Contact among many bodies by a primal-dual interior point (Mehrotra, SIAM J. Optim. 2 (1992) 575), handed over to a
// proximal Newton method, which finds which rows press, and refined with residuals in twice as many digits. Every
// system is (1 + J^T D J) dy = r on the bodies, sparse and never singular, however many contacts depend on one another.
#include <memory>

#include "solver/contact_island.h"

namespace carom {

class ContactInteriorPoint {
 public:
  explicit ContactInteriorPoint(const ContactIsland& island);
  ~ContactInteriorPoint();

  /// What one factorisation takes: multiplications and additions, about.
  double operations() const;

  Judgement solve(ContactAnswer& answer);

 private:
  class Method;
  std::unique_ptr<Method> method_;
};

}  // namespace carom
