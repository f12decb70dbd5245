#pragma once
// Names of files that differ from a given one in the case of letters alone: files made where case does not count.
#include <filesystem>

#include "std.h"

namespace carom {

/// The name of a file or folder that is there, relative to `folder` as `name` is, and differs from `name` in the case
/// of ASCII letters. Of several the first in the alphabet. Empty: there is none, or `name` itself is there.
string name_in_other_case(const std::filesystem::path& folder, const std::filesystem::path& name);

}  // namespace carom
