#pragma once
// The script from which gnuplot draws a plot.
#include <string>

#include "export/plot.h"

namespace carom {

/// gnuplot's `set terminal` must precede it.
std::string plot_script(const Plot& plot);

}  // namespace carom
