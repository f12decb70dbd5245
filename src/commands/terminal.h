#pragma once
// Writes to stdout and stderr, terminals or not.

#include "std.h"

namespace carom {

enum class ColorChoice { automatic, always, never };

bool is_terminal(int descriptor);
/// Columns of the terminal at `descriptor`; 100 where there is none.
size_t terminal_width(int descriptor);
/// Colour is for terminals. A NO_COLOR that is set and not empty, or TERM=dumb, forbids it, unless `choice` is
/// `always`.
bool uses_color(ColorChoice choice, int descriptor);

/// Escape sequences, all empty without colour.
struct Palette {
  explicit Palette(bool color);
  string_view bold, dim, red, green, yellow, reset;
};

/// Writes text to stdout or stderr; all text to a terminal passes here. Unprintable characters from files and names are
/// escaped (yaml/printable.h), except line ends, tabs and Palette's sequences. A JSON text keeps its meaning. A failure
/// is kept for finish_output().
void write_out(string_view text);
void write_err(string_view text);
/// On stderr, a terminal: replaces the cursor's line by `text`.
void draw_line(string_view text);

/// Opens descriptors 0, 1, 2 if the caller closed them, so that no data file gets one of these numbers.
void hold_standard_descriptors();
/// Flushes stdout; keeps a failure for finish_output().
void flush_out();
/// Flushes stdout. False, with `reason`, if something written to it was lost.
bool finish_output(string& reason);

}  // namespace carom
