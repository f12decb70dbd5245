#pragma once
// The script from which gnuplot draws a plot.
#include <string>

#include "export/plot.h"

namespace carom {

/// `terminal`: the arguments of gnuplot's `set terminal`.
std::string plot_script(const Plot& plot, const std::string& terminal);

}  // namespace carom
