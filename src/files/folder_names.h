#pragma once
// What stands in a folder.
#include <string>
#include <string_view>
#include <vector>

#include "files/part_file.h"

namespace carom {

/// The names in an open folder, sorted, without . and .. Throws ExportError.
std::vector<std::string> folder_names(int folder);

/// Whether part_name() gives such names: those of files that are being written, or were when a run was killed.
bool is_part_name(std::string_view name);

/// The name that a part's file will have.
std::string name_of_part(std::string_view part);

/// Removes an entry, if it is there: a file, a link, or a folder that holds nothing but such. Throws ExportError.
void remove_entry(const FilePlace& place, const std::string& name);

/// The same. False, with errno: it is still there.
bool try_to_remove(int folder, const std::string& name);

/// Removes all parts in a folder but `spared`. Throws ExportError.
void remove_parts(const FilePlace& place, std::string_view spared = {});

/// Removes a file, if it is there, and nothing else. Throws ExportError.
void remove_file(const FilePlace& place, const std::string& name);

}  // namespace carom
