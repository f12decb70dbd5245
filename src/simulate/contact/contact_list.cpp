// Drops contacts that another contact of the same body makes impossible: a thing wholly behind a flat surface that the
// body touches. Level surfaces stay, so that a floor of several pieces carries a body over its seams.
#include "simulate/contact/contact_list.h"

#include "numerics/vanishing_sum.h"
#include "physics/world.h"
#include "simulate/contact/exact_bodies.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

void ContactList::clear() {
  pairs.clear();
  names.clear();
  gaps.clear();
  slow.clear();
}

void ContactList::add(const ContactConstraint& pair, const Contact& name, double gap) {
  pairs.push_back(pair);
  names.push_back(name);
  gaps.push_back(gap);
  slow.push_back(never);
}

void ContactList::check_room(const ExactBodies& bodies, const vector<Vec3>& velocities) const {
  if (!bodies.moving.any() || pairs.empty()) return;
  const World& world = bodies.world;

  // m/s. A rod must not get longer either.
  const auto excess = [&](size_t c) {
    const double speed = approach(velocities, pairs[c]);
    return pairs[c].bilateral ? std::abs(speed) : speed;
  };
  size_t worst = 0;
  for (size_t c = 1; c < pairs.size(); ++c)
    if (excess(c) > excess(worst)) worst = c;

  // The things around the body, and the directions to them. A rod holds it from both sides.
  const auto& [body, thing, of_worst] = names[worst];
  vector<Entity> around = {thing};
  vector<Vec3> directions = {approach(velocities, pairs[worst]) < 0 ? Vec3(-pairs[worst].normal) : pairs[worst].normal};

  // Its other contacts, of which it may be the first body or the second.
  for (size_t c = 0; c < pairs.size(); ++c) {
    const auto& [i, e, feature] = names[c];
    if (c == worst || (i != body && world.second_body(e) != body)) continue;
    around.push_back(i == body || world.is_string(e) ? e : i);
    directions.emplace_back(i == body ? pairs[c].normal : Vec3(-pairs[c].normal));

    if (!pairs[c].bilateral) continue;
    around.push_back(around.back());
    directions.emplace_back(-directions.back());
  }

  // The fewest of them that hold it all around.
  vector<Entity> things;
  for (const size_t k : vanishing_sum(directions, 0, exact_tolerance::level)) things.push_back(around[k]);
  if (!things.empty()) bodies.fail_squeezed(body, std::move(things));

  // They do not hold the body all around: the thing on its other side.
  size_t other = 0;
  for (size_t k = 1; k < around.size(); ++k)
    if (directions[k].dot(directions[0]) < min(0.0, directions[other].dot(directions[0]))) other = k;
  if (other > 0) bodies.fail_squeezed(body, {thing, around[other]});
}

void ContactList::drop_hidden(const ExactBodies& bodies, const Vec3& x, size_t first) {
  const World& world = bodies.world;
  const auto fixed = [&](size_t c) { return world.is_fixed(names[c].e); };
  const auto flat = [&](size_t c) { return fixed(c) && is_flat(world, names[c].i, names[c].e, names[c].feature); };

  // Whether contact number `floor` is with a flat surface that hides the thing of contact c.
  const auto hides = [&](size_t floor, size_t c) {
    const Vec3& n = pairs[floor].normal;
    if (floor == c || !flat(floor) || (flat(c) && (pairs[c].normal - n).norm() <= exact_tolerance::level)) return false;
    return bodies.hidden(names[c].i, x, names[c].e, -n, names[floor].e);
  };

  vector<size_t> hidden;
  for (size_t c = first; c < pairs.size(); ++c)
    for (size_t floor = first; floor < pairs.size() && fixed(c); ++floor)
      if (hides(floor, c)) {
        hidden.push_back(c);
        break;
      }

  if (!hidden.empty()) drop_if(first, [&](size_t c) { return std::binary_search(hidden.begin(), hidden.end(), c); });
}

}  // namespace carom
