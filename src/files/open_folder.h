#pragma once
// The run's folder while a run writes it: locked, freed of a former run, put in order when a run fails.
#include <memory>
#include <string>
#include <vector>

#include "files/mesh_copies.h"
#include "files/output_file.h"
#include "files/run_folder.h"
#include "scene/output.h"

namespace carom {

struct Scene;

/// A folder's descriptor; none, with errno, if it is not there, or no folder, or (unless `follow`) a link. Throws
/// ExportError where that cannot be said.
Descriptor open_folder(int parent, const std::string& name, bool follow);

enum class Standing { nothing, folder, other };
/// What stands at a path. Throws ExportError where that cannot be said.
Standing what_stands(const std::string& path);

/// Whether two paths lead to the same folder, which is there. Throws ExportError where that cannot be said.
bool is_same_folder(const std::string& a, const std::string& b);

/// Where a path leads, links followed as far as it is there. Throws ExportError where that cannot be said.
std::string canonical(const std::string& path);

/// The path from the root. Throws ExportError where that cannot be said.
std::string absolute(const std::string& path);

enum class LockKind { alone, shared };
/// False: another one has it. A file system that knows no locks (some network ones) is used without. Throws
/// ExportError.
bool lock_folder(const FilePlace& place, LockKind kind);

/// Removes all files that the manifest in this folder names, the manifest first, and parts that were left; of a run
/// that was interrupted, what runs write beside scene.yaml. Throws ExportError.
void remove_files_of_run(const FilePlace& place);

class OpenFolder {
 public:
  /// Makes the folder and its parents if need be, locks it against other runs, and finishes what an interrupted
  /// publication left. Throws ExportError, as all of this class does.
  explicit OpenFolder(const std::string& path, Durability durability = Durability::synced);
  /// Without keep(): takes back scene.yaml and meshes, and the folders that are empty then and that this run made.
  ~OpenFolder();
  OpenFolder(const OpenFolder&) = delete;
  OpenFolder& operator=(const OpenFolder&) = delete;

  const FilePlace& place() const { return place_; }

  /// Removes what a former run left and puts this scene's scene.yaml there, in an order that leaves at every moment a
  /// folder that inspect_folder judges rightly. Then the copies of its meshes. Gives the records of all these.
  std::vector<FileRecord> begin(const Scene& scene, const std::vector<MeshCopy>& meshes = {});

  /// Instead of begin(), where a whole run of the same motion stands: leaves all as it is until publish(), which puts
  /// this scene's scene.yaml and what is written until then in the place of the files of that run that the manifest
  /// does not name. Gives the records of scene.yaml and of the copies of meshes.
  std::vector<FileRecord> renew(const Scene& scene, const std::vector<MeshCopy>& meshes);

  /// Makes, if need be, and opens the folder of a series.
  FilePlace series(const FileSeries& series);

  /// Something stands in the folder now that is worth keeping even if the run fails.
  void keep() { keep_ = true; }

  /// Gives files that are complete their names, then the manifest its own (publication.h). One sync for all of them
  /// costs a fraction of one each.
  void publish(std::vector<PartFile*> files, OutputFile& manifest);

 private:
  void lock();
  /// What stands in the folder now stays, parts too.
  void decide() {
    keep();
    renews_ = false;
  }
  void refuse_folders(const Scene& scene) const;

  Durability durability_;
  Descriptor folder_;
  std::vector<Descriptor> series_;
  FilePlace place_;
  bool made_ = false, keep_ = false;
  std::vector<FileRecord> begun_;  // what stands there from the beginning
  // Of renew(): until publish() series are written in folders of their own.
  bool renews_ = false;
  std::vector<std::unique_ptr<OutputFile>> first_files_;
};

}  // namespace carom
