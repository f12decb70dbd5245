#pragma once
// Writes the files that a scene requests. Tables, buffers and pictures exist only for what it requests.
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "export/picture_streams.h"
#include "export/timeline.h"
#include "files/output_file.h"
#include "files/run_folder.h"
#include "files/summary.h"
#include "physics/collision.h"
#include "physics/contact_force.h"
#include "physics/path_piece.h"
#include "physics/state.h"
#include "physics/tally.h"
#include "render/image.h"
#include "render/model.h"

namespace carom {

struct Scene;

struct Manifest;

class Exports {
 public:
  /// Opens only what scene.output requests, in `folder`, which is made if needed and locked against other runs.
  /// Files of a former run there are removed, by its manifest.
  /// Predictable failures come before any change: ffmpeg missing, a video without pictures, a sheet too large.
  /// `scene` must outlive this object. `makers`: the functions of render/ for vtk and gltf. Throws ExportError.
  /// `renewed`: the manifest of the complete run of the same motion that the folder holds.
  /// Of that run all files stay except drawn ones, summary.csv and scene.yaml. Until finish() all of them stay.
  Exports(const Scene& scene, const std::string& folder, Durability durability = Durability::synced,
          ModelMakers makers = {}, const Manifest* renewed = nullptr);
  /// Without finish(), incomplete files are removed. Complete frames stay.
  ~Exports();
  Exports(const Exports&) = delete;
  Exports& operator=(const Exports&) = delete;

  Timeline& timeline();
  /// Ends the timeline at `time` (s), before the duration (timeline.h). Throws ExportError if pictures then have none.
  void end_at(double time);
  /// Whether any output is due at the timeline's present instant.
  bool needs_state() const;
  /// The same for outputs of contact forces.
  bool needs_contacts() const;
  void record(std::span<const Collision> collisions);
  void record_paths(std::span<const PathPiece> pieces);
  void record_crossings(std::span<const RegionCrossing> crossings);
  /// Writes the rows that are due. `contacts`: sorted by a, then b; read only if needs_contacts().
  void sample(const State& state, std::span<const ContactForce> contacts = {});
  const std::vector<PictureStream>& pictures() const;
  /// Copies the picture that is due for pictures()[stream]. `again`: it equals the stream's previous one.
  /// Other threads encode and write it. An error of theirs is thrown by a later call, or by finish().
  void picture(std::size_t stream, const Image& image, bool again = false);
  /// The pictures taken so far for frames and video. Those of the sheet do not count.
  std::uint64_t frames() const;

  /// Ends the run, after which nothing is recorded or sampled. Returns the files that were given up.
  std::vector<LeftOut> end(const Tally& tally);
  /// Completes every file, then renames all of them. summary.csv is included, and manifest.json is last.
  /// Throws ExportError.
  /// scene.yaml is in the folder from the start,
  /// so that the folder of an interrupted run is recognised as this scene's.
  void finish(const Summary& summary, const RunFacts& facts);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace carom
