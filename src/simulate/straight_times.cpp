#include "simulate/straight_times.h"

#include <cmath>
#include <limits>
#include <utility>

namespace carom {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::size_t widest = 8;

/// What a kernel works on.
struct Task {
  const Flights::Core* flights;
  const double* radius;
  Entity i;
  const Entity* others;
  std::size_t count;  // a multiple of `widest`: the last one is repeated
  double a[3];
  bool falls;  // a is not zero
  double end;
};

// A vector of `lanes` doubles, and of as many masks.
template <int lanes>
struct Lanes {
  typedef double Real __attribute__((vector_size(lanes * 8)));
  typedef long long Mask __attribute__((vector_size(lanes * 8)));
};

#define CAROM_INLINE [[gnu::always_inline]] inline

template <int lanes>
using Real = typename Lanes<lanes>::Real;
template <int lanes>
using Mask = typename Lanes<lanes>::Mask;

// Rows into columns.
CAROM_INLINE void transpose(Real<2>* r) {
  const Real<2> a = r[0], b = r[1];
  r[0] = __builtin_shufflevector(a, b, 0, 2);
  r[1] = __builtin_shufflevector(a, b, 1, 3);
}
CAROM_INLINE void transpose(Real<4>* r) {
  const Real<4> a = __builtin_shufflevector(r[0], r[1], 0, 4, 2, 6),
                b = __builtin_shufflevector(r[0], r[1], 1, 5, 3, 7);
  const Real<4> c = __builtin_shufflevector(r[2], r[3], 0, 4, 2, 6),
                d = __builtin_shufflevector(r[2], r[3], 1, 5, 3, 7);
  r[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
  r[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  r[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
  r[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}
CAROM_INLINE void transpose(Real<8>* r) {
  Real<8> p[8], q[8];
  for (int k = 0; k < 8; k += 2) {
    p[k] = __builtin_shufflevector(r[k], r[k + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    p[k + 1] = __builtin_shufflevector(r[k], r[k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int k = 0; k < 8; k += 4)
    for (int m = 0; m < 2; ++m) {
      q[k + m] = __builtin_shufflevector(p[k + m], p[k + m + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      q[k + m + 2] = __builtin_shufflevector(p[k + m], p[k + m + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  for (int m = 0; m < 4; ++m) {
    r[m] = __builtin_shufflevector(q[m], q[m + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    r[m + 4] = __builtin_shufflevector(q[m], q[m + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

template <int lanes>
CAROM_INLINE void take_root(Real<lanes>& x) {
  for (int k = 0; k < lanes; ++k) x[k] = __builtin_sqrt(x[k]);
}

/// `lanes` pairs at a time. Names as in contact_time.cpp and exact_predict.cpp.
template <int lanes, bool falls>
CAROM_INLINE void find_times(const Task& task, double* hi, double* lo) {
  using V = Real<lanes>;
  const double* p = reinterpret_cast<const double*>(task.flights + task.i);
  const double p_hi = p[6], p_lo = p[7], p_radius = task.radius[task.i];
  const V none = V{} + infinite;
  for (std::size_t k = 0; k < task.count; k += lanes) {
    V q[8], s;
    for (int l = 0; l < lanes; ++l) {
      const Entity j = task.others[k + static_cast<std::size_t>(l)];
      const double* row = reinterpret_cast<const double*>(task.flights + j);
      for (int part = 0; part < 8 / lanes; ++part)
        __builtin_memcpy(&q[part * lanes + l], row + part * lanes, sizeof(V));
      s[l] = task.radius[j];
    }
    for (int part = 0; part < 8 / lanes; ++part) transpose(q + part * lanes);
    s = p_radius + s;

    const auto later = (q[6] > p_hi) | ((q[6] == p_hi) & (q[7] > p_lo));
    const V base_hi = later ? q[6] : V{} + p_hi, base_lo = later ? q[7] : V{} + p_lo;
    const V tp = (base_hi - p_hi) + (base_lo - p_lo), tq = (base_hi - q[6]) + (base_lo - q[7]);
    V d[3], w[3];
    for (int c = 0; c < 3; ++c) {
      if constexpr (falls) {
        const double a = task.a[c];
        w[c] = (q[c + 3] + tq * a) - (p[c + 3] + tp * a);
        d[c] = (q[c] + tq * (q[c + 3] + (0.5 * tq) * a)) - (p[c] + tp * (p[c + 3] + (0.5 * tp) * a));
      } else {
        w[c] = q[c + 3] - p[c + 3];
        d[c] = (q[c] + tq * q[c + 3]) - (p[c] + tp * p[c + 3]);
      }
    }
    const V b = d[0] * w[0] + (d[1] * w[1] + d[2] * w[2]);
    const V c = (d[0] * d[0] + (d[1] * d[1] + d[2] * d[2])) - s * s;
    const V a = w[0] * w[0] + (w[1] * w[1] + w[2] * w[2]);
    const V cross[3] = {d[1] * w[2] - d[2] * w[1], d[2] * w[0] - d[0] * w[2], d[0] * w[1] - d[1] * w[0]};
    const V disc = a * s * s - (cross[0] * cross[0] + (cross[1] * cross[1] + cross[2] * cross[2]));
    const auto approaching = b < 0;
    const V edge = 1e-3 * a * s * s;
    const auto close = ~(c >= 1e-3 * s * s), grazing = (disc < edge) & (-disc < edge);
    V root = disc;
    take_root<lanes>(root);
    const V t = c / (root - b);
    const V horizon = (task.end - base_hi) + (0 - base_lo);
    const auto meets = approaching & (disc > 0) & (t <= horizon);

    // base + t, as Instant adds.
    const V sum = base_hi + t, t_part = sum - base_hi;
    const V rest = ((base_hi - (sum - t_part)) + (t - t_part)) + base_lo;
    const V time_hi = sum + rest, time_lo = rest - (time_hi - sum);
    const V known = meets ? time_hi : none;
    const V told = (approaching & (close | grazing)) ? V{} + unsure : known;
    __builtin_memcpy(hi + k, &told, sizeof(V));
    __builtin_memcpy(lo + k, &time_lo, sizeof(V));
  }
}

template <int lanes>
CAROM_INLINE std::size_t find_earliest(const double* hi, std::size_t count) {
  using V = Real<lanes>;
  V least, block;
  __builtin_memcpy(&least, hi, sizeof(V));
  for (std::size_t k = lanes; k < count; k += lanes) {
    __builtin_memcpy(&block, hi + k, sizeof(V));
    least = block < least ? block : least;
  }
  double first = least[0];
  for (int l = 1; l < lanes; ++l) first = least[l] < first ? least[l] : first;
  for (std::size_t k = 0; k < count; k += lanes) {
    __builtin_memcpy(&block, hi + k, sizeof(V));
    const auto there = block == first;
    for (int l = 0; l < lanes; ++l)
      if (there[l]) return k + static_cast<std::size_t>(l);
  }
  return 0;
}

struct Kernels {
  void (*find)(const Task&, double*, double*);
  std::size_t (*earliest)(const double*, std::size_t);
};

template <int lanes>
CAROM_INLINE void find_any(const Task& task, double* hi, double* lo) {
  task.falls ? find_times<lanes, true>(task, hi, lo) : find_times<lanes, false>(task, hi, lo);
}

void find_2(const Task& task, double* hi, double* lo) {
  find_any<2>(task, hi, lo);
}
std::size_t earliest_2(const double* hi, std::size_t count) {
  return find_earliest<2>(hi, count);
}

#if defined(__x86_64__)
#define CAROM_AVX2 __attribute__((target("avx2")))
#define CAROM_AVX512 __attribute__((target("avx512f,avx512dq,avx512vl,prefer-vector-width=512")))
CAROM_AVX2 void find_4(const Task& task, double* hi, double* lo) {
  find_any<4>(task, hi, lo);
}
CAROM_AVX2 std::size_t earliest_4(const double* hi, std::size_t count) {
  return find_earliest<4>(hi, count);
}
CAROM_AVX512 void find_8(const Task& task, double* hi, double* lo) {
  find_any<8>(task, hi, lo);
}
CAROM_AVX512 std::size_t earliest_8(const double* hi, std::size_t count) {
  return find_earliest<8>(hi, count);
}
#endif

Kernels choose() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    return {find_8, earliest_8};
  if (__builtin_cpu_supports("avx2")) return {find_4, earliest_4};
#endif
  return {find_2, earliest_2};
}

const Kernels kernels = choose();

}  // namespace

void StraightTimes::find(const Flights& flights, std::span<const double> radius, Entity i,
                         std::span<const Entity> others, const Vec3& a, double end) {
  padded_ = (others.size() + widest - 1) / widest * widest;
  if (hi_.size() < padded_) {
    hi_.resize(2 * padded_);
    lo_.resize(2 * padded_);
  }
  const std::size_t whole = others.size() / widest * widest;
  Task task{flights.cores(), radius.data(), i, others.data(), whole, {a[0], a[1], a[2]}, !a.isZero(0), end};
  kernels.find(task, hi_.data(), lo_.data());
  if (whole == others.size()) return;
  Entity last[widest];
  for (std::size_t k = 0; k < widest; ++k) last[k] = others[std::min(whole + k, others.size() - 1)];
  task.others = last;
  task.count = widest;
  kernels.find(task, hi_.data() + whole, lo_.data() + whole);
  for (std::size_t k = others.size(); k < padded_; ++k) hi_[k] = infinite;
}

std::size_t StraightTimes::earliest() const {
  return kernels.earliest(hi_.data(), padded_);
}

}  // namespace carom
