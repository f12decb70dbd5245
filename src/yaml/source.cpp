// Reads files with O_NONBLOCK and fstat and not with std::ifstream.
// A stream would block on a FIFO and would read a directory or a device.
#include "yaml/source.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/joined.h"
#include "yaml/letters.h"

namespace carom {
namespace {

// Brackets, quotes, commas and colons. Each takes about 200 bytes while scanning.
constexpr uint64_t max_brackets = 4'000'000;
// More than the depth limit of document.cpp, so that the message of that limit comes first.
constexpr int max_open_brackets = 1000;
constexpr int max_shown_tabs = 10;

struct OpenFile {
  int fd;
  ~OpenFile() {
    if (fd >= 0) close(fd);
  }
};

/// Removes the byte order mark and turns "\r\n" into "\n". Columns and shown lines then need no special case.
void normalise(string& text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  if (text.find('\r') == string::npos) return;
  size_t to = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n') continue;
    text[to++] = text[i];
  }
  text.resize(to);
}

/// False: the file looks like UTF-16 or UTF-32, which yaml-cpp would decode silently.
bool has_utf8_form(string_view text) {
  return !text.starts_with("\xFF\xFE") && !text.starts_with("\xFE\xFF") &&
         !(text.size() >= 2 && (text[0] == 0) != (text[1] == 0)) && !text.starts_with(string_view("\0\0\xFE\xFF", 4));
}

/// None: it has not been read.
optional<string>& from_standard_input() {
  static optional<string> text;
  return text;
}

Place one_byte(uint32_t index, size_t offset) {
  return {index, uint32_t(offset), 1};
}

}  // namespace

void read_standard_input(const function<void()>& stop_check) {
  constexpr int interval = 50;  // ms
  string& text = from_standard_input().emplace();
  while (text.size() <= max_source_bytes) {
    stop_check();
    pollfd ready{STDIN_FILENO, POLLIN, 0};
    if (poll(&ready, 1, interval) <= 0) continue;
    char buffer[1 << 16];
    const ssize_t got = read(STDIN_FILENO, buffer, sizeof buffer);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    text.append(buffer, size_t(got));
  }
}

bool read_source(const string& path, Source& source, Diagnostics& diagnostics) {
  source.name = path;
  const auto refuse = [&](const string& why, const string& remedy = {}) {
    diagnostics.add_unplaced(path, why, remedy);
    return false;
  };
  if (path.find('\0') != string::npos) return refuse("no such file");

  string& text = source.text;
  const auto too_big = [&] {
    return refuse(fmt::format("the file is larger than {} MiB", max_source_bytes >> 20),
                  "many balls of one kind are a group: `groups`");
  };
  const auto complete = [&] {
    if (!has_utf8_form(text))
      return refuse("this is not UTF-8 text (it looks like UTF-16 or UTF-32, or is no text at all)",
                    "save it as UTF-8");
    normalise(text);
    return true;
  };

  if (path == standard_input && from_standard_input()) {
    text = *from_standard_input();
    return text.size() > max_source_bytes ? too_big() : complete();
  }

  const OpenFile file{open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)};
  struct stat info {};
  if (file.fd < 0 || fstat(file.fd, &info) != 0) {
    const int error = errno;
    const bool absent = error == ENOENT || error == ENOTDIR;
    return refuse(absent ? "no such file" : fmt::format("cannot be opened: {}", std::strerror(error)));
  }
  if (S_ISDIR(info.st_mode)) return refuse("this is a folder, not a scene file", "name the scene file in it");
  if (!S_ISREG(info.st_mode)) return refuse("this is not a regular file", "write the scene to a file and name that");

  // The size can change during reading. The limit therefore applies to what was read, not to what fstat returned.
  text.clear();
  if (uint64_t(info.st_size) > max_source_bytes) return too_big();
  text.reserve(size_t(info.st_size) + 8);

  char buffer[1 << 16];
  for (;;) {
    const ssize_t got = read(file.fd, buffer, sizeof buffer);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return refuse(fmt::format("cannot be read: {}", std::strerror(errno)));
    if (got == 0) break;
    text.append(buffer, size_t(got));
    if (text.size() > max_source_bytes) return too_big();
  }
  return complete();
}

string why_no_file(const string& path) {
  struct stat info {};
  if (stat(path.c_str(), &info) == 0) return S_ISREG(info.st_mode) ? "" : "this is not a regular file:";
  if (errno == ENOENT || errno == ENOTDIR) return "there is no file";
  return fmt::format("cannot be inspected ({}):", std::strerror(errno));
}

bool check_text(Source& source, uint32_t index, Diagnostics& diagnostics) {
  string& text = source.text;
  bool can_go_on = true;
  int tab_lines = 0;
  uint64_t brackets = 0;
  int open_brackets = 0;

  // Of this line: only spaces so far, and whether it has a tab already.
  bool indenting = true;
  bool tab_in_line = false;

  for (size_t i = 0; i < text.size();) {
    char32_t code = 0;
    const int length = utf8_length(text, i, code);

    if (length == 0) {
      diagnostics.add(one_byte(index, i),
                      fmt::format("byte 0x{:02X} is not valid UTF-8", static_cast<unsigned char>(text[i])),
                      "save the file as UTF-8");
      return false;
    }

    if (code == '\t') {
      if (!tab_in_line && ++tab_lines <= max_shown_tabs) {
        diagnostics.add(one_byte(index, i), "a tab",
                        "expected spaces: YAML does not allow tabs for indentation, and a scene has none at all");
      }
      tab_in_line = true;
      // The intended indentation is unknown.
      if (indenting) can_go_on = false;
      text[i] = ' ';
    } else if (code == '\n') {
      indenting = true;
      tab_in_line = false;
    } else if (is_control(code)) {
      diagnostics.add({index, uint32_t(i), uint32_t(length)}, fmt::format("control character U+{:04X}", uint32_t(code)),
                      "remove it");
      return false;
    } else if (code != ' ') {
      indenting = false;
    }

    // What costs the parser memory.
    if (code < 0x80 && std::strchr("[]{},:?\"'*&!", int(code)) != nullptr && code != 0) {
      ++brackets;
      if (code == '[' || code == '{') ++open_brackets;
      if ((code == ']' || code == '}') && open_brackets > 0) --open_brackets;

      if (open_brackets > max_open_brackets) {
        diagnostics.add(one_byte(index, i), fmt::format("{} brackets are open here", open_brackets),
                        "expected a scene");
        return false;
      }
      if (brackets > max_brackets) {
        diagnostics.add(one_byte(index, i),
                        fmt::format("more than {} brackets, quotes, commas and colons", max_brackets),
                        "many balls of one kind are a group: `groups`");
        return false;
      }
    }

    i += size_t(length);
  }

  if (tab_lines > max_shown_tabs) {
    diagnostics.add_unplaced(source.name, fmt::format("tabs in {}", how_many(size_t(tab_lines - max_shown_tabs),
                                                                             "more line", "more lines")));
  }
  return can_go_on;
}

}  // namespace carom
