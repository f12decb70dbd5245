#pragma once
// What an interrupted run needs to go on: a file beside its temporary ones, which an ordinary start removes with them.

#include "files/file_place.h"
#include "files/summary.h"
#include "std.h"

namespace carom {

/// The state of a run between two advances.
struct Checkpoint {
  double time = 0;  // s, of the motion
  SceneOrigin origin{};
  // Bytes of physics/archive.h.
  string outputs{}, simulator{};

  void keep(auto& archive) { archive(time, origin, outputs, simulator); }
};

/// The checkpoint of a run's folder. It is that of one request to one build of the program.
class CheckpointFile {
 public:
  /// `request`: gives what tells runs apart, when that is needed. `place` must outlive this object.
  CheckpointFile(const FilePlace& place, function<string()> request) : place_(place), request_(std::move(request)) {}

  /// None: there is none, or that of another request. Throws ArchiveError, and removes it, if it is damaged.
  /// Throws ExportError, as all functions of this class do.
  optional<Checkpoint> read();
  /// Replaces it at once or not at all. All files of the run are on disk before that, so that it survives a power
  /// failure.
  void write(Checkpoint checkpoint);
  void remove();

 private:
  string hash() const;

  const FilePlace& place_;
  const function<string()> request_;
};

/// Whether the folder has a checkpoint, of any request.
bool has_checkpoint(const FilePlace& place);

/// That checkpoint. None: there is none, or it is damaged. Throws ExportError.
optional<Checkpoint> any_checkpoint(const FilePlace& place);
/// The same of the folder of this path.
optional<Checkpoint> any_checkpoint(const string& folder);

}  // namespace carom
