#pragma once
// The folders of one run, by show. All shows have the same motion. One that fails leaves the others as they are.
#include <deque>
#include <exception>
#include <mutex>

#include "run/account.h"
#include "run/run_settings.h"
#include "run/stage.h"
#include "std.h"

namespace carom {

/// Whether a run of the scene draws when its motion is over, and not while it is simulated.
bool draws_after_motion(const Scene& scene);

/// What a run has simulated.
struct Simulated {
  EngineChoice engine{};  // with its steps settled
  StoredEnergy start{};   // at time 0
  unique_ptr<Simulator> simulator{};
  double simulate_s = 0;  // wall time

  /// All but the simulator.
  void keep(auto& archive) { archive(engine, start, simulate_s); }
};

class Stages {
 public:
  /// Opens the folder of each show. Throws the failure of a single one, and what `stop_check` throws.
  Stages(span<const Show> shows, const RunSettings& settings, function<void()> stop_check);

  /// Does some work for a show. Its failure is thrown if the show is the only one. Otherwise the show is left out from
  /// here on. Any thread may call it.
  void guarded(size_t show, const function<void()>& work);
  /// The same for each show that has not failed.
  void each(const function<void(Stage&)>& work);
  /// The stages that have not failed, and their shows.
  struct Standing {
    Stage* stage;
    size_t show;
  };
  vector<Standing> standing();
  /// The only one, if it may go on after an interrupt. Null: there are several, or its motion is not simulated.
  Stage* lasting();

  /// What the simulator has to record for all.
  Recording recording() const;
  /// Whether any of them has something to draw.
  bool have_drawings();
  /// Whether any of them draws when the motion is over.
  bool draw_after_motion() const;
  /// Whether any of them cannot plan its pictures before the motion is over.
  bool await_motion() const { return !awaiting_.empty(); }
  /// What such shows need to know when the motion is over: its end, and where films slow down. `motion` makes
  /// simulators of it.
  void take_motion(const optional<RunEnd>& end, const function<unique_ptr<Simulator>()>& motion);
  void begin_drawings();

  /// The pictures of all so far.
  uint64_t pictures() const;
  /// All that they will draw, as far as is known.
  uint64_t planned_pictures() const;
  /// Finishes the folders. Results are in the order of the shows.
  vector<RunResult> finish(const Simulated& done);

 private:
  bool may_last() const;
  void open(size_t show);
  bool has_failed(size_t show);
  vector<Measure> measures_of(const Scene& scene) const;
  void finish(size_t show, const Simulated& done, RunResult& result);
  void take_measures(size_t show, const Simulated& done, RunResult& result) const;

  vector<Show> shows_;
  const RunSettings& settings_;
  const function<void()> stop_check_;
  std::deque<Scene> awaiting_;  // those of shows that wait for the motion
  // By show. It is null, or not used any more, where the show has failed.
  vector<unique_ptr<Stage>> stages_;
  std::mutex failing_;
  vector<std::exception_ptr> failures_;  // by show
};

}  // namespace carom
