#pragma once
// Sweeps of two quick balls, each in a folder of its own.
#include "compare/comparison_testing.h"
#include "std.h"
#include "study/sweep_folder.h"
#include "study/sweep_job.h"

namespace carom::testing {

/// Two balls that meet. Further keys may follow.
const string quick_scene =
    "scene: 1\n"
    "gravity: [0, 0, 0]\n"
    "balls:\n"
    "  red: {mass: 1, radius: 0.1, position: [-1, 0, 0], velocity: [2, 0, 0]}\n"
    "  blue: {mass: 1, radius: 0.1, position: [1, 0, 0]}\n"
    "simulate: {duration: 1}\n"
    "output: {energy: {every: 0.5}}\n";

/// A folder with a scene and the sweeps of it.
struct SweepPlace : Place {
  SweepPlace() { write("base.yaml", quick_scene); }

  /// The sweep of these lines below `base`.
  Sweep sweep(const string& lines) const {
    write("sweep.yaml", "sweep: 1\nbase: base.yaml\n" + lines);
    return load_sweep(*this / "sweep.yaml");
  }

  SweepJob job(const string& lines, const Shard& shard = {}) const {
    SweepSettings settings;
    settings.shard = shard;
    settings.restrict = [](const Output& output, const Sweep&) { return output; };
    settings.stop_check = [] {};
    return {sweep(lines), *this / "out", std::move(settings)};
  }

  /// A job after its plan.
  SweepJob planned(const string& lines, const Shard& shard = {}) const {
    SweepJob one = job(lines, shard);
    one.plan([](const SweepProgress&) {});
    return one;
  }

  /// Begins the folder `out`, and does the job's runs. Returns the failures: "r0001: why".
  vector<string> do_runs(SweepJob& job) const {
    const SweepFolder folder(*this / "out", SweepFolder::Use::exclusive, job.sweep(), job.base_text(),
                             skipped_text(job.sweep(), job.base_text(), job.invalid()), [] {});
    vector<string> failures;
    job.run([](const SweepProgress&) {},
            [&](size_t number, const string& why) { failures.push_back(job.sweep().id(number) + ": " + why); });
    return failures;
  }
};

}  // namespace carom::testing
