#pragma once
// What a scene asked for -> files. Only what it asked for is made: no table, no buffer, no picture else.
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "export/output_file.h"
#include "export/run_folder.h"
#include "export/timeline.h"
#include "physics/collision.h"
#include "physics/contact_force.h"
#include "physics/path_piece.h"
#include "physics/state.h"
#include "physics/tally.h"
#include "render/image.h"
#include "render/model.h"
#include "scene/scene.h"

namespace carom {

/// One sequence of pictures of one size and quality; frames, video and sheet share one where theirs are the same.
struct PictureStream {
  Size size;
  int samples = 4;
  int timeline_stream = 0;
};

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

/// How many trajectory rows, pictures and, roughly, bytes a run of this scene will write, and how long that and drawing
/// may take.
struct Forecast {
  std::uint64_t rows = 0, frames = 0, bytes = 0;
  double seconds = 0;
};
Forecast forecast(const Scene& scene);

struct Manifest;

class Exports {
 public:
  /// Opens only what scene.output asks for, in `folder`, which is made if need be and locked against other runs.
  /// Removes what a former run left there (by its manifest). What can be known to fail is refused before anything is
  /// touched: ffmpeg missing, a video without pictures, a sheet too large. `scene` must outlive this. `makers`: what
  /// vtk and gltf want of render/. Throws ExportError.
  /// `renewed`: what the folder holds now, a whole run of the same motion: all its files but what is drawn, summary.csv
  /// and scene.yaml are kept as they are, and until finish() all of them.
  Exports(const Scene& scene, const std::string& folder, Durability durability = Durability::synced,
          ModelMakers makers = {}, const Manifest* renewed = nullptr);
  /// Without finish(): what was not whole is removed; frames that are whole stay.
  ~Exports();
  Exports(const Exports&) = delete;
  Exports& operator=(const Exports&) = delete;

  Timeline& timeline();
  bool wants_state() const;     // at the timeline's present instant: anything due at all
  bool wants_contacts() const;  // at the timeline's present instant: the forces of contact too
  void record(std::span<const Collision> collisions);
  void record_paths(std::span<const PathPiece> pieces);
  /// Writes the rows that are due now. `contacts`: by a, then b; looked at only if wants_contacts().
  void sample(const State& state, std::span<const ContactForce> contacts = {});
  const std::vector<PictureStream>& pictures() const;
  /// The picture due now of pictures()[stream]. `again`: it is the stream's last one once more.
  void picture(std::size_t stream, const Image& image, bool again = false);
  std::uint64_t frames() const;  // pictures taken so far for frames and video; the sheet's do not count

  /// The run is at its end. Gives what it has given up; nothing is recorded or sampled any more.
  std::vector<LeftOut> end(const Tally& tally);
  /// Completes every file, then gives them their names, summary.csv's too and last manifest.json's. (scene.yaml stands
  /// there from the beginning, so that the folder of an interrupted run is known to be this scene's.) Throws
  /// ExportError.
  void finish(const Summary& summary, const RunFacts& facts);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace carom
