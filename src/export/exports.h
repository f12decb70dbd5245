#pragma once
// What a scene asked for -> files. Only what it asked for is made: no table, no buffer, no picture else.
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
