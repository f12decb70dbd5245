#pragma once
// Progress of a run on stderr: a bar on a terminal, lines in a log, or nothing.
#include <atomic>
#include <chrono>

#include "commands/options.h"
#include "commands/run_pace.h"
#include "std.h"

namespace carom {

class Progress {
 public:
  /// `name`: of what goes on. `shown`: as --progress says; else never.
  Progress(const Options& options, string name, bool shown = true);
  ~Progress();  // clears the bar
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Cheap: writes at most ten times a second (bar), or a line at each tenth of the way and after five seconds, but
  /// never two within two seconds.
  void update(const RunProgress& progress);
  /// The same for `done` of so many things, such as runs; `more`: a text that follows.
  void update(size_t done, size_t of, string_view things, const string& more = "");
  /// The same for other work: the fraction `done`, 0 to 1, and its present step.
  void update(double done, const string& what);
  /// What the run has before it. Call it before the first update of a run.
  void expect(const RunAhead& ahead) { run_.emplace(ahead); }
  /// From here on the fraction done is also stored there, even if nothing is shown. Null: nowhere.
  void share(std::atomic<double>* done) { shared_ = done; }
  /// The first line of a log comes after 1 s, even if nothing is done by then.
  void begin_early();
  /// Clears the bar's line. Call it before writing anything else to the terminal.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool due() const;
  void store(double done);
  string rate(double count) const;
  double elapsed() const;
  double left(double done);
  void show(double done, double left_s, const string& counts);
  void draw_bar(double done, const string& counts, const string& left);

  ProgressChoice choice_;
  bool color_;
  string name_;
  optional<RunPace> run_;
  Clock::time_point start_ = Clock::now(), last_ = start_;
  Pace pace_;  // of all else
  int tenth_ = 0;
  bool drawn_ = false;
  std::atomic<double>* shared_ = nullptr;
};

}  // namespace carom
