// A simulation is extrapolated with what is known of the crowd to come, drawing by its pictures. While the motion is
// simulated first, the time of drawing is a guess from the pictures' sizes.
#include "commands/run_pace.h"

#include <fmt/format.h>

#include "commands/text.h"
#include "std.h"

namespace carom {
namespace {

/// A phase that has taken less (s) says too little about the time to come.
constexpr double first_seconds = 3;

}  // namespace

void Pace::note(double elapsed, double done) {
  while (milestones_.size() > 2 && milestones_[1].elapsed <= elapsed * 2 / 3) milestones_.pop_front();
  milestones_.push_back({elapsed, done});
}

double Pace::rate() const {
  const Milestone& last = milestones_.back();
  Milestone from = milestones_.front();
  if (!(last.done > from.done)) from = {};
  const double time = last.elapsed - from.elapsed;
  const double work = last.done - from.done;
  return work > 0 && time > 0 ? time / work : infinity;
}

void RunPace::note(double elapsed, const RunProgress& progress) {
  if (progress.phase != now_.phase) phase_from_ = elapsed;
  now_ = progress;
  elapsed_ = elapsed;

  using Phase = RunProgress::Phase;
  const double in_phase = elapsed - phase_from_;
  switch (progress.phase) {
    case Phase::settling:
      left_ = infinity;
      break;

    case Phase::simulating:
      simulating_.note(in_phase, progress.time - progress.begun_at);
      if (!ahead_.draws_after) drawing_.note(in_phase, double(progress.pictures));
      left_ = ahead_.draws_after ? simulation_left() + ahead_.draw_s : max(simulation_left(), drawing_left());
      break;

    case Phase::drawing:
      if (progress.planned > 0) ahead_.pictures = progress.planned;
      drawing_.note(ahead_.draws_after ? in_phase : elapsed, double(progress.pictures));
      left_ = drawing_left();
      break;
    case Phase::writing:
      left_ = 0;
      break;
  }

  if (isfinite(left_) && elapsed > 0) share_ = max(share_, elapsed / (elapsed + left_));
}

double RunPace::simulation_left() {
  const double rate = simulating_.rate();
  if (!isfinite(rate)) return ahead_.duration > 0 ? rate : 0;
  return time_ahead(ahead_.crowd, now_.time, max(ahead_.duration, now_.time), rate);
}

/// By its pace, or by the guess while there is none.
double RunPace::drawing_left() {
  const double rate = drawing_.rate();
  const auto to_come = double(ahead_.pictures - min(now_.pictures, ahead_.pictures));
  return isfinite(rate) ? to_come * rate : ahead_.draw_s;
}

double RunPace::left() const {
  const bool early = elapsed_ - phase_from_ < first_seconds;
  return early || !isfinite(left_) ? numeric_limits<double>::quiet_NaN() : left_;
}

string RunPace::text() const {
  using Phase = RunProgress::Phase;
  const string pictures = fmt::format("{} of {}", grouped(now_.pictures), grouped(ahead_.pictures));

  switch (now_.phase) {
    case Phase::settling:
      return "finding the steps for the tolerance";
    case Phase::simulating:
      return fmt::format("simulating {:.4g} of {:.4g} s{}, {}", now_.time, ahead_.duration,
                         !ahead_.draws_after && ahead_.pictures > 0 ? ", drawing " + pictures : "",
                         counted(now_.collisions, "collision", "collisions"));

    case Phase::drawing:
      return ahead_.pictures > 0 ? "drawing " + pictures : "drawing";
    case Phase::writing:
      break;
  }
  return "writing files";
}

}  // namespace carom
