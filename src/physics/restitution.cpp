// Rules that make a pair's coefficient of restitution from two. The chapter's text has the average, its listing 8.4
// prints e1 e2 / 2. A pair's own value takes precedence, and the last match in the scene counts.
#include "physics/restitution.h"

#include "physics/world.h"
#include "std.h"

namespace carom {

double combine_restitution(Combine rule, double e1, double m1, double e2, double m2) {
  switch (rule) {
    case Combine::average:
      return (e1 + e2) / 2;
    case Combine::minimum:
      return min(e1, e2);
    case Combine::maximum:
      return max(e1, e2);

    case Combine::product:
      return e1 * e2;
    case Combine::geometric_mean:
      return sqrt(e1 * e2);

    case Combine::mass_weighted:
      return (m1 * e1 + m2 * e2) / (m1 + m2);
    case Combine::book:
      return e1 * e2 / 2;
  }
  return 0;
}

bool may_be_plastic(const World& world) {
  const auto plastic = [](const auto& thing) { return thing.restitution == 0; };
  return contains(world.restitution, 0) || any_of(world.planes, plastic) || any_of(world.walls, plastic) ||
         any_of(world.obstacles, plastic) ||
         any_of(world.pairs, [](const PairRestitution& pair) { return pair.value == 0; });
}

namespace {

/// The last pair of the scene that has both; null: there is none.
const PairRestitution* pair_of(const World& world, Entity a, Entity b) {
  const auto within = [](Entity e, Entity first, Entity count) { return e >= first && e - first < count; };
  for (auto pair = world.pairs.rbegin(); pair != world.pairs.rend(); ++pair) {
    if ((within(a, pair->a_first, pair->a_count) && within(b, pair->b_first, pair->b_count)) ||
        (within(b, pair->a_first, pair->a_count) && within(a, pair->b_first, pair->b_count)))
      return &*pair;
  }
  return nullptr;
}

}  // namespace

bool may_meet(const World& world, Entity a, Entity b) {
  const PairRestitution* const pair = pair_of(world, a, b);
  return pair == nullptr || pair->value;
}

bool some_pass(const World& world) {
  return any_of(world.pairs, [](const PairRestitution& pair) { return !pair.value; });
}

double pair_restitution(const World& world, Entity a, Entity b) {
  if (const PairRestitution* const pair = pair_of(world, a, b); pair != nullptr && pair->value) return *pair->value;

  const double ea = world.restitution[a];
  const double ma = world.mass[a];
  if (world.is_body(b)) return combine_restitution(world.combine, ea, ma, world.restitution[b], world.mass[b]);

  const bool plane = world.is_plane(b), wall = !plane && world.is_wall(b);
  if (!plane && !wall && world.is_string(b)) return world.string(b).restitution;
  const optional<double>& own = plane  ? world.plane(b).restitution
                                : wall ? world.wall(b).restitution
                                       : world.obstacle(b).restitution;
  const double eb = own.value_or(ea);
  if (world.combine == Combine::mass_weighted)
    return eb;  // the limit of (m1 e1 + m2 e2)/(m1 + m2) for m2 without bound
  return combine_restitution(world.combine, ea, ma, eb, ma);
}

}  // namespace carom
