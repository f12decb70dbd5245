#pragma once
// SIGINT and SIGTERM as a flag that the run loop looks at, so that part files are removed and whole ones stay.

namespace carom {

/// The run was asked to stop by `signal`.
struct Interrupted {
  int signal;
  int exit_code() const { return 128 + signal; }
};

/// From here on the first SIGINT or SIGTERM sets the flag; a second one ends the program at once.
/// Waiting for other programs hears it too. SIGPIPE and SIGXFSZ are ignored: a reader that went away, or a file that
/// may not grow, shows as an error of the write.
void catch_signals();
/// Throws Interrupted if a signal has come.
void stop_if_interrupted();

}  // namespace carom
