#pragma once
// The threads that llvmpipe draws with. If it cannot start one of them, it waits for ever.
// Their number is therefore tested before llvmpipe starts them, and they are counted before anything is drawn.

namespace carom::gl {

/// Chooses the number of threads that llvmpipe will start, and sets LP_NUM_THREADS to it. It is the value in the
/// environment, or the number of processors. It is 0, and the caller draws, where the system cannot provide so many.
/// Call this before the first context is made.
void choose_threads();

/// Throws RenderError if the threads of choose_threads() have not started. Nothing may then be drawn.
void check_threads();

}  // namespace carom::gl
