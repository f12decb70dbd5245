#pragma once
// The cause of a syntax error, reported at the place where the author will look for it.

#include "std.h"
#include "yaml/place.h"

namespace carom {

class Diagnostics;

/// A value in brackets that goes on, as in `caption: {time} s`, and what to do.
inline constexpr string_view text_after_bracket = "text goes on after the closing bracket";
inline constexpr string_view quotes_for_bracket = "a text that begins with a bracket or a brace needs quotes";

/// Adds one error for a parse failure that the parser detected at byte `detected` of `source`. `complaint`: its
/// message. The parser detects it late: an open bracket at the end of the file, a missing ':' at the next one. This
/// function finds the cause.
void explain_syntax(const Source& source, uint32_t index, size_t begin, size_t detected, const string& complaint,
                    Diagnostics& diagnostics);

}  // namespace carom
