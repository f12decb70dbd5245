#pragma once
// Writes the files that a scene requests. Tables, buffers and pictures exist only for what it requests.
// They are made in two ways through the motion: tables and whatever needs no more than the present, and drawings.
#include <atomic>

#include "export/output_part.h"
#include "export/picture_streams.h"
#include "files/checkpoint_file.h"
#include "files/output_file.h"
#include "files/publication.h"
#include "files/summary.h"
#include "render/image.h"
#include "render/model.h"
#include "std.h"

namespace carom {

class FlightsFile;
struct Manifest;
struct Scene;

class Exports {
 public:
  /// Opens only what scene.output requests, in `folder`, which is made if needed and locked against other runs.
  /// Files of a former run there are removed, by its manifest.
  /// Predictable failures come before any change: ffmpeg missing, a video without pictures, a sheet too large.
  /// `scene` must outlive this object. `makers`: the functions of render/ for vtk and gltf. Throws ExportError.
  /// `renewed`: the manifest of the complete run of the same motion that the folder holds.
  /// Of that run all files stay except drawn ones, summary.csv and scene.yaml. Until finish() all of them stay.
  /// `request`: gives what tells runs apart, from what does not change. An interrupted run of the same request then
  /// goes on: see goes_on(). Unset: it begins anew. Throws ArchiveError if what that run has left is damaged, and
  /// removes its checkpoint then.
  Exports(const Scene& scene, const string& folder, Durability durability = Durability::synced, ModelMakers makers = {},
          const Manifest* renewed = nullptr, function<string()> request = {});
  /// Without finish(), incomplete files are removed. Complete frames stay.
  ~Exports();
  Exports(const Exports&) = delete;
  Exports& operator=(const Exports&) = delete;

  /// Whether an interrupted run goes on.
  bool goes_on() const;
  /// What it has kept. The tables must take over their part of that.
  Checkpoint take_interrupted();
  /// Whether another request's run was kept in the folder.
  bool replaces_interrupted() const;
  /// Keeps this for a run that continues this one. From here on the folder's files stay if the run fails.
  void keep(Checkpoint checkpoint);
  /// Whether that has been done, by this run or by the one that it continues.
  bool is_kept() const;
  /// Removes what was kept, but no file of this run.
  void forget();

  OutputPart& tables();
  /// The flights among the tables. Null: there are none.
  FlightsFile* flights();
  /// Where the files are written.
  const FilePlace& place() const;

  /// Whether there is anything to draw: pictures, or outputs that take their first state only when the whole motion is
  /// known.
  bool draws() const;
  /// Opens these. If the run ends before its duration and that is known, scene.known.ends_at has it by now.
  void begin_drawings();
  OutputPart& drawings();
  const vector<PictureStream>& pictures() const;
  /// Ends the timeline of the drawings at `time` (s), before the duration (timeline.h). Throws ExportError if pictures
  /// then have none.
  void end_drawings_at(double time);
  /// Take what drawings have been given since the last call, in order.
  void record_drawings(span<const Collision> collisions, span<const PathPiece> pieces);
  /// Copies the picture that is due for pictures()[stream]. `again`: it equals the stream's previous one.
  /// Other threads encode and write it. An error of theirs is thrown by a later call, or by finish().
  void picture(size_t stream, const Image& image, bool again = false);
  /// Whether the picture that is due for pictures()[stream] is the film's first, and a title card comes before it.
  bool begins_with_title(size_t stream) const;
  /// Takes a picture of the title card.
  void title_picture(const Image& image);
  /// The pictures taken so far for frames and video. Those of the sheet do not count. Any thread may ask.
  uint64_t frames() const;
  /// As many as there will be, as far as is known: a film that slows down is longer once that is.
  uint64_t planned_frames() const;

  /// The sizes of the tables, after all parts have ended.
  vector<TableSize> table_sizes() const;
  /// The files that were given up, after all parts have ended.
  vector<LeftOut> left_out() const;
  /// Completes every file, then renames all of them. summary.csv is included, and manifest.json is last.
  /// Throws ExportError.
  /// scene.yaml is in the folder from the start,
  /// so that the folder of an interrupted run is recognised as this scene's.
  void finish(const Summary& summary, const RunFacts& facts);

 private:
  struct Impl;
  unique_ptr<Impl> impl_;
};

}  // namespace carom
