#pragma once
// A motion seen by the cameras that frame it, and taken by charts, before anything is drawn.

#include "export/timeline.h"
#include "render/camera_fit.h"
#include "render/moving_camera.h"
#include "run/film_chart.h"
#include "run/motion_sink.h"
#include "std.h"

namespace carom {

/// A sink with streams of instants.
class Surveying : public MotionSink {
 public:
  bool any() const { return end_ >= 0; }
  bool more() const override { return more_; }
  double time() override { return timeline_.time(); }
  void end_at(double time) override { timeline_.end_at(time); }

 protected:
  /// `duration`: of the motion (s).
  explicit Surveying(double duration) : timeline_(duration) {}
  /// Adds a stream. The number of it.
  int add(const Ticks& ticks);
  bool due(int stream) const { return timeline_.due(stream).has_value(); }
  void advance();

 private:
  Timeline timeline_;
  double end_ = -1;    // s: the last instant; less than 0: there is none
  bool more_ = false;  // whether a next instant exists
};

/// Collects a motion at evenly spaced instants of the time that each camera's scene shows, and its collisions. Cameras
/// of another kind are left as they are.
class Framing final : public Surveying {
 public:
  /// All scenes have the motion. The cameras must outlive this object.
  explicit Framing(span<MovingCamera* const> cameras);

  /// Gives each camera the view of what was collected.
  void finish();

  void record(const Simulator& simulator) override;
  void sample(const Sample& at) override;

 private:
  /// The cameras of one scene, which all go by the same instants.
  struct Framed {
    const Scene* scene;
    MotionSamples samples;
    int stream;
    vector<MovingCamera*> cameras;
  };

  vector<Framed> framed_;
};

/// Gives charts a motion at their instants.
class Charting final : public Surveying {
 public:
  /// All scenes have the motion. The charts must outlive this object.
  explicit Charting(span<FilmChart* const> charts);

  /// Fixes the charts' axes.
  void finish();

  void record(const Simulator&) override {}
  void sample(const Sample& at) override;

 private:
  vector<FilmChart*> charts_;
  vector<int> streams_;  // by chart
};

/// Carries the simulator, which is at time 0, over these instants, and frames the motion and fixes the charts. A
/// simulation that fails counts as far as it goes: the run itself fails there again. `stop_check` is called often, and
/// may throw.
void survey(span<MovingCamera* const> cameras, Simulator& simulator, const function<void()>& stop_check,
            span<FilmChart* const> charts = {});

}  // namespace carom
