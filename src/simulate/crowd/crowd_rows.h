#pragma once
// The pairs that may press in a crowd, as plain data for vectors: four rows side by side that share no body.
//
// Groups of rows follow one another in colours. Rows of one colour share no body, so that their order has no effect.
// What every sweep reads lies apart from what is read once in a step.

#include "numerics/vec3.h"
#include "physics/entity.h"
#include "std.h"

namespace carom {

/// Four numbers by body: a position (m) and the radius (m), or a velocity (m/s) and the inverse mass (1/kg).
struct alignas(32) Four {
  double at[4] = {0, 0, 0, 0};
};

inline Vec3 vector_of(const Four& four) {
  return {four.at[0], four.at[1], four.at[2]};
}
inline Four four_of(const Vec3& v, double last) {
  return {{v.x(), v.y(), v.z(), last}};
}
inline void add(Four& four, const Vec3& change) {
  for (int k = 0; k < 3; ++k) four.at[k] += change[k];
}
/// The greatest length of these vectors.
inline double greatest(const vector<Four>& all) {
  double squared = 0;
  for (const Four& each : all) squared = max(squared, vector_of(each).squaredNorm());
  return sqrt(squared);
}

/// Four rows, as a sweep reads them. Unit normals point from a to b. `base` + h u is what may not become negative, with
/// the speed u of separation and the step h. Lanes without a row have a share of 0.
struct alignas(32) RowGroup {
  double nx[4];
  double ny[4];
  double nz[4];
  double base[4];     // m
  double share[4];    // kg: 1 / (1 / m_a + 1 / m_b)
  double impulse[4];  // N s
  uint32_t a[4];
  uint32_t b[4];
};

/// The same four: for the test of convergence, and for conjugate directions.
struct alignas(32) RowChange {
  double inverse[4];    // 1/kg: 1 / m_a + 1 / m_b
  double slack[4];      // m, that a row may be short by
  double direction[4];  // N s
  double change[4];     // N s, of the last sweep
};

/// The same four: what is read once in a step.
struct alignas(32) RowState {
  double gap[4];      // m
  double force[4];    // N, of the last step
  double carried[4];  // N s: what velocities at the step's start have of it in advance
  double slow[4];     // m/s: a faster approach is an impact
  double shell[4];    // m: the gap that the row keeps
  double e[4];        // restitution
};

/// A pair by name. a: a member. e: a later member, or a thing that does not move by forces.
struct RowName {
  Entity a = no_entity;
  Entity e = no_entity;
};

/// Where a pair's row is.
struct RowPlace {
  size_t group;
  size_t lane;
};

/// of(begin) + ... + of(end - 1), the same where the order is the opposite one.
template <typename Of>
double sum_in_pairs(size_t begin, size_t end, const Of& of) {
  double sum = 0;
  for (; begin + 1 < end; ++begin, --end) sum += of(begin) + of(end - 1);
  return begin < end ? sum + of(begin) : sum;
}

/// Rows that one thread takes: groups from `begin` on, those of pairs of balls first.
struct RowPart {
  size_t begin = 0;
  size_t balls = 0;  // the end of those
  size_t end = 0;
};

/// Parts are those of slabs of space. Then those of pairs that lie in two slabs: between slabs 0 and 1, 2 and 3, ...,
/// then between 1 and 2, 3 and 4, ... The last has all other rows. With one slab there is one part.
class CrowdRows {
 public:
  static constexpr size_t lanes = 4;
  static constexpr double new_pair = -1;  // m, the shell of a pair that is not yet measured

  /// A listed pair, by the numbers of bodies in the crowd. Things that forces do not move have numbers from `movable`
  /// on, in each part their own.
  struct Pair {
    uint32_t a;
    uint32_t b;
    RowName name;
    bool balls;      // both are balls
    double inverse;  // 1/kg
    double e;
    double slow;        // m/s
    double shell;       // m
    double force;       // N
    bool near = false;  // it may close its gap soon
  };

  void clear();
  /// Adds a part with these pairs, in this order but for colours. `movable`: the number of bodies. `dummy`: the number
  /// of a thing for lanes without a row.
  void add_part(span<const Pair> pairs, uint32_t movable, uint32_t dummy);

  size_t groups() const { return hot.size(); }
  /// Calls what(group, lane) for each row of a part, or for each row, in order.
  template <typename What>
  void for_each(const RowPart& part, const What& what) const {
    for (size_t g = part.begin; g < part.end; ++g)
      for (size_t lane = 0; lane < lanes; ++lane)
        if (hot[g].share[lane] > 0) what(g, lane);
  }
  template <typename What>
  void for_each(const What& what) const {
    for_each({0, 0, hot.size()}, what);
  }

  Vec3 normal(size_t group, size_t lane) const {
    return {hot[group].nx[lane], hot[group].ny[lane], hot[group].nz[lane]};
  }

  size_t slabs() const { return parts.size() == 1 ? 1 : parts.size() / 2; }
  /// Parts of one phase share no body that moves: they are those from one of these numbers on up to the next.
  array<size_t, 5> phases() const {
    const size_t n = slabs();
    if (n == 1) return {0, 1, 1, 1, 1};
    return {0, n, n + n / 2, 2 * n - 1, 2 * n};
  }
  /// The sum over parts. Mirror images of a crowd have the parts of each phase in the opposite order, and the same sum.
  template <typename Of>
  double sum(const Of& of) const {
    const array<size_t, 5> phase = phases();
    double sum = 0;
    for (int k = 0; k < 4; ++k) sum += sum_in_pairs(phase[k], phase[k + 1], of);
    return sum;
  }

  void keep(auto& archive) { archive(hot, change, state, names, parts, place, first); }

  vector<RowGroup> hot;
  vector<RowChange> change;
  vector<RowState> state;
  vector<array<RowName, lanes>> names;
  vector<RowPart> parts;
  vector<uint32_t> place;  // by member: 2 s in slab s, 2 s + 1 on the cut behind it
  vector<uint32_t> first;  // by slab: the first number of its members, and behind the last slab their count

 private:
  vector<uint64_t> used_;  // scratch: by body, a bit for each colour
};

}  // namespace carom
