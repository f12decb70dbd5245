#include "physics/sweeps.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace carom {

namespace {

// What a pair needs, side by side: a sweep is bound by how fast it comes from memory.
struct Row {
  Vec3 normal;
  double per_rate;     // kg: the force that makes a difference of 1 in the rate
  double of_a, of_b;   // 1/kg
  double target;       // as PressedPair's,
  double slack;        // kg times the unit of u: what a force may change by yet
  double force;        //
  std::uint32_t a, b;  // b of something fixed: one more body, which nothing moves
};

}  // namespace

bool sweep_apart(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<PressedPair> pairs, int sweeps) {
  const auto nobody = static_cast<std::uint32_t>(u.size());
  std::vector<Vec3> v(u.begin(), u.end());
  v.push_back(Vec3::Zero());
  std::vector<Row> rows;
  rows.reserve(pairs.size());
  for (const PressedPair& p : pairs) {
    const bool fixed = p.b == PressedPair::none;
    const double of_a = inverse_mass[p.a], of_b = fixed ? 0 : inverse_mass[p.b], per_rate = 1 / (of_a + of_b);
    rows.push_back({p.normal, per_rate, of_a, of_b, p.target, p.slack * per_rate, std::max(p.force, 0.0), p.a,
                    fixed ? nobody : p.b});
    const Row& row = rows.back();
    v[row.a] -= (of_a * row.force) * row.normal;
    v[row.b] += (of_b * row.force) * row.normal;
  }
  bool done = false;
  const auto visit = [&](Row& row) {
    const double rate = row.normal.dot(v[row.b] - v[row.a]);
    const double force = std::max(row.force - (rate - row.target) * row.per_rate, 0.0), change = force - row.force;
    if (change == 0) return;
    done = done && std::abs(change) <= row.slack;
    row.force = force;
    v[row.a] -= (row.of_a * change) * row.normal;
    v[row.b] += (row.of_b * change) * row.normal;
  };
  for (int k = 0; k < sweeps && !done; ++k) {
    done = true;
    if (k % 2 == 0)
      std::for_each(rows.begin(), rows.end(), visit);
    else
      std::for_each(rows.rbegin(), rows.rend(), visit);
  }
  std::copy(v.begin(), v.end() - 1, u.begin());
  for (std::size_t c = 0; c < rows.size(); ++c) pairs[c].force = rows[c].force;
  return done;
}

}  // namespace carom
