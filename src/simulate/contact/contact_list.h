#pragma once
// Contacts of an island: the things that touch, beside the solver's constraints for them.

#include "geometry/touch.h"
#include "numerics/disjoint_sets.h"
#include "solver/contact_problem.h"
#include "std.h"

namespace carom {

struct ExactBodies;

/// Two things in contact.
struct Contact {
  Entity i;         // a body; in steps i < e
  Entity e;         // A string between two bodies is the e of one of them.
  uint8_t feature;  // as in Touch

  void keep(auto& archive) { archive(i, e, feature); }
};

/// By body: the first one of its set.
inline vector<uint32_t> first_of_each(DisjointSets& sets, size_t bodies) {
  vector<uint32_t> part(bodies);
  vector<uint32_t> first(bodies, ContactConstraint::fixed);
  for (uint32_t k = 0; k < bodies; ++k) {
    uint32_t& of_part = first[sets.root(k)];
    of_part = min(of_part, k);
    part[k] = of_part;
  }
  return part;
}

/// By body: the first of the bodies that pairs connect with it.
inline vector<uint32_t> connected_parts(size_t bodies, span<const ContactConstraint> pairs) {
  DisjointSets sets(bodies);
  for (const ContactConstraint& pair : pairs)
    if (pair.b != ContactConstraint::fixed) sets.join(pair.a, pair.b);
  return first_of_each(sets, bodies);
}

struct ContactList {
  vector<ContactConstraint> pairs;
  vector<Contact> names;  // of the pairs
  vector<double> gaps;    // m, of the pairs, at present
  // m/s, of the pairs: a faster approach is an impact of its own.
  vector<double> slow;

  void clear();
  void add(const ContactConstraint& pair, const Contact& name, double gap);
  /// Drops contacts of a body at x (m), from number `first` on, with things that lie wholly behind a flat fixed surface
  /// beside it. Surfaces level with it stay.
  void drop_hidden(const ExactBodies& bodies, const Vec3& x, size_t first);
  /// Throws SimulationError if things that move leave a body no room: the one with the fastest approach at these
  /// velocities (m/s), which contacts could not prevent.
  void check_room(const ExactBodies& bodies, const vector<Vec3>& velocities) const;
  /// Drops the contacts from number `first` on for which drops(number) is true.
  template <typename Drops>
  void drop_if(size_t first, Drops drops) {
    size_t kept = first;
    for (size_t c = first; c < pairs.size(); ++c) {
      if (drops(c)) continue;
      pairs[kept] = pairs[c];
      names[kept] = names[c];
      slow[kept] = slow[c];
      gaps[kept++] = gaps[c];
    }

    pairs.resize(kept);
    names.resize(kept);
    gaps.resize(kept);
    slow.resize(kept);
  }
};

}  // namespace carom
