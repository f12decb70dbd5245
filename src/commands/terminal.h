#pragma once
// What stands at the other end of stdout and stderr, and how to write to it.
#include <cstddef>
#include <string>
#include <string_view>

namespace carom {

enum class ColorChoice { automatic, always, never };

bool is_terminal(int descriptor);
/// Columns of the terminal at `descriptor`; 100 where there is none.
std::size_t terminal_width(int descriptor);
/// Colour is for terminals; a NO_COLOR that is set and not empty, or TERM=dumb, forbids it unless asked for by
/// `always`.
bool wants_color(ColorChoice choice, int descriptor);

/// Escape sequences, all empty where colour is not wanted.
struct Palette {
  explicit Palette(bool color);
  std::string_view bold, dim, red, green, yellow, reset;
};

/// Whole text to stdout or stderr: the one place where text meets a terminal. Whatever it has from files and names,
/// unprintable characters are escaped (yaml/printable.h), but for line ends, tabs and Palette's sequences; a JSON text
/// keeps its meaning. A failure is kept for finish_output().
void write_out(std::string_view text);
void write_err(std::string_view text);
/// To stderr, a terminal: `text` in place of the line that the cursor is in.
void draw_line(std::string_view text);

/// Gives descriptors 0, 1, 2 something to stand for if the caller closed them, so that no data file becomes one of
/// them.
void hold_standard_descriptors();
/// What was written so far is to be seen now.
void flush_out();
/// Flushes stdout. False, with `reason`, if something written to it was lost.
bool finish_output(std::string& reason);

}  // namespace carom
