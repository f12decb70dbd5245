#pragma once
// What a bench leaves: bench.csv, the plot, the scene, and a manifest that has the reference and the rest of the facts.
#include <nlohmann/json.hpp>
#include <string>

#include "bench/bench.h"
#include "export/plot.h"
#include "files/open_folder.h"
#include "files/run_folder.h"

namespace carom {

struct Scene;

/// What stands in a folder; of a bench of this scene, with whatever options: this_run or incomplete.
FolderContent inspect_bench_folder(const std::string& folder, const Scene& scene, const BenchOptions& options);

/// The work-precision plot: CPU time of a run against its error, or, of a chaotic scene, its statistics' deviation.
Plot work_precision_plot(const Scene& scene, const BenchResult& result);

/// As in manifest.json: engine, integrator, step_s, step_error.
nlohmann::ordered_json method_json(const SimulationMethod& method);
/// Other methods, with apart_m and agrees.
nlohmann::ordered_json witnesses_json(const std::vector<Witness>& witnesses);

class BenchFolder {
 public:
  /// Makes and locks the folder; what is in it stays until write(). Throws ExportError, as all of this class does.
  BenchFolder(const std::string& path, std::string gnuplot) : folder_(path), gnuplot_(std::move(gnuplot)) {}
  void write(const Scene& scene, const BenchOptions& options, const BenchResult& result);

 private:
  OpenFolder folder_;
  std::string gnuplot_;
};

}  // namespace carom
