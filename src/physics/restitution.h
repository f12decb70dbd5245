#pragma once
// The coefficient of restitution of a pair (chapter 8: a body has its own; the pair's is made of both).
#include "physics/entity.h"
#include "physics/world.h"

namespace carom {

struct World;

/// e of two coefficients; masses (kg) matter to mass_weighted only. `book` is e1 e2 / 2, listing 8.4 as printed.
double combine_restitution(Combine rule, double e1, double m1, double e2, double m2);

/// e between body a and body or fixed surface b: the pair's own value if one is given, else by the world's rule.
/// A surface that names none takes the body's own: combined by the rule like any other, so that `average` gives the
/// body's coefficient. In mass_weighted a surface weighs without limit: its own coefficient is the pair's.
double pair_restitution(const World& world, Entity a, Entity b);

}  // namespace carom
