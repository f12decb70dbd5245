#pragma once
// What stands in a folder.
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// The names in an open folder, sorted, without . and ..
std::vector<std::string> folder_names(int folder);

/// Whether part_name() gives such names: those of files that are being written, or were when a run was killed.
bool is_part_name(std::string_view name);

/// Removes an entry: a file, a link, or a folder that holds nothing but such.
void remove_entry(int folder, const std::string& name);

}  // namespace carom
