#pragma once
// Scalars of a scene file -> numbers. By std::from_chars, so that no locale has a say.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "yaml/document.h"

namespace carom {

/// A decimal number as YAML writes it; finite, without a leading zero, and not so small that it would become 0.
std::optional<double> parse_number(std::string_view text);

/// A whole number >= 0, as digits or as any number that is whole (1e6).
std::optional<std::uint64_t> parse_whole(std::string_view text);

/// The number of a group's member or of a list's entry: digits alone, without a leading zero.
std::optional<std::uint64_t> parse_index(std::string_view text);

/// What is wrong with a scalar that is no number, and what to write instead.
struct Complaint {
  std::string message, remedy;
};
/// The number that stands there by the format: its key and unit, and "expected a number above 0 in kg".
struct WantedNumber {
  std::string_view key, unit;
  std::string expected;
};
Complaint explain_number(const Node& node, const WantedNumber& number);

/// The shortest decimal that reads back to the same double.
std::string shortest(double value);

/// A name: [A-Za-z_][A-Za-z0-9_-]*
bool is_name(std::string_view text);

}  // namespace carom
