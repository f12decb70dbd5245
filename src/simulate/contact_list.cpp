// Drops contacts that another contact of the same body makes impossible: a thing wholly behind a flat surface that the
// body touches. Level surfaces stay, so that a floor of several pieces carries a body over its seams.
#include "simulate/contact_list.h"

#include <algorithm>

#include "physics/world.h"
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

void ContactList::drop_hidden(const World& world, const Vec3& x, std::size_t first, double beside) {
  const auto fixed = [&](std::size_t c) { return !world.is_body(names[c].e); };
  const auto flat = [&](std::size_t c) { return fixed(c) && is_flat(world, names[c].i, names[c].e, names[c].feature); };
  const auto hides = [&](std::size_t floor, std::size_t c) {
    const Vec3& n = pairs[floor].normal;
    if (floor == c || gaps[floor] > beside || !flat(floor) ||
        (flat(c) && (pairs[c].normal - n).norm() <= exact_tolerance::level))
      return false;
    return lies_behind(world, names[c].i, x, names[c].e, -n);
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
