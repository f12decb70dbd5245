#pragma once
// How far a run is, and how much time it will still take: by phases, from the pace of each.
#include <deque>

#include "commands/crowd_ahead.h"
#include "run/run_scene.h"
#include "std.h"

namespace carom {

/// What a run has before it.
struct RunAhead {
  double duration = 0;    // s of motion
  uint64_t pictures = 0;  // of frames and video
  CrowdAhead crowd{};
  double draw_s = 0;         // s, a guess of the wall time of drawing and writing
  bool draws_after = false;  // drawing begins when the motion is over
};

/// The time that work takes, from what is done of it at some times.
class Pace {
 public:
  /// At `elapsed` (s) since the work's start this much is done.
  void note(double elapsed, double done);
  /// The time (s) for a unit of the work, at the pace of the last third of the time so far. Infinite: it is unknown.
  double rate() const;

 private:
  struct Milestone {
    double elapsed = 0, done = 0;
  };
  std::deque<Milestone> milestones_{{}};
};

class RunPace {
 public:
  explicit RunPace(const RunAhead& ahead) : ahead_(ahead) {}

  /// Takes the progress at `elapsed` (s) since the run's start.
  void note(double elapsed, const RunProgress& progress);

  /// The part of the run that is done, 0 to 1. It never falls.
  double share() const { return share_; }
  /// The time to come (s). Not a number: it is unknown, as in the first seconds of a phase.
  double left() const;
  /// "simulating 0.41 of 3 s", "drawing 23 of 91".
  string text() const;

 private:
  double simulation_left();
  double drawing_left();

  RunAhead ahead_;
  RunProgress now_{RunProgress::Phase::settling};
  double elapsed_ = 0, phase_from_ = 0;  // s
  Pace simulating_, drawing_;
  double share_ = 0, left_ = 0;
};

}  // namespace carom
