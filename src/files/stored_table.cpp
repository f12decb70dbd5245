// Reads CSV in pieces, so that tables of gigabytes need little memory.
// Cells are views into the buffer. Cells with quotes or a decimal comma are copied, without
// these, into a separate text.
#include "files/stored_table.h"

#include <unistd.h>

#include <cerrno>
#include <charconv>

#include "files/stored_file.h"
#include "std.h"

namespace carom {
namespace {

/// Most tables read are short, so the first piece is short.
constexpr size_t first_piece = 4096, piece_size = size_t{64} * 1024;

/// Reads exactly `size` bytes at `offset`.
void read_at(int file, char* to, size_t size, uint64_t offset) {
  while (size > 0) {
    const ssize_t n = pread(file, to, size, off_t(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("read", place_of(file), "");
    if (n == 0) fail("read", place_of(file), "", "it was truncated");
    to += n;
    size -= size_t(n);
    offset += uint64_t(n);
  }
}

}  // namespace

optional<double> number_in(string_view cell) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (cell.empty() || error != std::errc() || end != cell.data() + cell.size() || !isfinite(value)) return {};
  return value;
}

char separator_of(string_view head) {
  // A name in quotes may have any characters.
  const size_t name = head.starts_with('"') ? head.find('"', 1) : 0;
  const size_t at = head.find_first_of(",;\t", min(name, head.size()));
  return at == string_view::npos ? ',' : head[at];
}

void split_cells(string_view line, char separator, vector<string_view>& cells, string& changed) {
  cells.clear();
  changed.clear();
  // Reserve, so that views into it stay valid.
  changed.reserve(line.size());

  for (size_t i = 0; i <= line.size();) {
    if (i < line.size() && line[i] == '"') {
      const size_t from = changed.size();
      for (++i; i < line.size(); ++i) {
        if (line[i] == '"' && (i + 1 >= line.size() || line[++i] != '"')) break;
        changed += line[i];
      }

      cells.push_back(string_view(changed).substr(from));
      i = min(line.find(separator, min(i, line.size())), line.size()) + 1;
    } else {
      const size_t end = min(line.find(separator, i), line.size());
      string_view cell = line.substr(i, end - i);

      // A decimal comma.
      if (const size_t mark = separator == ',' ? cell.npos : cell.find(','); mark != cell.npos) {
        const size_t from = changed.size();
        changed += cell;
        changed[from + mark] = '.';
        cell = string_view(changed).substr(from);
      }
      cells.push_back(cell);
      i = end + 1;
    }
  }
}

StoredTable::StoredTable(Descriptor file) : file_(std::move(file)) {
  string_view line;
  if (!read_line(line)) return;
  separator_ = separator_of(line);
  split_cells(line, separator_, cells_, changed_);
  columns_.assign(cells_.begin(), cells_.end());
}

optional<size_t> StoredTable::find(string_view column) const {
  const auto found = ranges::find(columns_, column);
  if (found == columns_.end()) return nullopt;
  return size_t(found - columns_.begin());
}

bool StoredTable::read_line(string_view& line) {
  for (bool quoted = false;;) {
    // A line ends at the first LF outside of quotes.
    for (size_t i = begin_; i < buffer_.size(); ++i) {
      if (buffer_[i] == '"') quoted = !quoted;
      if (buffer_[i] != '\n' || quoted) continue;
      line = string_view(buffer_).substr(begin_, i - begin_);
      begin_ = i + 1;
      return true;
    }

    // Read on behind the incomplete line. Its quotes are counted anew.
    if (ended_) break;
    quoted = false;
    buffer_.erase(0, begin_);
    begin_ = 0;
    const size_t kept = buffer_.size(), more = max(buffer_.capacity() < first_piece ? first_piece : piece_size, kept);
    buffer_.resize(kept + more);
    const size_t n = read_some(file_.get(), buffer_.data() + kept, more);
    buffer_.resize(kept + n);
    ended_ = n == 0;
  }

  line = string_view(buffer_).substr(begin_);
  begin_ = buffer_.size();
  return !line.empty();
}

const vector<string_view>* StoredTable::next() {
  string_view line;
  if (!read_line(line)) return nullptr;
  split_cells(line, separator_, cells_, changed_);
  return &cells_;
}

void lines_from_end(int file, const function<bool(string_view line)>& take) {
  // The text from `at` on, without the lines already passed to `take`.
  string text;
  uint64_t at = file_size(file);
  while (at > 0) {
    // Put another piece in front.
    const size_t size = size_t(min<uint64_t>(at, max(piece_size, text.size())));
    at -= size;
    string piece(size, '\0');
    read_at(file, piece.data(), size, at);
    text.insert(0, piece);

    // Take the lines that are complete.
    for (;;) {
      while (text.ends_with('\n')) text.pop_back();
      const size_t before = text.rfind('\n');
      if (before == string::npos) break;
      if (!take(string_view(text).substr(before + 1))) return;
      text.resize(before);
    }
  }
}

}  // namespace carom
