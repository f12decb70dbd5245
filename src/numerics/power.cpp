// x^y = x^n x^f with a whole n and |f| <= 1/2. The first factor is a product of squares in double-double.
// The second is exp(f ln x), whose argument is small once the powers of two are taken out of x.
// exp(y ln x) by itself would lose as many digits as y ln x has before the point.
#include "numerics/power.h"

#include "numerics/elementary.h"
#include "std.h"

namespace carom {
namespace {

constexpr double largest_whole = 0x1p40;

/// mantissa 2^exponent. The mantissa is from 1/2 to 2, or 0.
struct Scaled {
  DoubleDouble mantissa;
  int64_t exponent;
};

Scaled normalized(DoubleDouble m, int64_t exponent) {
  int shift = 0;
  std::frexp(m.hi, &shift);
  return {{std::ldexp(m.hi, -shift), std::ldexp(m.lo, -shift)}, exponent + shift};
}

Scaled product(const Scaled& a, const Scaled& b) {
  return normalized(a.mantissa * b.mantissa, a.exponent + b.exponent);
}

double value(const Scaled& of) {
  const int64_t exponent = clamp<int64_t>(of.exponent, -4000, 4000);
  return std::ldexp(of.mantissa.value(), int(exponent));
}

Scaled whole_power(double x, double n) {
  Scaled square = normalized({x, 0}, 0), result{{1, 0}, 0};
  for (auto left = uint64_t(std::abs(n)); left > 0; left >>= 1) {
    if ((left & 1) != 0) result = product(result, square);
    square = product(square, square);
  }
  if (n >= 0) return result;
  return normalized(DoubleDouble{1, 0} / result.mantissa, -result.exponent);
}

double exp_of(double z) {
  return z <= 0 ? exp_minus(-z) : 1 / exp_minus(z);
}

/// x^f for x > 0 and |f| <= 1/2.
Scaled root(double x, double f) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);  // in [1/2, 1)
  if (m < sqrt(0.5)) {
    m *= 2;
    --exponent;
  }
  const DoubleDouble twos = two_product(exponent, f);
  const double whole = std::nearbyint(twos.hi);
  const double rest = (twos.hi - whole) + twos.lo;
  constexpr double ln2 = 0x1.62e42fefa39efp-1;
  return normalized({exp_of(f * logarithm(m) + rest * ln2), 0}, int64_t(whole));
}

}  // namespace

double power(double x, double y) {
  if (y == 0 || x == 1) return 1;
  if (std::isnan(x) || std::isnan(y)) return x + y;

  const bool is_whole = std::nearbyint(y) == y, is_odd = is_whole && std::fmod(y, 2) != 0;
  if (x == 0) return y > 0 ? 0 : infinity;
  if (x < 0 && !is_whole) return numeric_limits<double>::quiet_NaN();
  const double base = std::abs(x), sign = x < 0 && is_odd ? -1 : 1;

  // Such powers are 0, 1 or infinite.
  if (!isfinite(x) || std::abs(y) > largest_whole) {
    if (base == 1) return sign;
    return sign * ((base > 1) == (y > 0) ? infinity : 0);
  }

  if (y == 0.5) return sqrt(x);
  const double n = std::nearbyint(y), f = y - n;
  const Scaled whole = whole_power(base, n);
  return sign * value(f == 0 ? whole : product(whole, root(base, f)));
}

}  // namespace carom
