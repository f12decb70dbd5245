#pragma once
// The processors of this machine, and the share of them that one run takes.
#include <cstddef>

namespace carom {

/// The number of processors that this process may use, at least 1.
std::size_t processors();

/// Divides the processors among `jobs` processes, so that each draws and encodes pictures with its share of threads.
/// It sets LP_NUM_THREADS, which the renderer and OSMesa obey, unless that is set already. Call it before threads
/// exist.
void share_processors(std::size_t jobs);

/// The share of this process: processors(), unless share_processors() has divided them. At least 1.
std::size_t share_of_processors();

}  // namespace carom
