// Reads CSV in pieces, so that tables of gigabytes need little memory.
// Cells are views into the buffer. Quoted cells are copied without their quotes into a separate text.
#include "files/stored_table.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>

#include "files/stored_file.h"

namespace carom {
namespace {

/// Most tables read are short, so the first piece is short.
constexpr std::size_t first_piece = 4096, piece_size = std::size_t{64} * 1024;

/// Reads exactly `size` bytes at `offset`.
void read_at(int file, char* to, std::size_t size, std::uint64_t offset) {
  while (size > 0) {
    const ssize_t n = pread(file, to, size, static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("read", place_of(file), "");
    if (n == 0) fail("read", place_of(file), "", "it was truncated");
    to += n;
    size -= static_cast<std::size_t>(n);
    offset += static_cast<std::uint64_t>(n);
  }
}

std::uint64_t size_of(int file) {
  struct stat info {};
  if (fstat(file, &info) != 0) fail("read", place_of(file), "");
  return static_cast<std::uint64_t>(info.st_size);
}

}  // namespace

std::optional<double> number_in(std::string_view cell) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (cell.empty() || error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) return {};
  return value;
}

void split_cells(std::string_view line, std::vector<std::string_view>& cells, std::string& unquoted) {
  cells.clear();
  unquoted.clear();
  // Reserve, so that views into it stay valid.
  unquoted.reserve(line.size());
  for (std::size_t i = 0; i <= line.size();) {
    if (i < line.size() && line[i] == '"') {
      const std::size_t from = unquoted.size();
      for (++i; i < line.size(); ++i) {
        if (line[i] == '"' && (i + 1 >= line.size() || line[++i] != '"')) break;
        unquoted += line[i];
      }
      cells.push_back(std::string_view(unquoted).substr(from));
      i = std::min(line.find(',', std::min(i, line.size())), line.size()) + 1;
    } else {
      const std::size_t end = std::min(line.find(',', i), line.size());
      cells.push_back(line.substr(i, end - i));
      i = end + 1;
    }
  }
}

StoredTable::StoredTable(Descriptor file) : file_(std::move(file)) {
  std::string_view line;
  if (!read_line(line)) return;
  split_cells(line, cells_, unquoted_);
  columns_.assign(cells_.begin(), cells_.end());
}

std::optional<std::size_t> StoredTable::find(std::string_view column) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

bool StoredTable::read_line(std::string_view& line) {
  for (bool quoted = false;;) {
    // A line ends at the first LF outside of quotes.
    for (std::size_t i = begin_; i < buffer_.size(); ++i) {
      if (buffer_[i] == '"') quoted = !quoted;
      if (buffer_[i] != '\n' || quoted) continue;
      line = std::string_view(buffer_).substr(begin_, i - begin_);
      begin_ = i + 1;
      return true;
    }
    if (ended_) break;
    quoted = false;
    buffer_.erase(0, begin_);
    begin_ = 0;
    const std::size_t kept = buffer_.size(),
                      more = std::max(buffer_.capacity() < first_piece ? first_piece : piece_size, kept);
    buffer_.resize(kept + more);
    const std::size_t n = read_some(file_.get(), buffer_.data() + kept, more);
    buffer_.resize(kept + n);
    ended_ = n == 0;
  }
  line = std::string_view(buffer_).substr(begin_);
  begin_ = buffer_.size();
  return !line.empty();
}

const std::vector<std::string_view>* StoredTable::next() {
  std::string_view line;
  if (!read_line(line)) return nullptr;
  split_cells(line, cells_, unquoted_);
  return &cells_;
}

void lines_from_end(int file, const std::function<bool(std::string_view line)>& take) {
  // The text from `at` on, without the lines already passed to `take`.
  std::string text;
  std::uint64_t at = size_of(file);
  while (at > 0) {
    const std::size_t size = static_cast<std::size_t>(std::min<std::uint64_t>(at, std::max(piece_size, text.size())));
    at -= size;
    std::string piece(size, '\0');
    read_at(file, piece.data(), size, at);
    text.insert(0, piece);
    for (;;) {
      while (text.ends_with('\n')) text.pop_back();
      const std::size_t before = text.rfind('\n');
      if (before == std::string::npos) break;
      if (!take(std::string_view(text).substr(before + 1))) return;
      text.resize(before);
    }
  }
}

}  // namespace carom
