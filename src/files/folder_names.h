#pragma once
// The entries of a folder.

#include "files/file_place.h"
#include "std.h"

namespace carom {

/// The names in an open folder, sorted, without . and .. Throws ExportError.
vector<string> folder_names(int folder);

/// Whether `name` can only refer to an entry of the folder itself, and is not hidden.
bool is_plain_name(string_view name);

/// The temporary name of a file.
string part_name(string_view name);

/// Whether part_name() can produce this name. Such files are being written, or were when a run was killed.
bool is_part_name(string_view name);

/// The final name of a temporary file.
string name_of_part(string_view part);

/// Removes an entry if it exists: a file, a link, or a folder that holds only files and links. Throws ExportError.
void remove_entry(const FilePlace& place, const string& name);

/// The same without exceptions. Returns false, with errno set, if the entry still exists.
bool try_to_remove(int folder, const string& name);

/// Removes all temporary files in a folder except `spared`. Throws ExportError.
void remove_parts(const FilePlace& place, string_view spared = {});

/// Removes a file if it exists, and no other kind of entry. Throws ExportError.
void remove_file(const FilePlace& place, const string& name);

}  // namespace carom
