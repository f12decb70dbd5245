// Decimal numbers as 128-bit integers with a count of decimal places,
// so that 0.1 steps give 0.3 and not 0.30000000000000004.
// Sums of doubles would drift, and their texts would differ from what an author writes.
// A quotient without a finite expansion is the nearest double, found from its digits: the same on every processor.
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

string with_point(string digits, int places, bool negative) {
  for (; places > 0 && digits.ends_with('0'); --places) digits.pop_back();
  if (digits.empty()) return "0";

  if (places > 0) {
    const auto after = size_t(places);
    if (digits.size() <= after) digits.insert(0, after + 1 - digits.size(), '0');
    digits.insert(digits.size() - after, 1, '.');
  }
  return negative ? "-" + digits : digits;
}

/// The text of value + rest / last units: exact if it has no more than most_digits, else that of the nearest double.
string quotient_text(const Decimal& value, Wide rest, Wide last) {
  const bool negative = value.units < 0 || rest < 0;
  if (negative) rest = -rest;
  string digits = digits_of(negative ? -value.units : value.units);
  int places = value.places;
  const auto add_digits = [&](size_t most) {
    for (; rest != 0 && digits.size() < most; ++places) {
      rest *= 10;
      digits += char('0' + int(rest / last));
      rest %= last;
      if (digits.starts_with('0') && digits.size() > 1) digits.erase(0, 1);
    }
  };

  add_digits(most_digits);
  if (rest == 0 && places <= most_digits) return with_point(digits, places, negative);

  // The middle between two doubles has fewer digits than this, so that one more stands for all that are beyond.
  add_digits(200);
  if (rest != 0) digits += '1', ++places;
  return shortest(*parse_number(with_point(digits, places, negative)));
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
  return with_point(digits_of(value.units < 0 ? -value.units : value.units), value.places, value.units < 0);
}

vector<string> spread(const Decimal& from, const Decimal& to, uint64_t count) {
  Decimal a = from, b = to;
  align(a, b);

  vector<string> out;
  const auto last = static_cast<Wide>(count) - 1;
  const Wide way = b.units - a.units;
  for (Wide i = 0; i <= last; ++i) {
    if (i == 0 || i == last) {
      out.push_back(to_text(i == 0 ? a : b));
      continue;
    }

    // The value is whole + rest / last, in units. Both have its sign.
    Wide rest = way % last * i;
    Wide whole = a.units + way / last * i + rest / last;
    rest %= last;
    if (whole > 0 && rest < 0) --whole, rest += last;
    if (whole < 0 && rest > 0) ++whole, rest -= last;
    out.push_back(quotient_text({whole, a.places}, rest, last));
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
