#pragma once
// Of the forces that a motion leaves open, those of equally stiff contacts. A slab on four legs has three equations for
// four forces. The elastic energy of contacts of equal stiffness is least where the sum of the squares of their forces
// is (Castigliano). That sum has one minimum, whatever the order of contacts.
#include "solver/contact_island.h"

namespace carom {

/// Replaces the forces of an exact solution by the least ones with the same motion. Rows count that press, or are
/// closed to rounding. The forces stay as they are where the least ones are not found to rounding. `independent`: no
/// row with a force depends on the others. Returns whether forces have changed.
bool take_least_forces(const ContactIsland& island, ContactSolution& solution, bool independent);

/// Corrects forces that nearly hold all bodies of a problem at rest, whose contacts have targets of 0. In doubles:
/// `motion` becomes what they leave of it.
void correct_hold(const ContactProblem& problem);

}  // namespace carom
