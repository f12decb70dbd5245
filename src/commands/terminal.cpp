// Escapes control characters in every text that is written. Names and messages may come from hostile files.
#include "commands/terminal.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <initializer_list>

#include "std.h"
#include "yaml/letters.h"
#include "yaml/printable.h"

namespace carom {

namespace {

int output_error = 0;  // errno of the first write to stdout that failed

bool set_and_not_empty(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

}  // namespace

bool is_terminal(int descriptor) {
  return isatty(descriptor) == 1;
}

size_t terminal_width(int descriptor) {
  winsize size{};
  if (is_terminal(descriptor) && ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col >= 20) return size.ws_col;
  return is_terminal(descriptor) ? 80 : 100;
}

bool uses_color(ColorChoice choice, int descriptor) {
  if (choice != ColorChoice::automatic) return choice == ColorChoice::always;
  const char* term = std::getenv("TERM");
  const bool dumb = term != nullptr && std::strcmp(term, "dumb") == 0;
  return is_terminal(descriptor) && !dumb && !set_and_not_empty("NO_COLOR");
}

Palette::Palette(bool color) {
  if (!color) return;
  bold = "\x1b[1m";
  dim = "\x1b[2m";
  red = "\x1b[1;31m";
  green = "\x1b[32m";
  yellow = "\x1b[33m";
  reset = "\x1b[0m";
}

namespace {

/// Length of the escape sequence at the front of `text`, if it is one of Palette's or of a diagnostic's; else 0.
size_t own_sequence(string_view text) {
  for (const string_view own : {"\x1b[0m", "\x1b[1m", "\x1b[2m", "\x1b[32m", "\x1b[33m", "\x1b[1;31m", "\x1b[1;32m"})
    if (text.starts_with(own)) return own.size();
  return 0;
}

/// Escapes control characters that came into `text` from files and names. Line ends, tabs and the program's own colours
/// stay.
string harmless(string_view text) {
  string result;
  result.reserve(text.size());
  for (size_t i = 0; i < text.size();) {
    size_t plain = i;
    while (plain < text.size() && text[plain] >= ' ' && text[plain] < 0x7F) ++plain;
    result += text.substr(i, plain - i);
    i = plain;
    if (i == text.size()) break;

    size_t length = text[i] == '\n' || text[i] == '\t' ? 1 : own_sequence(text.substr(i));
    if (length > 0) {
      result += text.substr(i, length);
    } else {
      char32_t code = 0;
      length = size_t(max(utf8_length(text, i, code), 1));
      result += printable(text.substr(i, length));
    }
    i += length;
  }
  return result;
}

void write_raw(string_view text, std::FILE* stream) {
  const bool whole = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
  if (!whole && stream == stdout && output_error == 0) output_error = errno;
}

}  // namespace

void write_out(string_view text) {
  write_raw(harmless(text), stdout);
}

void write_err(string_view text) {
  write_raw(harmless(text), stderr);
  std::fflush(stderr);
}

void draw_line(string_view text) {
  write_raw("\r" + harmless(text) + "\x1b[K", stderr);
  std::fflush(stderr);
}

void hold_standard_descriptors() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    // Read-only, so that writing to a closed stdout still fails and is reported. The lowest free descriptor is
    // `descriptor`.
    if (open("/dev/null", descriptor == STDERR_FILENO ? O_WRONLY : O_RDONLY) < 0) return;
  }
}

void flush_out() {
  if (std::fflush(stdout) != 0 && output_error == 0) output_error = errno;
}

bool finish_output(string& reason) {
  flush_out();
  if (output_error != 0) reason = std::strerror(output_error);
  return output_error == 0;
}

}  // namespace carom
