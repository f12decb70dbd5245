#pragma once
// Reads existing files relative to a folder's descriptor. It follows no link and reads only regular files.
#include <cstdint>
#include <optional>
#include <string>

#include "files/output_file.h"

namespace carom {

/// Reads up to `size` bytes from the current position. 0: the end of the file. Throws ExportError.
std::size_t read_some(int file, char* to, std::size_t size);

/// Opens a regular file for reading. None if there is none, or a link, a pipe, a folder.
/// Throws ExportError on other errors, as all functions below do.
Descriptor open_stored(int folder, const std::string& name);

/// The size of a stored file in bytes.
std::optional<std::uint64_t> stored_size(int folder, const std::string& name);

/// The name, size and hash of a stored file, which is read completely.
std::optional<FileRecord> read_record(int folder, const std::string& name);

/// The text of a stored file. None if it is longer than `most` bytes.
std::optional<std::string> read_text(int folder, const std::string& name, std::uint64_t most);

}  // namespace carom
