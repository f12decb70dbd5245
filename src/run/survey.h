#pragma once
// A motion seen by the cameras that frame it, and taken by charts, before anything is drawn.

#include "export/timeline.h"
#include "render/camera_fit.h"
#include "render/moving_camera.h"
#include "run/film_chart.h"
#include "run/motion_sink.h"
#include "std.h"

namespace carom {

/// Collects a motion at evenly spaced instants of the time that each camera's scene shows, and its collisions. Cameras
/// of another kind are left as they are.
class Framing final : public MotionSink {
 public:
  /// All scenes have the motion. The cameras must outlive this object.
  explicit Framing(span<MovingCamera* const> cameras);

  bool any() const { return !framed_.empty(); }
  /// Gives each camera the view of what was collected.
  void finish();

  bool more() const override { return more_; }
  double time() override { return timeline_.time(); }
  void record(const Simulator& simulator) override;
  void sample(Simulator& simulator) override;
  void end_at(double time) override { timeline_.end_at(time); }

 private:
  /// The cameras of one scene, which all go by the same instants.
  struct Framed {
    const Scene* scene;
    MotionSamples samples;
    int stream;  // of the timeline
    vector<MovingCamera*> cameras;
  };
  void advance();

  vector<Framed> framed_;
  Timeline timeline_;
  double end_ = 0;     // s: the last instant that is shown
  bool more_ = false;  // whether a next instant exists
};

/// Gives charts a motion at their instants.
class Charting final : public MotionSink {
 public:
  /// All scenes have the motion. The charts must outlive this object.
  explicit Charting(span<FilmChart* const> charts);

  bool any() const { return !charts_.empty(); }
  /// Fixes the charts' axes.
  void finish();

  bool more() const override { return more_; }
  double time() override { return timeline_.time(); }
  void record(const Simulator&) override {}
  void sample(Simulator& simulator) override;
  void end_at(double time) override { timeline_.end_at(time); }

 private:
  void advance();

  vector<FilmChart*> charts_;
  Timeline timeline_;
  vector<int> streams_;  // of the timeline, by chart
  double end_ = 0;       // s: the last instant of a chart
  bool more_ = false;    // whether a next instant exists
};

/// Carries the simulator, which is at time 0, over these instants, and frames the motion and fixes the charts. A
/// simulation that fails counts as far as it goes: the run itself fails there again. `stop_check` is called often, and
/// may throw.
void survey(span<MovingCamera* const> cameras, Simulator& simulator, const function<void()>& stop_check,
            span<FilmChart* const> charts = {});

}  // namespace carom
