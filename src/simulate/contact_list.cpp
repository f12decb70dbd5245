// Drops contacts that another contact of the same body makes impossible: a thing wholly behind a flat surface that the
// body touches. Level surfaces stay, so that a floor of several pieces carries a body over its seams.
#include "simulate/contact_list.h"

#include <algorithm>

#include "physics/world.h"
#include "simulate/exact_bodies.h"
#include "simulate/tolerances.h"

namespace carom {

void ContactList::clear() {
  pairs.clear();
  names.clear();
  gaps.clear();
}

void ContactList::add(const ContactConstraint& pair, const Contact& name, double gap) {
  pairs.push_back(pair);
  names.push_back(name);
  gaps.push_back(gap);
}

void ContactList::check_room(const ExactBodies& bodies, const std::vector<Vec3>& velocities) const {
  if (!bodies.moving.any() || pairs.empty()) return;
  std::size_t worst = 0;
  for (std::size_t c = 1; c < pairs.size(); ++c)
    if (approach(velocities, pairs[c]) > approach(velocities, pairs[worst])) worst = c;
  // The thing on the other side of the body.
  const auto& [body, thing, of_worst] = names[worst];
  Entity other = no_entity;
  double most = 0;
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    const auto& [i, e, feature] = names[c];
    if (c == worst || (i != body && e != body)) continue;
    const double opposite = (i == body ? -1 : 1) * pairs[worst].normal.dot(pairs[c].normal);
    if (!(opposite > most)) continue;
    most = opposite;
    other = i == body ? e : i;
  }
  if (other != no_entity) bodies.fail_squeezed(body, thing, other);
}

void ContactList::drop_hidden(const ExactBodies& bodies, const Vec3& x, std::size_t first, double beside) {
  const World& world = bodies.world;
  const auto fixed = [&](std::size_t c) { return world.is_fixed(names[c].e); };
  const auto flat = [&](std::size_t c) { return fixed(c) && is_flat(world, names[c].i, names[c].e, names[c].feature); };
  const auto hides = [&](std::size_t floor, std::size_t c) {
    const Vec3& n = pairs[floor].normal;
    if (floor == c || gaps[floor] > beside || !flat(floor) ||
        (flat(c) && (pairs[c].normal - n).norm() <= exact_tolerance::level))
      return false;
    return bodies.hidden(names[c].i, x, names[c].e, -n, bodies.fixed_velocity(names[floor].e));
  };
  std::vector<std::size_t> hidden;
  for (std::size_t c = first; c < pairs.size(); ++c)
    for (std::size_t floor = first; floor < pairs.size() && fixed(c); ++floor)
      if (hides(floor, c)) {
        hidden.push_back(c);
        break;
      }
  if (!hidden.empty())
    drop_if(first, [&](std::size_t c) { return std::binary_search(hidden.begin(), hidden.end(), c); });
}

}  // namespace carom
