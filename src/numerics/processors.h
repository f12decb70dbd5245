#pragma once
// The processors of this machine, and the share of them that one run takes.

#include "std.h"

namespace carom {

/// The number of processors that this process may use, at least 1.
size_t processors();

/// Divides the processors among `jobs` processes, so that each draws and encodes pictures with its share of threads.
/// It sets LP_NUM_THREADS, which the renderer and OSMesa obey, unless that is set already. Call it before threads
/// exist.
void share_processors(size_t jobs);

/// Lets each run take so many threads, however many processors there are. LP_NUM_THREADS says so too. Call it before
/// threads exist.
void use_threads(size_t count);

/// The threads of one run in this process: those of use_threads(), and otherwise processors() or what
/// share_processors() leaves of them. At least 1.
size_t share_of_processors();

}  // namespace carom
