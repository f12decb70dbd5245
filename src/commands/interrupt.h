#pragma once
// SIGINT and SIGTERM as a flag that the run loop checks, so that part files are removed and whole ones stay.

namespace carom {

/// `signal` stops the run.
struct Interrupted {
  int signal;
  int exit_code() const { return 128 + signal; }
};

/// From here on the first SIGINT or SIGTERM sets the flag; a second one ends the program at once.
/// Waits for other programs check the flag too. SIGPIPE and SIGXFSZ are ignored: a closed pipe or a file at its limit
/// then makes the write fail.
void catch_signals();
/// Throws Interrupted if a signal has come.
void stop_if_interrupted();

}  // namespace carom
