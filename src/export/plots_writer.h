#pragma once
// plots/: the charts of a run, drawn at its end.
#include <string>
#include <vector>

#include "export/run_charts.h"
#include "export/writer.h"
#include "files/series.h"

namespace carom {

class PlotsWriter final : public Writer {
 public:
  /// Throws ExportError, as all functions of this class do.
  PlotsWriter(OpenFolder& folder, const Scene& scene);
  void record(std::span<const Collision> collisions) override;
  void add(double time, const State& state, std::span<const ContactForce> contacts) override;
  std::vector<OutputFile*> files() override;
  std::vector<FileRecord> published() const override { return series_.records(); }

  void keep(StateWriter& archive) override { archive(charts_); }
  void keep(StateReader& archive) override { archive(charts_); }

  /// The instants at which states are added.
  static std::vector<Ticks> ticks(const Scene& scene);

 private:
  std::string gnuplot_;
  RunCharts charts_;
  Series series_;
};

}  // namespace carom
