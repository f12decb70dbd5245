#pragma once
// The files of a bench: bench.csv, the plot, the scene, and a manifest with the reference and the other facts.
#include <nlohmann/json.hpp>

#include "bench/bench.h"
#include "export/plot.h"
#include "files/folder_writer.h"
#include "files/run_folder.h"
#include "std.h"

namespace carom {

struct Scene;

/// The content of a folder. A bench of this scene with any options is this_run or incomplete.
FolderContent inspect_bench_folder(const string& folder, const Scene& scene, const BenchOptions& options,
                                   FolderChanges* changes = nullptr);

/// The work-precision plot: CPU time of a run against its error,
/// or against the deviation of a chaotic scene's statistics.
Plot work_precision_plot(const Scene& scene, const BenchResult& result);

/// CPU time against the errors of dissipated energy and height, by quality.
Plot quality_plot(const Scene& scene, const QualityCurve& curve);

/// The members in manifest.json: engine, integrator, step_s, step_error.
nlohmann::ordered_json method_json(const SimulationMethod& method);
/// The other methods, with apart_m and agrees.
nlohmann::ordered_json witnesses_json(const vector<Witness>& witnesses);
/// The columns of bench.csv, by their names. Absent: what a failed row, or one without trajectories, does not have.
nlohmann::ordered_json row_json(const BenchRow& row, bool chaotic);
nlohmann::ordered_json differences_json(const Differences& errors);
nlohmann::ordered_json statistics_json(const Statistics& statistics);
/// The columns of a row of qualities.csv.
nlohmann::ordered_json quality_json(const QualityRow& row);

class BenchFolder {
 public:
  /// Makes and locks the folder. Its content stays until write().
  /// Throws ExportError, as all functions of this class do.
  BenchFolder(const string& path, string gnuplot) : folder_(path), gnuplot_(std::move(gnuplot)) {}
  void write(const Scene& scene, const BenchOptions& options, const BenchResult& result);

 private:
  FolderWriter folder_;
  string gnuplot_;
};

}  // namespace carom
