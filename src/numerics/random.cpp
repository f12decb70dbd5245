// SplitMix64 with a seed mixed from the scene's seed and the FNV-1a hash of the stream's name.
// Normal deviates use Marsaglia's polar method, which needs only sqrt and a logarithm.
// The logarithm is a series in basic arithmetic, because the library's differs between processors.
#include "numerics/random.h"

#include "std.h"

namespace carom {
namespace {

/// 2^64 over the golden ratio.
constexpr uint64_t step = 0x9E3779B97F4A7C15ULL;

uint64_t mix(uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

}  // namespace

Random::Random(uint64_t seed, string_view stream) {
  // FNV-1a of the name.
  uint64_t hash = 0xCBF29CE484222325ULL;
  for (const char c : stream) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
  state_ = mix(mix(seed + step) ^ hash);
}

Random& Random::skip(uint64_t count) {
  state_ += count * step;
  return *this;
}

uint64_t Random::bits() {
  state_ += step;
  return mix(state_);
}

uint64_t Random::below(uint64_t n) {
  // Values from the last, incomplete run of n are rejected.
  const uint64_t limit = ~uint64_t{0} - (~uint64_t{0} % n + 1) % n;
  for (;;) {
    const uint64_t value = bits();
    if (value <= limit) return value % n;
  }
}

double Random::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }

  // The polar method makes two numbers at once.
  for (;;) {
    const double u = 2 * uniform() - 1;
    const double v = 2 * uniform() - 1;
    const double s = u * u + v * v;
    if (s >= 1 || s == 0) continue;
    const double factor = sqrt(-2 * reproducible_log(s) / s);
    spare_ = v * factor;
    has_spare_ = true;
    return u * factor;
  }
}

double reproducible_log(double x) {
  int exponent = 0;
  // Exact; 0.5 <= m < 1.
  double m = std::frexp(x, &exponent);
  if (m < 0.70710678118654752) {
    m *= 2;
    --exponent;
  }
  // |z| < 0.172, so each term of the series is smaller by a factor of at least 33.
  const double z = (m - 1) / (m + 1);
  const double z2 = z * z;
  double sum = 0;
  for (int k = 23; k >= 3; k -= 2) sum = (sum + 1.0 / k) * z2;
  return exponent * 0.693147180559945309 + 2 * (z + z * sum);
}

}  // namespace carom
