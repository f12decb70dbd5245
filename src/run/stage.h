#pragma once
// One output folder during a run: its exports, and the two sinks of the motion that fill them.

#include "export/exports.h"
#include "overlay/history.h"
#include "render/moving_camera.h"
#include "run/measuring.h"
#include "run/motion_sink.h"
#include "run/picture_series.h"
#include "std.h"

namespace carom {

struct Manifest;
struct Scene;

/// What to show of a motion, and the folder for it.
/// Scenes that share a motion differ only in their pictures and outputs.
struct Show {
  const Scene* scene = nullptr;
  string folder;
  /// Wall time of loading the scene, for the manifest.
  double load_s = 0;
  /// The manifest of the run in the folder, if only its pictures are replaced (exports.h).
  const Manifest* renewed = nullptr;
  SceneOrigin origin{};  // for the manifest
};

/// The tables and measures of a folder.
class TableSink final : public MotionSink {
 public:
  TableSink(OutputPart& part, Measuring& measuring);

  bool more() const override { return more_; }
  double time() override { return part_.timeline().time(); }
  bool needs_contacts() const override { return part_.needs_contacts(); }
  void record(const Simulator& simulator) override;
  void sample(const Sample& at) override;
  void end_at(double time) override { part_.timeline().end_at(time); }

  double export_s() const { return export_s_; }  // wall time

  void keep(auto& archive) { archive(more_, export_s_); }

 private:
  OutputPart& part_;
  Measuring& measuring_;
  bool more_ = false;  // whether a next instant exists
  double export_s_ = 0;
};

/// The pictures of a folder, and other drawings.
class DrawingSink final : public MotionSink {
 public:
  /// Opens the drawings of `exports`. `run`: the name of the folder. All must outlive this object. `stop_check` is
  /// called between pictures, and may throw.
  DrawingSink(const Scene& scene, Exports& exports, const string& run, MovingCamera& of_model,
              function<void()> stop_check);
  DrawingSink(const DrawingSink&) = delete;
  DrawingSink& operator=(const DrawingSink&) = delete;

  /// The cameras of what is drawn. Those that frame the motion must have been given it before the first sample.
  vector<MovingCamera*> cameras();

  /// The charts beside pictures, for which the same holds.
  vector<FilmChart*> charts();

  bool more() const override { return more_; }
  double time() override;
  void record(const Simulator& simulator) override;
  void sample(const Sample& at) override;
  void end_at(double time) override;

  /// Counts a time (s) as spent on pictures.
  void count(double seconds) { render_s_ += seconds; }
  double render_s() const { return render_s_; }  // wall times
  double export_s() const { return export_s_; }

 private:
  OutputPart& part() { return exports_.drawings(); }
  void aim();
  bool is_picture_due(size_t stream);
  bool needs_state(double time);
  void expose(size_t stream, const State& state);
  void draw(size_t stream, const Sample& at);
  void begin_with_title(const Image& first);

  const Scene& scene_;
  Exports& exports_;
  MovingCamera& of_model_;
  const function<void()> stop_check_;
  History history_;
  vector<PictureSeries> series_;  // by picture stream
  bool more_ = false;             // whether a next instant exists
  double render_s_ = 0, export_s_ = 0;
};

struct Stage {
  /// Opens the folder, and takes these measures. `request`: as for Exports. Throws ExportError, RenderError,
  /// ArchiveError.
  Stage(const Show& show, Durability durability, vector<Measure> measures, function<string()> request = {});
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  /// Opens what is drawn, now that all is known that it waits for.
  void begin_drawings(function<void()> stop_check);
  RunFacts facts() const;

  /// What is written and measured so far.
  void keep(auto& archive) { archive(exports.tables(), measuring, tables); }

  const Scene& scene;
  const string run;       // the folder's name
  RunFacts loaded;        // what is known before the run
  MovingCamera of_model;  // of gltf
  Measuring measuring;
  Exports exports;
  TableSink tables;
  optional<DrawingSink> drawings;
};

}  // namespace carom
