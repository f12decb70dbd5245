// Draws multiples of a power of ten as 128-bit integers. Rounding a uniform double would give the ends of the range
// half of their weight, and could cross the border of a part. McKay, Beckman & Conover, "A Comparison of Three Methods
// for Selecting Values of Input Variables", 1979: one number from each part of each range, and the parts of several
// ranges paired at random.
#include "scene/samples.h"

#include <fmt/format.h>

#include <numeric>

#include "numerics/elementary.h"
#include "numerics/whole.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

constexpr Wide fewest = 100'000;       // numbers in a range
constexpr Wide fewest_in_part = 1000;  // and in a part of it
constexpr int most_digits = 15;        // of a number

Wide power(int n) {
  Wide value = 1;
  for (; n > 0; --n) value *= 10;
  return value;
}

/// RangePart `number` of `count` equal parts of a range.
struct RangePart {
  Wide number, count;
};

/// The numbers to draw: multiples of `step`. All in units of 10^-places.
struct DecimalLattice {
  Wide from, to, step;
  int places;
};

/// None: the ends or the numbers need too many digits.
optional<DecimalLattice> lattice_of(const SampledRange& range, Wide needed) {
  const int places = max(range.from.places, range.to.places);
  DecimalLattice all{range.from.units * power(places - range.from.places),
                     range.to.units * power(places - range.to.places), 1, places};
  const auto largest = [&] { return max(all.from < 0 ? -all.from : all.from, all.to < 0 ? -all.to : all.to); };
  // Borders of parts are products by the number of parts, up to 10^6, and must not overflow.
  if (largest() >= power(most_digits + 6)) return nullopt;
  for (; all.to - all.from < needed; ++all.places) {
    all.from *= 10;
    all.to *= 10;
  }
  while ((all.to - all.from) / (10 * all.step) >= needed) all.step *= 10;
  return largest() / all.step < power(most_digits) ? optional(all) : nullopt;
}

/// The least whole number that is not below a / b. b > 0.
Wide ceiling(Wide a, Wide b) {
  return a / b + (a % b > 0 ? 1 : 0);
}

/// A multiple m of the step with from + width number / count <= m < from + width (number + 1) / count.
string linear(const DecimalLattice& all, const RangePart& part, Random& random) {
  const auto first_beyond = [&](Wide border) {
    return ceiling(all.from * part.count + (all.to - all.from) * border, all.step * part.count);
  };
  Wide first = first_beyond(part.number);
  if (first * all.step == all.from) ++first;
  const auto many = uint64_t(first_beyond(part.number + 1) - first);
  return to_text({(first + static_cast<Wide>(random.below(many))) * all.step, all.places});
}

/// The whole numbers may be fewer than the parts: each is then drawn for several of them.
string whole(Wide from, Wide to, const RangePart& part, Random& random) {
  constexpr Wide shares = Wide{1} << 32;
  const Wide share = part.number * shares + static_cast<Wide>(random.below(shares));
  return to_text({from + share * (to - from + 1) / (part.count * shares), 0});
}

/// to (from / to)^(1 - x)
class Logarithmic {
 public:
  Logarithmic(double from, double to) : from_(from), to_(to), length_(log_one_plus((to - from) / from)) {}

  /// The significant digits that resolve the range's logarithm in so many numbers.
  int digits(Wide needed) const {
    int digits = 2;
    for (double numbers = 10 * length_; numbers < double(needed); numbers *= 10) ++digits;
    return digits;
  }

  /// A number of the part that is neither end of the range.
  string rounded(const RangePart& part, int digits, Random& random) const {
    while (true) {
      const string text = fmt::format("{:.{}e}", number(part, random.uniform()), digits - 1);
      const double value = parse_number(text).value_or(from_);
      if (value > from_ && value < to_ && value >= number(part, 0) && value < number(part, 1)) return shortest(value);
    }
  }

  /// A whole number, where `to` is one more than the last of them.
  string whole(const RangePart& part, Random& random) const {
    return to_text({whole_below(clamp(number(part, random.uniform()), from_, to_ - 1)), 0});
  }

 private:
  double number(const RangePart& part, double share) const {
    const double rest = (double(part.count - part.number) - share) / double(part.count);
    return to_ * exp_minus(rest * length_);
  }

  double from_, to_, length_;
};

/// The parts in random order (Fisher & Yates).
vector<Wide> shuffled(uint64_t count, Random& random) {
  vector<Wide> order(count);
  std::iota(order.begin(), order.end(), Wide{0});
  for (uint64_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

}  // namespace

vector<string> samples(const SampledRange& range, Sampling sampling, uint64_t count, Random& random) {
  const bool latin = sampling == Sampling::latin;
  const Wide parts = latin ? static_cast<Wide>(count) : 1;
  const Wide needed = max(fewest, fewest_in_part * parts);

  const double from = parse_number(to_text(range.from)).value_or(0), to = parse_number(to_text(range.to)).value_or(0);
  const Logarithmic logarithmic(range.log ? from : 1, range.log ? to + (range.whole ? 1 : 0) : 2);
  const int digits = logarithmic.digits(needed);
  optional<DecimalLattice> lattice;
  if (range.whole ? to >= 1e15 : range.log && digits > most_digits) return {};
  if (!range.whole && !range.log && !(lattice = lattice_of(range, needed))) return {};

  vector<Wide> order;
  if (latin) order = shuffled(count, random);

  vector<string> out;
  for (uint64_t i = 0; i < count; ++i) {
    const RangePart part{latin ? order[i] : 0, parts};
    if (range.whole)
      out.push_back(range.log ? logarithmic.whole(part, random)
                              : whole(range.from.units, range.to.units, part, random));
    else
      out.push_back(range.log ? logarithmic.rounded(part, digits, random) : linear(*lattice, part, random));
  }
  return out;
}

}  // namespace carom
