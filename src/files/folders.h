#pragma once
// Folders and their paths.

#include "files/file_place.h"
#include "std.h"

namespace carom {

/// Opens a folder.
/// Returns none, with errno set, if it is absent, no folder, or a link without `follow`.
/// Throws ExportError on other errors.
Descriptor open_folder(int parent, const string& name, bool follow);

/// Makes a folder if it is absent, and opens it. Follows no link. Throws ExportError.
Descriptor make_folder(const FilePlace& parent, const string& name);

/// Writes the names in a folder to disk. Throws ExportError.
void sync_names(const FilePlace& place);

enum class Standing { nothing, folder, other };
/// The kind of entry at a path. Throws ExportError if that cannot be determined.
Standing what_stands(const string& path);

/// Whether two paths lead to the same existing folder. Throws ExportError if that cannot be determined.
bool is_same_folder(const string& a, const string& b);

/// The path with links resolved as far as it exists. Throws ExportError if that cannot be determined.
string canonical(const string& path);

/// The absolute path. Throws ExportError if that cannot be determined.
string absolute(const string& path);

/// The last name of a folder's path: "half" of "output/half/", the name of the working folder of ".".
/// Throws ExportError if that cannot be determined.
string name_of_folder(const string& folder);

enum class LockKind { alone, shared };
/// Locks a folder. Returns false if the lock is held elsewhere. Throws ExportError.
/// On a file system without locks, such as some network ones, it returns true without a lock.
bool lock_folder(const FilePlace& place, LockKind kind);

}  // namespace carom
