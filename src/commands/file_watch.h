#pragma once
// Waits for changes of files, however an editor writes them: in place, or as another file that is then renamed.

#include "std.h"

namespace carom {

class FileWatch {
 public:
  /// Watches these files instead of those before. Changes since the last call count for files that stay.
  void follow(const set<string>& files);

  /// Waits until files have changed, appeared or disappeared, and all have then been left alone for a tenth of a
  /// second. Returns them. `stop_check`: called often, may throw.
  set<string> changed(const function<void()>& stop_check);

 private:
  /// What changes whenever a file is written or replaced. All 0: there is no such file.
  struct Stamp {
    uint64_t file = 0, bytes = 0, changed_ns = 0;
    friend bool operator==(const Stamp&, const Stamp&) = default;
  };
  static Stamp stamp_of(const string& file);

  map<string, Stamp> stamps_;  // by file
};

}  // namespace carom
