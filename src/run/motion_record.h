#pragma once
// A motion simulated once, into a record that can be followed more than once.

#include "engine/engine.h"
#include "files/part_file.h"
#include "run/motion_sink.h"
#include "std.h"

namespace carom {

class FlightsFile;

/// Passes the record of a motion on, until `end` (s).
class RecordSink final : public MotionSink {
 public:
  RecordSink(double end, function<void(const Simulator&)> put) : end_(end), put_(std::move(put)) {}

  bool more() const override { return more_; }
  double time() override { return end_; }
  void record(const Simulator& simulator) override { put_(simulator); }
  void sample(const Sample&) override { more_ = false; }
  void end_at(double time) override { end_ = time; }

 private:
  double end_;
  function<void(const Simulator&)> put_;
  bool more_ = true;
};

/// Passes it on to `file`, which must outlive the sink.
RecordSink record_into(FlightsFile& file, double end);

/// Simulates the scene to its end, with settled steps, and returns a function that makes followers of its record. The
/// record is a file without a name in this place. `scene` must outlive all. Throws SimulationError, ExportError, and
/// what `stop_check` throws.
function<unique_ptr<Simulator>()> recorded_motion(const Scene& scene, const EngineChoice& engine,
                                                  const FilePlace& place, const function<void()>& stop_check);

}  // namespace carom
