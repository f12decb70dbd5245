#pragma once
// The coefficient of restitution of a pair. In chapter 8 each body has its own, and both together make the pair's.
#include "physics/entity.h"
#include "physics/world.h"

namespace carom {

/// e from two coefficients. Masses (kg) matter to mass_weighted only. `book` is e1 e2 / 2, listing 8.4 as printed.
double combine_restitution(Combine rule, double e1, double m1, double e2, double m2);

/// Whether body a and b, a body or a fixed thing, may meet. Otherwise they pass through each other.
bool may_meet(const World& world, Entity a, Entity b);
/// Whether there are pairs that pass through each other.
bool some_pass(const World& world);

/// e between body a and b, a body or a fixed surface. The pair's own value takes precedence over the world's rule. A
/// surface without a coefficient takes the body's. The rule then combines the two, so that `average` gives the body's
/// coefficient. A string has its own. In mass_weighted a surface has unlimited weight, so that its own coefficient is
/// the pair's.
double pair_restitution(const World& world, Entity a, Entity b);

/// Whether some pair may have e = 0, because something has.
bool may_be_plastic(const World& world);

}  // namespace carom
