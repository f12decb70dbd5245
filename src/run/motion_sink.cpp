// Advances in slices, so that signals and progress are handled where no output is due for long. Sampling changes
// nothing in the simulator, so the slices do not change the motion by a bit.
#include "run/motion_sink.h"

#include "run/stopwatch.h"
#include "std.h"

namespace carom {
namespace {

class Carrying {
 public:
  Carrying(Simulator& simulator, span<MotionSink* const> sinks, double duration, const SinkGuard& guard,
           const CarryWatch& watch)
      : simulator_(simulator), sinks_(sinks.begin(), sinks.end()), duration_(duration), guard_(guard), watch_(watch) {}

  void go() {
    if (!watch_.goes_on) record();
    while (const optional<double> time = next_instant()) {
      carry_to(*time);
      if (const optional<RunEnd>& end = simulator_.tally().end; end && !ended_ && !(*time < end->time)) {
        ended_ = true;
        each([&](MotionSink& sink) { sink.end_at(end->time); });
        continue;
      }
      sample(*time);
    }
  }

 private:
  /// At time 0 the state is the one before all that happens then, and the forces of contacts are those after it.
  void sample(double time) {
    const bool is_first = simulator_.time() == 0;
    bool waits = false;
    each([&](MotionSink& sink) {
      if (!sink.more() || time < sink.time()) return;
      if (is_first && sink.needs_contacts()) {
        waits = true;
      } else {
        sink.sample({simulator_});
      }
    });
    if (!waits) return;

    const State before = simulator_.state();
    uint64_t events = 0;
    do {
      events = simulator_.effort().events;
      advance_to(0);
      record();
    } while (simulator_.effort().events != events);

    each([&](MotionSink& sink) {
      if (sink.more() && sink.time() <= time) sink.sample({simulator_, &before});
    });
  }

  template <typename Work>
  void each(const Work& work) const {
    for (size_t i = 0; i < sinks_.size(); ++i) guard_(i, [&] { work(*sinks_[i]); });
  }

  optional<double> next_instant() const {
    optional<double> next;
    each([&](MotionSink& sink) {
      if (sink.more()) next = min(next.value_or(sink.time()), sink.time());
    });
    return next;
  }

  void carry_to(double time) {
    const double slice = duration_ / 1000;
    watch_.stop_check();
    while (simulator_.time() < time && !is_over()) {
      const double before = simulator_.time();
      const uint64_t collisions_before = simulator_.tally().collisions();

      // Multiples of the slice, so that round instants stay round.
      double slices = floor(before / slice) + 1;
      if (!(slices * slice > before)) ++slices;
      const double next = min(time, slices * slice);
      advance_to(next > before ? next : time);

      if (!record() && !(simulator_.time() > before) && simulator_.tally().collisions() == collisions_before &&
          !is_over())
        throw SimulationError("the simulator makes no progress");
      watch_.stop_check();
      watch_.advanced();
    }
  }

  void advance_to(double time) {
    double ignored = 0;
    const Stopwatch stopwatch(watch_.advance_s != nullptr ? *watch_.advance_s : ignored);
    simulator_.advance_to(time);
  }

  /// Whether the run has ended before its duration.
  bool is_over() const {
    const optional<RunEnd>& end = simulator_.tally().end;
    return end && !(simulator_.time() < end->time);
  }

  /// Returns whether there was anything to record.
  bool record() {
    if (simulator_.collisions().empty() && simulator_.paths().empty() && simulator_.crossings().empty()) return false;
    each([&](MotionSink& sink) { sink.record(simulator_); });
    return true;
  }

  Simulator& simulator_;
  const vector<MotionSink*> sinks_;
  const double duration_;
  const SinkGuard& guard_;
  const CarryWatch& watch_;
  bool ended_ = false;
};

}  // namespace

void carry_through(Simulator& simulator, span<MotionSink* const> sinks, double duration, const SinkGuard& guard,
                   const CarryWatch& watch) {
  Carrying(simulator, sinks, duration, guard, watch).go();
}

}  // namespace carom
