#pragma once
// Files that stand in a folder already: read beneath its descriptor, no link followed, nothing but regular files.
#include <cstdint>
#include <optional>
#include <string>

#include "files/output_file.h"

namespace carom {

/// Reads on, up to `size` bytes; 0: at the end. Throws ExportError.
std::size_t read_some(int file, char* to, std::size_t size);

/// Opens a regular file for reading; none if there is none, or a link, a pipe, a folder. Throws ExportError where that
/// cannot be said, as all below.
Descriptor open_stored(int folder, const std::string& name);

/// A stored file's size in bytes.
std::optional<std::uint64_t> stored_size(int folder, const std::string& name);

/// A stored file's name, size and hash, by reading it.
std::optional<FileRecord> read_record(int folder, const std::string& name);

/// A stored file's text; none if it is longer than `most` bytes.
std::optional<std::string> read_text(int folder, const std::string& name, std::uint64_t most);

}  // namespace carom
