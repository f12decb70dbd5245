#pragma once
// The problem of contact_problem.h where an answer to within the contacts' slack will do: conjugate gradients on the
// contacts that press, which are found on the way (MPRGP: Dostal & Schoeberl, Comput. Optim. Appl. 30 (2005) 23).
#include "physics/contact_problem.h"

namespace carom {

/// Moves the motion until no contact falls short of its target by more than its slack; bilateral ones are not known
/// here. At most `iterations`; whether that was enough.
bool project_gradients(const ContactProblem& problem, int iterations);

}  // namespace carom
