#pragma once
// The script from which gnuplot draws a plot.

#include "export/plot.h"
#include "std.h"

namespace carom {

/// gnuplot's `set terminal` must precede it.
string plot_script(const Plot& plot);

}  // namespace carom
