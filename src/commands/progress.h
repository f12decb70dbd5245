#pragma once
// Progress of a run on stderr: a bar on a terminal, lines in a log, or nothing.
#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

#include "commands/command_line.h"
#include "commands/crowd_ahead.h"

namespace carom {

/// The choice of --progress for this stderr.
ProgressChoice progress_choice(const Options& options);

class Progress {
 public:
  /// `name`: the scene's; `duration`: simulated seconds to go through; `frames`: pictures to come, 0: none.
  Progress(ProgressChoice choice, bool color, std::string name, double duration, std::uint64_t frames);
  ~Progress();  // clears the bar
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Cheap: writes at most ten times a second (bar), or a line at each tenth of the way and after five seconds, but
  /// never two within two seconds.
  void update(double time, std::uint64_t collisions, std::uint64_t frames);
  /// The same for `done` of so many things, such as runs; `more`: a text that follows.
  void update(std::size_t done, std::size_t of, std::string_view things, const std::string& more = "");
  /// The same for other work: the fraction `done`, 0 to 1, and its present step.
  void update(double done, const std::string& what);
  /// A crowd will take more time than what comes before it.
  void expect(const CrowdAhead& crowd) { crowd_ = crowd; }
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
  std::string rate(double count) const;
  double whole_time(double done);
  void show(double done, double left_s, const std::string& counts);
  void draw_bar(double done, const std::string& counts, const std::string& left);

  ProgressChoice choice_;
  bool color_;
  std::string name_;
  double duration_;  // s
  std::uint64_t frames_to_come_;
  CrowdAhead crowd_;
  Clock::time_point start_ = Clock::now(), last_ = start_;
  // What was done at times since the start (s). The pace is that since the first of them.
  struct Milestone {
    double elapsed = 0;
    double done = 0;
  };
  std::deque<Milestone> milestones_{{}};
  int tenth_ = 0;
  bool drawn_ = false;
  std::atomic<double>* shared_ = nullptr;
};

}  // namespace carom
