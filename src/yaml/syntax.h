#pragma once
// The cause of a syntax error, reported at the place where the author will look for it.
#include <cstdint>
#include <string>

#include "yaml/source.h"

namespace carom {

class Diagnostics;

/// Adds one error for a parse failure that the parser detected at byte `detected` of `source`. `complaint`: its
/// message. The parser detects it late: an open bracket at the end of the file, a missing ':' at the next one. This
/// function finds the cause.
void explain_syntax(const Source& source, std::uint32_t index, std::size_t begin, std::size_t detected,
                    const std::string& complaint, Diagnostics& diagnostics);

}  // namespace carom
