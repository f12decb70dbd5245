#pragma once
// What takes a motion as it goes: the record of all that happens, and the state at instants of its own.

#include "simulate/simulator.h"
#include "std.h"

namespace carom {

/// A simulator at an instant.
struct Sample {
  Simulator& simulator;
  const State* before = nullptr;  // where the simulator has gone through what happens at its instant, the state before

  const State& state() const { return before != nullptr ? *before : simulator.state(); }
};

class MotionSink {
 public:
  virtual ~MotionSink() = default;
  /// Whether a further instant exists.
  virtual bool more() const = 0;
  /// The next instant (s).
  virtual double time() = 0;
  /// Takes what the simulator has recorded since its last advance.
  virtual void record(const Simulator& simulator) = 0;
  /// Whether the next sample takes forces of contacts, which count from an instant on: after all that happens then.
  virtual bool needs_contacts() const { return false; }
  /// Takes the state at the next instant, which must be the simulator's time. Throws ExportError, RenderError.
  virtual void sample(const Sample& at) = 0;
  /// Ends the instants at `time` (s), the run's end, which is after all instants that are done. Throws ExportError.
  virtual void end_at(double time) = 0;
};

/// Functions called between advances of a simulator. `stop_check` may throw.
struct CarryWatch {
  function<void()> stop_check;
  function<void()> advanced = [] {};
  double* advance_s = nullptr;  // wall time of advances is added to it
  bool goes_on = false;         // the sinks have taken what the simulator has recorded so far
};

/// Calls a function for a sink, by its number, and does what a failure means. It may leave sinks out.
using SinkGuard = function<void(size_t sink, const function<void()>& work)>;

/// The guard of sinks whose failures are not told apart.
inline void unguarded(size_t, const function<void()>& work) {
  work();
}

/// Carries a simulator, which is at time 0 unless it goes on, through all instants of these sinks.
/// `duration`: of the motion (s). Throws SimulationError, also if the simulator makes no progress, and what the
/// functions throw.
void carry_through(Simulator& simulator, span<MotionSink* const> sinks, double duration, const SinkGuard& guard,
                   const CarryWatch& watch);

}  // namespace carom
