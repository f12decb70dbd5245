#pragma once
// Evenly spread numbers, computed as decimals: 0.5, 0.6, 0.7, never 0.7000000000000001.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

__extension__ typedef __int128 Wide;

/// A number with a finite decimal expansion: units * 10^-places, exact.
struct Decimal {
  Wide units = 0;
  int places = 0;
};

/// A number as YAML writes it (values.h). None: it is no number, or needs more than 18 digits from its first to its
/// last one, the unit's place among them.
std::optional<Decimal> parse_decimal(std::string_view text);

/// The shortest text of this number, without an exponent: "0.7", "-12".
std::string to_text(const Decimal& value);

/// `count` numbers from `from` to `to`, ends included, evenly: exact where they have a finite decimal expansion of at
/// most 18 digits, else the nearest doubles' shortest text. One number alone is `from`.
std::vector<std::string> spread(const Decimal& from, const Decimal& to, std::uint64_t count);

/// from, from + step, ... as far as `to`, exact; `most` + 1 numbers if there are more than `most`; none if `step` leads
/// away from `to` or nowhere.
std::vector<std::string> steps(const Decimal& from, const Decimal& to, const Decimal& step, std::uint64_t most);

}  // namespace carom
