#pragma once
// Evenly spread numbers, computed as decimals: 0.5, 0.6, 0.7, never 0.7000000000000001.

#include "std.h"

namespace carom {

__extension__ typedef __int128 Wide;

/// A number with a finite decimal expansion: units * 10^-places, exact.
struct Decimal {
  Wide units = 0;
  int places = 0;
};

/// A number as YAML writes it (values.h).
/// None: `text` is not a number, or it needs more than 18 digits from its first to its last, the unit's place included.
optional<Decimal> parse_decimal(string_view text);

/// The shortest text of this number, without an exponent: "0.7", "-12".
string to_text(const Decimal& value);

/// `count` evenly spread numbers from `from` to `to`, ends included. A single number is `from`.
/// A number with a finite decimal expansion of at most 18 digits is exact.
/// Any other is the shortest text of the nearest double.
vector<string> spread(const Decimal& from, const Decimal& to, uint64_t count);

/// The numbers from, from + step, ... up to `to`, exact.
/// Returns `most` + 1 numbers if there are more than `most`, and none if `step` is zero or leads away from `to`.
vector<string> steps(const Decimal& from, const Decimal& to, const Decimal& step, uint64_t most);

}  // namespace carom
