#pragma once
// The threads that llvmpipe draws with. Where it cannot start one of them it waits for it for ever: so they are asked
// for before it asks, and counted before anything is drawn.

namespace carom::gl {

/// Chooses, by LP_NUM_THREADS, how many threads llvmpipe will start: those of the environment, or as many as there are
/// processors; 0, and the caller draws, where the system has not so many. To be called before the first context is
/// made.
void choose_threads();

/// Throws RenderError if the threads that choose_threads() chose have not come about; then nothing may be drawn.
void check_threads();

}  // namespace carom::gl
