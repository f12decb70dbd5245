#pragma once
// The chart beside a film: a curve that grows with the film, on axes that hold all of it. The axes need the whole
// motion first: survey.h takes it.

#include "export/plot_axis.h"
#include "export/timeline.h"
#include "overlay/canvas.h"
#include "overlay/pen.h"
#include "physics/state.h"
#include "render/image.h"
#include "scene/film_layout.h"
#include "std.h"

namespace carom {

struct Scene;

/// What a film's chart shows, as numbers.
class ChartCurves {
 public:
  /// `scene` must outlive this object, and its film has a chart.
  explicit ChartCurves(const Scene& scene);

  struct Curve {
    string name;
    Color color;
  };
  const vector<Curve>& curves() const { return curves_; }
  /// By curve; NaN: of a body that is gone. Only after settle().
  vector<double> values(const State& state) const;

  void take(const State& state);
  /// Chooses what depends on the whole motion: of the momenta of up to 5 bodies and their sum the axis along which they
  /// are greatest. With more bodies the sum is shown, along all axes.
  void settle();

  const vector<double>& times() const { return times_; }          // s
  const vector<vector<double>>& taken() const { return taken_; }  // by time, then by curve
  const string& title() const { return title_; }                  // "momentum along x"
  string_view unit() const { return unit_; }
  bool from_zero() const { return from_zero_; }

 private:
  vector<double> all_values(const State& state) const;

  const Scene& scene_;
  ChartSubject subject_;
  vector<Curve> curves_;
  vector<double> times_;
  vector<vector<double>> taken_;
  string title_;
  string_view unit_;
  bool from_zero_ = true;
  optional<size_t> axis_;  // of momenta, of which all three are taken first
};

class FilmChart {
 public:
  /// `scene` must outlive this object, and its film has a chart.
  explicit FilmChart(const Scene& scene);

  const Scene& scene() const { return scene_; }
  /// When the motion is taken: about two instants a pixel of the chart.
  Ticks instants() const;
  void take(const State& state) { curves_.take(state); }
  /// Fixes the axes, once the whole motion is taken. Throws RenderError.
  void settle();

  /// The film's picture: this one, and the chart until the state's time. Valid until the next call.
  const Image& beside(const Image& picture, const State& state);

 private:
  void draw_axes();
  void draw_curve(size_t curve, const State& state, const vector<double>& now, Canvas& canvas) const;
  void draw_values(const vector<double>& now, Canvas& canvas) const;
  PixelPoint spot_of(double time, double value) const;

  const Scene& scene_;
  FilmLayout layout_;
  Font font_;
  ChartCurves curves_;
  double from_, until_;  // s
  PlotAxis time_axis_, axis_;
  PixelPoint upper_left_, lower_right_;  // of the plot, in the chart
  double head_ = 0;                      // pixels: the first base line
  optional<Canvas> still_;               // all but the curves
  Image whole_;
};

}  // namespace carom
