#pragma once
// What a run came to: summary.csv's row, and what manifest.json says beside it.
#include <cstdint>
#include <string>
#include <vector>

#include "files/part_file.h"
#include "physics/tally.h"

namespace carom {

/// What one force did in a run.
struct ForceWork {
  std::string force;  // "gravity", "merging", or its path in the scene: "forces.0.drag"
  double work = 0;    // J
};

/// Where a run's energy went, J.
struct EnergyTotals {
  double start = 0, end = 0;
  double lost = 0;      // by impacts: those recorded, and those that contact took up
  double work = 0;      // of forces without a potential
  double residual = 0;  // what neither impacts nor work account for: the method's own error, and rounding
  double turnover = 0;  // what has changed its form at least: kinetic at both ends, potential, lost, work
  std::vector<ForceWork> of_forces{};  // of a scene with forces; else empty
};

/// Why a figure may be wrong, and what to do about it.
struct Warning {
  std::string code;  // one word, for programs: energy, step, tolerance, contact, place, speed
  std::string text;
};

/// For the report alone: no columns.
struct ContactCounts {
  std::uint64_t merges = 0;
  std::uint64_t collapses = 0;  // clusters taken into contact
  TakenUp taken_up;
};

/// summary.csv's row, in the order of its columns.
struct Summary {
  std::string run, title, engine, status;
  double duration = 0;
  std::uint64_t bodies = 0, collisions = 0, body_body = 0, body_fixed = 0;
  double first_collision = 0, last_collision = 0;  // s, NaN: empty
  EnergyTotals energy;
  double momentum_drift = 0;  // kg m/s, |p(end) - p(start)|
  double max_overlap = 0, max_speed = 0;
  std::uint64_t resting = 0, frames = 0;
  double stepped_contact = 0;  // s, summed over bodies: lasting contact that time stepping has told

  ContactCounts contact;
  std::vector<Warning> warnings;  // any: status is `doubtful`
};

/// A quantity of the run's end that was asked for; not finite: undefined.
struct Measured {
  std::string name;  // "balls.red.speed_m_per_s"
  double value = 0;
};

/// How the run went, for manifest.json alone (nothing here may stand in a CSV).
struct RunFacts {
  double load_s = 0, simulate_s = 0, render_s = 0, export_s = 0;  // wall times, of the thread that runs the scene
  std::uint64_t peak_memory = 0;                                  // bytes
  std::vector<Measured> measures{};
  std::vector<LeftOut> left_out{};
};

}  // namespace carom
