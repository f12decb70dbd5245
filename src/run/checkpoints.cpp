// The part of each class is its list `keep` (physics/archive.h).
#include "run/checkpoints.h"

#include <fmt/format.h>

#include <new>

#include "export/flights_file.h"
#include "physics/archive.h"
#include "scene/engines.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

Checkpoints::Checkpoints(Stages& stages, Simulated& simulated, const RunSettings& settings, const RunWatch& watch)
    : stages_(stages), simulated_(simulated), settings_(settings), watch_(watch), stage_(stages.lasting()) {
  if (stage_ != nullptr && stage_->exports.replaces_interrupted())
    watch.remark("begins anew: the interrupted run in its folder was of another request or program");
}

template <typename Archive>
void Checkpoints::keep_outputs(Archive& archive) {
  archive(*stage_);
  if (own_record_ != nullptr) own_record_->keep(archive);
}

void Checkpoints::take_over(const function<unique_ptr<Simulator>(const StepChoice&)>& simulator) {
  const Checkpoint checkpoint = stage_->exports.take_interrupted();
  begun_at_ = checkpoint.time;
  try {
    StateReader archive(checkpoint.outputs, stage_->scene.world);
    archive(simulated_);
    keep_outputs(archive);
    archive.finish();
    simulated_.simulator = simulator(simulated_.engine.steps);
    simulated_.simulator->restore(checkpoint.simulator);
  } catch (const ArchiveError&) {
    forget();
    throw;
  }

  const double duration = stage_->scene.simulate.duration;
  const bool moves = begun_at_ < duration && !simulated_.simulator->tally().end;
  watch_.remark(moves ? fmt::format("goes on at {:.4g} of {:.4g} s", begun_at_, duration)
                      : "goes on with what is left to draw and to write");
}

/// Why the run cannot be kept. Null: it can.
const char* Checkpoints::obstacle() const {
  const FlightsFile* const record = own_record_ != nullptr ? own_record_ : stage_->exports.flights();
  if (!stages_.have_drawings() || (record != nullptr && record->is_there())) return nullptr;
  if (record != nullptr) return "its pictures need its flights, which have become too large";
  const Scene& scene = stage_->scene;
  return goes_along_parabolas(scene.world, scene.simulate) ? "its pictures need flights among its outputs"
                                                           : "its pictures need a camera that frames the motion";
}

void Checkpoints::keep() {
  const Clock::time_point start = Clock::now();
  // An error of a file is the run's.
  StateWriter outputs;
  outputs(simulated_);
  keep_outputs(outputs);

  try {
    const Simulator& simulator = *simulated_.simulator;
    stage_->exports.keep({simulator.time(), stage_->loaded.origin, outputs.take(), simulated_.simulator->save()});
  } catch (const ExportError& error) {
    say(error.what());
  } catch (const std::bad_alloc&) {
    say("there is not enough memory");
  }
  kept_ = Clock::now();
  cost_ = kept_ - start;
}

void Checkpoints::keep_if_due() {
  // Keeping takes at most half of the time.
  const std::chrono::duration<double> interval(settings_.checkpoint_s);
  if (stage_ == nullptr || Clock::now() - kept_ < max<std::chrono::duration<double>>(interval, cost_)) return;
  const char* const why = obstacle();
  if (why == nullptr) return keep();
  say(why);
  forget();
  kept_ = Clock::now();
}

void Checkpoints::keep_again() {
  if (stage_ != nullptr && stage_->exports.is_kept() && obstacle() == nullptr) keep();
}

void Checkpoints::forget() {
  if (stage_ != nullptr) stage_->exports.forget();
}

/// Why the run is not kept, once.
void Checkpoints::say(const string& why) {
  if (!exchange(said_, true)) watch_.remark(fmt::format("cannot go on after an interrupt: {}", why));
}

}  // namespace carom
