#pragma once
// Run time against error of a scene whose bodies move as crowds, by `simulate.contact.quality`.
//
// Motion in a crowd is chaotic: its bodies' places mean nothing after some hundredths of a second. What is compared are
// the energy that is lost and the height of the heap. Both are means over runs with slightly different
// velocities at the start, with the standard errors of these means.

#include "bench/bench_options.h"
#include "physics/contact_quality.h"
#include "std.h"

namespace carom {

struct Scene;

/// How far a mean over runs is from that of the reference, as a share, and its standard error.
struct MeanError {
  double value = numeric_limits<double>::quiet_NaN();
  double spread = numeric_limits<double>::quiet_NaN();
};

struct QualityRow {
  QualityLevel level = QualityLevel::normal;
  double cpu_s = 0;        // the median of the runs
  MeanError dissipated;    // rms over time, of the energy that is lost so far, by all that is lost at the end
  MeanError height;        // of the centre of mass above the lowest surface of a body, at the end; none without gravity
  double made = 0;         // J, by errors of steps: the mean
  double unsolved = 0;     // share of steps with less accurate forces
  double max_overlap = 0;  // m, of all runs
};

struct QualityCurve {
  vector<QualityRow> rows;  // from coarse to fine. The last one is the reference. Empty: fewer than two.
  size_t runs = 0;          // of each
  string cut;               // why finer ones are missing; empty: all are there
};

/// Runs the scene at each quality, as often as `budget` (s of CPU time) allows and at most six times. The finest ones
/// are left out where there would be fewer than three runs of each.
QualityCurve measure_qualities(const Scene& scene, double budget, const BenchWatch& watch);

}  // namespace carom
