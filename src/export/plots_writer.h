#pragma once
// plots/: the charts of a run, drawn at its end.

#include "export/run_charts.h"
#include "export/writer.h"
#include "files/series.h"
#include "std.h"

namespace carom {

class PlotsWriter final : public Writer {
 public:
  /// Throws ExportError, as all functions of this class do.
  PlotsWriter(FolderWriter& folder, const Scene& scene);
  void record(span<const Collision> collisions) override;
  void add(double time, const State& state, span<const ContactForce> contacts) override;
  vector<OutputFile*> files() override;
  vector<FileRecord> published() const override { return series_.records(); }

  void keep(StateWriter& archive) override { archive(charts_); }
  void keep(StateReader& archive) override { archive(charts_); }

  /// The instants at which states are added.
  static vector<Ticks> ticks(const Scene& scene);

 private:
  string gnuplot_;
  RunCharts charts_;
  Series series_;
};

}  // namespace carom
