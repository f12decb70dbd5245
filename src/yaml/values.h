#pragma once
// Scalars of a scene file to numbers. They use std::from_chars, which does not depend on the locale.

#include "std.h"
#include "yaml/document.h"

namespace carom {

/// A decimal number as YAML writes it: finite, without a leading zero, and not rounded to 0.
optional<double> parse_number(string_view text);

/// A whole number >= 0, as digits or as any number that is whole (1e6).
optional<uint64_t> parse_whole(string_view text);

/// The number of a group's member or of a list's entry: digits only, without a leading zero.
optional<uint64_t> parse_index(string_view text);

/// A word for infinity, without a sign. It is no number of a scene.
bool is_infinite(string_view text);

/// What is wrong with a scalar that is not a number, and what to write instead.
struct Complaint {
  string message, remedy;
};
/// The number that the format expects: its key and unit, and "expected a number above 0 in kg".
struct ExpectedNumber {
  string_view key, unit;
  string expected;
};
Complaint explain_number(const Node& node, const ExpectedNumber& number);

/// The shortest decimal that parses to the same double.
string shortest(double value);

/// A name: [A-Za-z_][A-Za-z0-9_-]*
bool is_name(string_view text);

}  // namespace carom
