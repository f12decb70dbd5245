// Decimal numbers as 128-bit integers with a count of decimal places,
// so that 0.1 steps give 0.3 and not 0.30000000000000004.
// Sums of doubles would drift, and their texts would differ from what an author writes.
// A quotient without a finite expansion falls back to the nearest double.
#include "yaml/decimal.h"

#include <charconv>

#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

constexpr int most_digits = 18;

Wide power(int n) {
  Wide value = 1;
  for (; n > 0; --n) value *= 10;
  return value;
}

/// Gives both the same number of places.
void align(Decimal& a, Decimal& b) {
  Decimal& shorter = a.places < b.places ? a : b;
  const int places = max(a.places, b.places);
  shorter.units *= power(places - shorter.places);
  shorter.places = places;
}

string digits_of(Wide value) {
  string out;
  do {
    out += char('0' + int(value % 10));
    value /= 10;
  } while (value != 0);
  ranges::reverse(out);
  return out;
}

}  // namespace

optional<Decimal> parse_decimal(string_view text) {
  if (!parse_number(text)) return nullopt;

  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);

  // Digits without the point, and how many of them stand after it.
  string digits;
  int places = 0, exponent = 0;
  bool fraction = false;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '.') {
      fraction = true;
    } else if (text[i] == 'e' || text[i] == 'E') {
      string_view power_text = text.substr(i + 1);
      if (power_text.starts_with('+')) power_text.remove_prefix(1);
      // An exponent out of range leaves 0. Then the number itself is 0, because parse_number accepted it.
      std::from_chars(power_text.data(), power_text.data() + power_text.size(), exponent);
      break;
    } else {
      digits += text[i];
      places += fraction ? 1 : 0;
    }
  }
  if (digits.find_first_not_of('0') == string::npos) return Decimal{};

  places -= exponent;
  while (digits.size() > 1 && digits.ends_with('0')) {
    digits.pop_back();
    --places;
  }
  digits.erase(0, min(digits.find_first_not_of('0'), digits.size() - 1));

  const int before = int(digits.size()) - places;  // digits before the point
  if (max(before, 0) + max(places, 0) > most_digits) return nullopt;

  Decimal value;
  for (const char c : digits) value.units = 10 * value.units + (c - '0');
  if (places < 0) {
    value.units *= power(-places);
    places = 0;
  }
  value.places = places;
  if (negative) value.units = -value.units;
  return value;
}

string to_text(const Decimal& value) {
  Decimal v = value;
  while (v.places > 0 && v.units % 10 == 0) {
    v.units /= 10;
    --v.places;
  }
  string digits = digits_of(v.units < 0 ? -v.units : v.units);
  if (v.places > 0) {
    const auto places = size_t(v.places);
    if (digits.size() <= places) digits.insert(0, places + 1 - digits.size(), '0');
    digits.insert(digits.size() - places, 1, '.');
  }
  return v.units < 0 ? "-" + digits : digits;
}

vector<string> spread(const Decimal& from, const Decimal& to, uint64_t count) {
  Decimal a = from, b = to;
  align(a, b);

  vector<string> out;
  const auto last = static_cast<Wide>(count) - 1;
  for (Wide i = 0; i <= last; ++i) {
    if (i == 0 || i == last) {
      out.push_back(to_text(i == 0 ? a : b));
      continue;
    }

    // The value is (a (last - i) + b i) / last, in units. It is exact in at most 18 further digits, or not at all.
    // Ends that have both 18 digits above and 18 below the point overflow.
    Wide whole = 0, part = 0;
    if (__builtin_mul_overflow(a.units, last - i, &whole) || __builtin_mul_overflow(b.units, i, &part) ||
        __builtin_add_overflow(whole, part, &whole)) {
      const long double share = static_cast<long double>(i) / static_cast<long double>(last);
      const auto scale = static_cast<long double>(power(a.places));
      out.push_back(shortest(double(
          (static_cast<long double>(a.units) * (1 - share) + static_cast<long double>(b.units) * share) / scale)));
      continue;
    }

    // Further places, until the division leaves no rest.
    Wide sum = whole;
    Decimal value{0, a.places};
    const Wide limit = power(most_digits);
    while (sum % last != 0 && sum < limit && sum > -limit && value.places < most_digits) {
      sum *= 10;
      ++value.places;
    }

    if (sum % last == 0) {
      value.units = sum / last;
      out.push_back(to_text(value));
    } else {
      const long double divisor = static_cast<long double>(last) * static_cast<long double>(power(a.places));
      out.push_back(shortest(double(static_cast<long double>(whole) / divisor)));
    }
  }
  return out;
}

vector<string> steps(const Decimal& from, const Decimal& to, const Decimal& step, uint64_t most) {
  Decimal a = from, b = to, d = step;
  align(a, b);
  align(a, d);
  align(a, b);
  vector<string> out;
  const bool up = a.units <= b.units;
  if (d.units == 0 || ((d.units > 0) != up && a.units != b.units)) return out;
  for (; up ? a.units <= b.units : a.units >= b.units; a.units += d.units) {
    out.push_back(to_text(a));
    if (out.size() > most || a.units == b.units) break;
  }
  return out;
}

}  // namespace carom
