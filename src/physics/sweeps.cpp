#include "physics/sweeps.h"

#include <algorithm>
#include <bit>
#include <cmath>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define __SANITIZE_ADDRESS__  // as gcc says it
#endif
#endif

// Of the same arithmetic in vectors of 2 or of 4 the processor at hand takes what it has. (The choice comes before a
// sanitizer is ready.)
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
#define CAROM_FOR_ALL_PROCESSORS __attribute__((target_clones("avx2", "default")))
#else
#define CAROM_FOR_ALL_PROCESSORS
#endif

namespace carom {

namespace {

constexpr std::size_t open_batches = 64;  // the bits of a mask

}  // namespace

/// Each pair goes into the oldest open batch that has room and neither of its bodies. So batches follow the pairs'
/// order nearly, and what one sweep carries on along it is not lost.
void Sweeps::arrange(std::span<const double> inverse_mass, std::span<const ContactConstraint> pairs) {
  const auto immovable = static_cast<std::uint32_t>(inverse_mass.size());
  batches_.clear();
  filled_.clear();
  place_.clear();
  in_.assign(inverse_mass.size() + 1, 0);
  std::uint64_t open = 0;
  std::size_t oldest = 0;  // of the open ones: batch k has bit k mod 64
  const auto close = [&](std::size_t batch) {
    const std::uint64_t bit = std::uint64_t{1} << batch % open_batches;
    open &= ~bit;
    for (std::size_t lane = 0; lane < width; ++lane) {
      in_[batches_[batch].a[lane]] &= ~bit;
      in_[batches_[batch].b[lane]] &= ~bit;
    }
  };
  for (const ContactConstraint& p : pairs) {
    const bool fixed = p.b == ContactConstraint::fixed;
    const std::uint64_t free = open & ~in_[p.a] & (fixed ? ~std::uint64_t{0} : ~in_[p.b]);
    std::size_t batch;
    if (free != 0) {
      const auto turned = std::rotr(free, static_cast<int>(oldest % open_batches));
      batch = oldest + static_cast<std::size_t>(std::countr_zero(turned));
    } else {
      batch = batches_.size();
      if (batch - oldest == open_batches) close(oldest++);
      Batch empty{};
      std::fill(std::begin(empty.a), std::end(empty.a), immovable);
      std::fill(std::begin(empty.b), std::end(empty.b), immovable);
      batches_.push_back(empty);
      filled_.push_back(0);
      open |= std::uint64_t{1} << batch % open_batches;
    }
    const std::uint64_t bit = std::uint64_t{1} << batch % open_batches;
    const std::size_t lane = filled_[batch]++;
    if (filled_[batch] == width) open &= ~bit;  // its bodies' bits stay until it is the oldest
    Batch& row = batches_[batch];
    const double of_a = inverse_mass[p.a], of_b = fixed ? 0 : inverse_mass[p.b], per_rate = 1 / (of_a + of_b);
    for (int axis = 0; axis < 3; ++axis) row.normal[axis][lane] = p.normal[axis];
    row.per_rate[lane] = per_rate;
    row.of_all[lane] = of_a + of_b;
    row.of_a[lane] = of_a;
    row.of_b[lane] = of_b;
    row.target[lane] = p.target;
    row.slack[lane] = p.slack * per_rate;
    row.a[lane] = p.a;
    row.b[lane] = fixed ? immovable : p.b;
    in_[p.a] |= bit;
    if (!fixed) in_[p.b] |= bit;
    place_.push_back(static_cast<std::uint32_t>(width * batch + lane));
  }
}

/// Sets out from u and the forces that are given, or from none.
void Sweeps::start(std::span<const Vec3> u, std::span<const ContactConstraint> pairs, bool guess) {
  for (std::size_t k = 0; k < u.size(); ++k) motions_[k].u = Four{u[k].x(), u[k].y(), u[k].z(), 0};
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    Batch& row = batches_[place_[c] / width];
    const std::size_t lane = place_[c] % width;
    const double force = guess ? std::max(pairs[c].force, 0.0) : 0;
    row.force[lane] = force;
    if (force == 0) continue;
    const Vec3 push = force * pairs[c].normal;
    const Four along{push.x(), push.y(), push.z(), 0};
    motions_[row.a[lane]].u -= row.of_a[lane] * along;
    motions_[row.b[lane]].u += row.of_b[lane] * along;
  }
}

/// With x the forces, c the rates at which pairs part without them, less their targets, and A x what forces change of
/// rates: c x + x A x / 2. Without targets, what the forces have done to kinetic energy.
double Sweeps::potential(std::span<const Vec3> u, std::span<const ContactConstraint> pairs) const {
  double sum = 0;
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    const ContactConstraint& p = pairs[c];
    const Batch& row = batches_[place_[c] / width];
    const std::size_t lane = place_[c] % width;
    if (row.force[lane] == 0) continue;
    const Vec3 before = p.b == ContactConstraint::fixed ? Vec3(-u[p.a]) : Vec3(u[p.b] - u[p.a]);
    const Four now = motions_[row.b[lane]].u - motions_[row.a[lane]].u;
    sum += row.force[lane] * (0.5 * p.normal.dot(before + Vec3(now[0], now[1], now[2])) - p.target);
  }
  return sum;
}

/// What forces that change by so much do to the motions of a batch.
inline __attribute__((always_inline)) void Sweeps::push(const Batch& row, const Four& change, Motion* motions) {
  const Four zero{};
  const Four px = change * row.normal[0], py = change * row.normal[1], pz = change * row.normal[2];
  // By pair, from by axis.
  const Four xy_even = __builtin_shufflevector(px, py, 0, 4, 2, 6);
  const Four xy_odd = __builtin_shufflevector(px, py, 1, 5, 3, 7);
  const Four z_even = __builtin_shufflevector(pz, zero, 0, 4, 2, 6);
  const Four z_odd = __builtin_shufflevector(pz, zero, 1, 5, 3, 7);
  const Four p0 = __builtin_shufflevector(xy_even, z_even, 0, 1, 4, 5);
  const Four p1 = __builtin_shufflevector(xy_odd, z_odd, 0, 1, 4, 5);
  const Four p2 = __builtin_shufflevector(xy_even, z_even, 2, 3, 6, 7);
  const Four p3 = __builtin_shufflevector(xy_odd, z_odd, 2, 3, 6, 7);
  motions[row.a[0]].u -= row.of_a[0] * p0;
  motions[row.a[1]].u -= row.of_a[1] * p1;
  motions[row.a[2]].u -= row.of_a[2] * p2;
  motions[row.a[3]].u -= row.of_a[3] * p3;
  motions[row.b[0]].u += row.of_b[0] * p0;
  motions[row.b[1]].u += row.of_b[1] * p1;
  motions[row.b[2]].u += row.of_b[2] * p2;
  motions[row.b[3]].u += row.of_b[3] * p3;
}

/// Once through all batches. The most by which a force has changed beyond its slack.
CAROM_FOR_ALL_PROCESSORS
double Sweeps::sweep(Batch* batches, std::size_t count, Motion* motions, bool back) {
  const Four zero{};
  Four worst = zero - 1;
  for (std::size_t k = 0; k < count; ++k) {
    Batch& row = batches[back ? count - 1 - k : k];
    const Four w0 = motions[row.b[0]].u - motions[row.a[0]].u, w1 = motions[row.b[1]].u - motions[row.a[1]].u;
    const Four w2 = motions[row.b[2]].u - motions[row.a[2]].u, w3 = motions[row.b[3]].u - motions[row.a[3]].u;
    // By axis, from by pair.
    const Four low01 = __builtin_shufflevector(w0, w1, 0, 4, 2, 6);
    const Four low23 = __builtin_shufflevector(w2, w3, 0, 4, 2, 6);
    const Four high01 = __builtin_shufflevector(w0, w1, 1, 5, 3, 7);
    const Four high23 = __builtin_shufflevector(w2, w3, 1, 5, 3, 7);
    const Four x = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
    const Four y = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
    const Four z = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
    const Four rate = row.normal[0] * x + row.normal[1] * y + row.normal[2] * z;
    const Four wanted = row.force - (rate - row.target) * row.per_rate;
    const Four force = wanted > zero ? wanted : zero, change = force - row.force;
    row.force = force;
    const Four size = change < zero ? -change : change, excess = size - row.slack;
    worst = excess > worst ? excess : worst;
    push(row, change, motions);
  }
  return std::max(std::max(worst[0], worst[1]), std::max(worst[2], worst[3]));
}

/// What a sweep has changed, squared, in the measure of the problem's diagonal.
CAROM_FOR_ALL_PROCESSORS
double Sweeps::measure(const Batch* batches, std::size_t count, const Trend* trends) {
  Four sum{};
  for (std::size_t k = 0; k < count; ++k) {
    const Four change = batches[k].force - trends[k].before;
    sum += change * change * batches[k].of_all;
  }
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/// Goes on along the last direction, times `turn`, and makes what the sweep has changed part of it.
CAROM_FOR_ALL_PROCESSORS
void Sweeps::go_on(Batch* batches, std::size_t count, Trend* trends, Motion* motions, double turn) {
  for (std::size_t k = 0; k < count; ++k) {
    Batch& row = batches[k];
    Trend& trend = trends[k];
    const Four change = row.force - trend.before, more = turn * trend.along;
    row.force += more;
    trend.before = row.force;
    trend.along = more + change;
    if (turn > 0) push(row, more, motions);
  }
}

bool Sweeps::solve(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<ContactConstraint> pairs,
                   int sweeps) {
  arrange(inverse_mass, pairs);
  motions_.assign(u.size() + 1, Motion{});
  trends_.assign(batches_.size(), Trend{});
  const std::size_t count = batches_.size();
  const auto run = [&](bool guess) {
    start(u, pairs, guess);
    for (std::size_t k = 0; k < count; ++k) trends_[k] = {batches_[k].force, Four{}};
    bool done = pairs.empty(), settled = false;  // nothing to do in two sweeps, in the last one
    double last = 0;
    for (int k = 0; k < sweeps && !done; ++k) {
      const bool quiet = sweep(batches_.data(), count, motions_.data(), k % 2 != 0) <= 0;
      done = quiet && settled;
      settled = quiet;
      if (settled || k + 1 == sweeps) continue;
      const double now = measure(batches_.data(), count, trends_.data());
      go_on(batches_.data(), count, trends_.data(), motions_.data(), now < last ? now / last : 0);
      last = now;
    }
    return done;
  };
  bool done = run(true);
  if (!done && potential(u, pairs) > 0) done = run(false);  // sweeps only lower it, and no forces have none
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = Vec3(motions_[k].u[0], motions_[k].u[1], motions_[k].u[2]);
  for (std::size_t c = 0; c < pairs.size(); ++c) pairs[c].force = batches_[place_[c] / width].force[place_[c] % width];
  return done;
}

}  // namespace carom
