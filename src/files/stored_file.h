#pragma once
// Reads existing files relative to a folder's descriptor. It follows no link and reads only regular files.

#include "files/output_file.h"
#include "std.h"

namespace carom {

/// Reads up to `size` bytes from the current position. 0: the end of the file. Throws ExportError.
size_t read_some(int file, char* to, size_t size);

/// Opens a regular file for reading. None if there is none, or a link, a pipe, a folder.
/// Throws ExportError on other errors, as all functions below do.
Descriptor open_stored(int folder, const string& name);

/// The name of a stored table: `name`, or with the ending .gz that of the compressed one. None: there is neither.
optional<string> stored_table(int folder, const string& name);

/// Opens a stored table for reading, at its start. Of a compressed one that is a temporary file without a name, in the
/// same file system or, where nothing can be written there, among the system's temporary files. None if there is none.
Descriptor open_stored_table(int folder, const string& name);

/// The size of an open file in bytes.
uint64_t file_size(int file);

/// The size of a stored file in bytes.
optional<uint64_t> stored_size(int folder, const string& name);

/// The name, size and hash of a stored file, which is read completely.
optional<FileRecord> read_record(int folder, const string& name);

/// The text of a stored file. None if it is longer than `most` bytes.
optional<string> read_text(int folder, const string& name, uint64_t most);

}  // namespace carom
