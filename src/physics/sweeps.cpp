#include "physics/sweeps.h"

#include <algorithm>
#include <bit>
#include <cmath>

// Of the same arithmetic in vectors of 2 or of 4 the processor at hand takes what it has.
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
void Sweeps::arrange(std::span<const double> inverse_mass, std::span<const PressedPair> pairs) {
  const auto nobody = static_cast<std::uint32_t>(inverse_mass.size());
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
  for (const PressedPair& p : pairs) {
    const bool fixed = p.b == PressedPair::none;
    const std::uint64_t free = open & ~in_[p.a] & (fixed ? ~std::uint64_t{0} : ~in_[p.b]);
    std::size_t batch;
    if (free != 0) {
      const auto turned = std::rotr(free, static_cast<int>(oldest % open_batches));
      batch = oldest + static_cast<std::size_t>(std::countr_zero(turned));
    } else {
      batch = batches_.size();
      if (batch - oldest == open_batches) close(oldest++);
      Batch empty{};
      std::fill(std::begin(empty.a), std::end(empty.a), nobody);
      std::fill(std::begin(empty.b), std::end(empty.b), nobody);
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
    row.of_a[lane] = of_a;
    row.of_b[lane] = of_b;
    row.target[lane] = p.target;
    row.slack[lane] = p.slack * per_rate;
    row.a[lane] = p.a;
    row.b[lane] = fixed ? nobody : p.b;
    in_[p.a] |= bit;
    if (!fixed) in_[p.b] |= bit;
    place_.push_back(static_cast<std::uint32_t>(width * batch + lane));
  }
}

/// Sets out from u and the forces that are given, or from none.
void Sweeps::start(std::span<const Vec3> u, std::span<const PressedPair> pairs, bool guess) {
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
double Sweeps::potential(std::span<const Vec3> u, std::span<const PressedPair> pairs) const {
  double sum = 0;
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    const PressedPair& p = pairs[c];
    const Batch& row = batches_[place_[c] / width];
    const std::size_t lane = place_[c] % width;
    if (row.force[lane] == 0) continue;
    const Vec3 before = p.b == PressedPair::none ? Vec3(-u[p.a]) : Vec3(u[p.b] - u[p.a]);
    const Four now = motions_[row.b[lane]].u - motions_[row.a[lane]].u;
    sum += row.force[lane] * (0.5 * p.normal.dot(before + Vec3(now[0], now[1], now[2])) - p.target);
  }
  return sum;
}

/// Once through all batches. The most by which a force has changed beyond its slack.
CAROM_FOR_ALL_PROCESSORS
double Sweeps::sweep(Batch* batches, std::size_t count, Motion* motions, bool back) {
  using Places = long long __attribute__((vector_size(sizeof(Four))));
  const Four zero{};
  Four worst = zero - 1;
  for (std::size_t k = 0; k < count; ++k) {
    Batch& row = batches[back ? count - 1 - k : k];
    Four& a0 = motions[row.a[0]].u;
    Four& a1 = motions[row.a[1]].u;
    Four& a2 = motions[row.a[2]].u;
    Four& a3 = motions[row.a[3]].u;
    Four& b0 = motions[row.b[0]].u;
    Four& b1 = motions[row.b[1]].u;
    Four& b2 = motions[row.b[2]].u;
    Four& b3 = motions[row.b[3]].u;
    const Four w0 = b0 - a0, w1 = b1 - a1, w2 = b2 - a2, w3 = b3 - a3;
    // By axis, from by pair.
    const Four low01 = __builtin_shuffle(w0, w1, Places{0, 4, 2, 6}),
               low23 = __builtin_shuffle(w2, w3, Places{0, 4, 2, 6});
    const Four high01 = __builtin_shuffle(w0, w1, Places{1, 5, 3, 7}),
               high23 = __builtin_shuffle(w2, w3, Places{1, 5, 3, 7});
    const Four x = __builtin_shuffle(low01, low23, Places{0, 1, 4, 5});
    const Four y = __builtin_shuffle(high01, high23, Places{0, 1, 4, 5});
    const Four z = __builtin_shuffle(low01, low23, Places{2, 3, 6, 7});
    const Four rate = row.normal[0] * x + row.normal[1] * y + row.normal[2] * z;
    const Four wanted = row.force - (rate - row.target) * row.per_rate;
    const Four force = wanted > zero ? wanted : zero, change = force - row.force;
    row.force = force;
    const Four size = change < zero ? -change : change, excess = size - row.slack;
    worst = excess > worst ? excess : worst;
    // By pair, from by axis.
    const Four px = change * row.normal[0], py = change * row.normal[1], pz = change * row.normal[2];
    const Four xy_even = __builtin_shuffle(px, py, Places{0, 4, 2, 6}),
               xy_odd = __builtin_shuffle(px, py, Places{1, 5, 3, 7});
    const Four z_even = __builtin_shuffle(pz, zero, Places{0, 4, 2, 6}),
               z_odd = __builtin_shuffle(pz, zero, Places{1, 5, 3, 7});
    const Four p0 = __builtin_shuffle(xy_even, z_even, Places{0, 1, 4, 5});
    const Four p1 = __builtin_shuffle(xy_odd, z_odd, Places{0, 1, 4, 5});
    const Four p2 = __builtin_shuffle(xy_even, z_even, Places{2, 3, 6, 7});
    const Four p3 = __builtin_shuffle(xy_odd, z_odd, Places{2, 3, 6, 7});
    a0 -= row.of_a[0] * p0;
    a1 -= row.of_a[1] * p1;
    a2 -= row.of_a[2] * p2;
    a3 -= row.of_a[3] * p3;
    b0 += row.of_b[0] * p0;
    b1 += row.of_b[1] * p1;
    b2 += row.of_b[2] * p2;
    b3 += row.of_b[3] * p3;
  }
  return std::max(std::max(worst[0], worst[1]), std::max(worst[2], worst[3]));
}

bool Sweeps::press_apart(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<PressedPair> pairs,
                         int sweeps) {
  arrange(inverse_mass, pairs);
  motions_.assign(u.size() + 1, Motion{});
  const auto run = [&](bool guess) {
    start(u, pairs, guess);
    bool done = pairs.empty();
    for (int k = 0; k < sweeps && !done; ++k)
      done = sweep(batches_.data(), batches_.size(), motions_.data(), k % 2 != 0) <= 0;
    return done;
  };
  bool done = run(true);
  if (!done && potential(u, pairs) > 0) done = run(false);  // sweeps only lower it, and no forces have none
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = Vec3(motions_[k].u[0], motions_[k].u[1], motions_[k].u[2]);
  for (std::size_t c = 0; c < pairs.size(); ++c) pairs[c].force = batches_[place_[c] / width].force[place_[c] % width];
  return done;
}

}  // namespace carom
