#pragma once
// The real program as a subprocess, in its own folder.
#include <chrono>

#include "std.h"

namespace carom::testing {

struct Finished {
  int code = -1;  // exit code; 1000 + signal if a signal ended it
  string out, err;
};

/// A fresh folder for a test's commands; removed at the end.
class Workplace {
 public:
  Workplace();
  ~Workplace();
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  void write(const string& name, const string& text) const;
  string read(const string& name) const;  // empty if it is not there
  bool has(const string& name) const;
  /// Every file below `name`, by path: its bytes.
  map<string, string> files(const string& name = ".") const;
  string path(const string& name) const { return folder_ + "/" + name; }

  /// Runs `carom words...` here, stdin empty, stdout and stderr files, NO_COLOR not set.
  Finished carom(const vector<string>& words) const;
  /// The same by a shell, "$CAROM" being the program.
  Finished shell(const string& command) const;
  /// Starts the program, sends `signal` as soon as the file or folder `sign` is there, and waits.
  Finished interrupted(const vector<string>& words, const string& sign, int signal) const;
  /// Starts the program, sends `signal` after this time, and waits.
  Finished interrupted_after(const vector<string>& words, std::chrono::milliseconds time, int signal) const;

 private:
  int start(const vector<string>& words) const;
  Finished finish(int process) const;
  string folder_;
};

/// The same files without the run's own manifest, which has times.
inline map<string, string> without_manifest(map<string, string> files) {
  files.erase("manifest.json");
  return files;
}

const string tables = "output: {trajectory: {every: 0.1}, collisions: true, energy: {every: 0.1}}\n";

/// Two balls that meet at 0.4472... s, small enough for any test. `more`: further top-level lines.
string two_balls(const string& more = tables);

}  // namespace carom::testing
