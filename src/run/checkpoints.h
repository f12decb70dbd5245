#pragma once
// A run that is simulated for long keeps its state from time to time, between two advances: that of the simulation, of
// the files written so far and of the measures. After an interrupt the same run goes on from there.
#include <chrono>

#include "run/stages.h"
#include "std.h"

namespace carom {

class FlightsFile;

class Checkpoints {
 public:
  /// All must outlive this object.
  Checkpoints(Stages& stages, Simulated& simulated, const RunSettings& settings, const RunWatch& watch);

  /// Whether an interrupted run goes on, and the time (s) to which it has come.
  bool goes_on() const { return stage_ != nullptr && stage_->exports.goes_on(); }
  double begun_at() const { return begun_at_; }
  /// The file that the run also writes its record into. Call it before all that follows.
  void add(FlightsFile& own_record) { own_record_ = &own_record; }

  /// Takes over what the interrupted run has kept. `simulator`: makes that of these steps. Throws ArchiveError where
  /// that is damaged, and removes the checkpoint then.
  void take_over(const function<unique_ptr<Simulator>(const StepChoice&)>& simulator);
  /// Keeps the run, if that is due. Throws ExportError of the run's files; that it cannot be kept is a remark.
  void keep_if_due();
  /// Keeps it once more, if it was kept before.
  void keep_again();
  /// Removes what was kept, but no file of the run.
  void forget();

 private:
  using Clock = std::chrono::steady_clock;

  template <typename Archive>
  void keep_outputs(Archive& archive);
  const char* obstacle() const;
  void keep();
  void say(const string& why);

  Stages& stages_;
  Simulated& simulated_;
  const RunSettings& settings_;
  const RunWatch& watch_;
  Stage* const stage_;  // null: it is never kept
  FlightsFile* own_record_ = nullptr;
  double begun_at_ = 0;
  Clock::time_point kept_ = Clock::now();  // when that was last done or tried
  Clock::duration cost_{};                 // and the time that it took
  bool said_ = false;                      // why it is not kept
};

}  // namespace carom
