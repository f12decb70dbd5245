#pragma once
// The pairs that may press in a crowd, as plain data for vectors: four rows side by side that share no body.
//
// Groups of rows follow one another in colours. Rows of one colour share no body, so that their order has no effect.
// What every sweep reads lies apart from what is read once in a step.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "numerics/vec3.h"
#include "physics/entity.h"

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
inline double greatest(const std::vector<Four>& all) {
  double squared = 0;
  for (const Four& each : all) squared = std::max(squared, vector_of(each).squaredNorm());
  return std::sqrt(squared);
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
  std::uint32_t a[4];
  std::uint32_t b[4];
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

/// A pair by name. a: a member. e: a member of a higher number, or a thing that does not move by forces.
struct RowName {
  Entity a = no_entity;
  Entity e = no_entity;
};

class CrowdRows {
 public:
  static constexpr std::size_t lanes = 4;
  static constexpr double new_pair = -1;  // m, the shell of a pair that is not yet measured

  /// A listed pair, by the numbers of bodies in the crowd. Things that forces do not move have numbers from `movable`
  /// on.
  struct Pair {
    std::uint32_t a;
    std::uint32_t b;
    RowName name;
    bool balls;      // both are balls
    double inverse;  // 1/kg
    double e;
    double slow;        // m/s
    double shell;       // m
    double force;       // N
    bool near = false;  // it may close its gap soon
  };

  /// Lists these pairs, in this order but for colours. `movable`: the number of bodies. `dummy`: the number of a thing
  /// for lanes without a row.
  void list(std::span<const Pair> pairs, std::uint32_t movable, std::uint32_t dummy);

  std::size_t groups() const { return hot.size(); }
  std::size_t rows() const { return rows_; }
  bool empty() const { return rows_ == 0; }
  /// Calls what(group, lane) for each row, in order.
  template <typename What>
  void for_each(const What& what) const {
    for (std::size_t g = 0; g < hot.size(); ++g)
      for (std::size_t lane = 0; lane < lanes; ++lane)
        if (hot[g].share[lane] > 0) what(g, lane);
  }

  Vec3 normal(std::size_t group, std::size_t lane) const {
    return {hot[group].nx[lane], hot[group].ny[lane], hot[group].nz[lane]};
  }

  std::vector<RowGroup> hot;
  std::vector<RowChange> change;
  std::vector<RowState> state;
  std::vector<std::array<RowName, lanes>> names;
  std::size_t ball_groups = 0;  // the first of all: groups of pairs of balls

 private:
  std::size_t rows_ = 0;
};

}  // namespace carom
