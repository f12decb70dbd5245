#pragma once
// The folder of a run during writing: locked, cleared of a former run, and cleaned up when the run fails.
#include <atomic>

#include "files/folders.h"
#include "files/mesh_copies.h"
#include "files/output_file.h"
#include "files/publication.h"
#include "scene/output_kinds.h"
#include "std.h"

namespace carom {

struct Scene;

/// Removes all files named in this folder's manifest, the manifest first, and abandoned temporary files.
/// In the folder of an interrupted run, also removes what runs write beside scene.yaml. Throws ExportError.
void remove_files_of_run(const FilePlace& place);

class FolderWriter {
 public:
  /// Makes the folder and its parents if needed, locks it against other runs, and finishes an interrupted publication.
  /// Throws ExportError, as all functions of this class do.
  explicit FolderWriter(const string& path, Durability durability = Durability::synced);
  /// Where a checkpoint stands (checkpoint_file.h), and after publish(), all stays. Else the run's temporary files are
  /// removed; and without keep() scene.yaml, meshes, and folders that this run made and that are then empty.
  ~FolderWriter();
  FolderWriter(const FolderWriter&) = delete;
  FolderWriter& operator=(const FolderWriter&) = delete;

  const FilePlace& place() const { return place_; }

  /// Removes what a former run left, then writes this scene's scene.yaml and the copies of its meshes.
  /// The order ensures that inspect_folder is correct at every moment. Returns the records of all files written.
  vector<FileRecord> begin(const Scene& scene, const vector<MeshCopy>& meshes = {});

  /// Replaces begin() if the folder holds an interrupted run of this request (checkpoint_file.h). All of it stays.
  /// Returns the records of scene.yaml and of the copies of meshes.
  vector<FileRecord> go_on(const Scene& scene, const vector<MeshCopy>& meshes);

  /// Replaces begin() if the folder holds a complete run of the same motion. All files stay unchanged until publish().
  /// publish() then puts the new scene.yaml and the files written meanwhile in place.
  /// They replace the files of that run that the new manifest does not name.
  /// Returns the records of scene.yaml and of the copies of meshes.
  vector<FileRecord> renew(const Scene& scene, const vector<MeshCopy>& meshes);

  /// Makes the folder of a series if needed, and opens it.
  FilePlace series(const FileSeries& series);

  /// Keeps the folder's content even if the run fails. May be called by several threads.
  void keep() { keep_ = true; }

  /// Renames complete files to their final names, then the manifest (publication.h).
  /// One sync for all files costs a fraction of one sync for each.
  void publish(vector<PartFile*> files, OutputFile& manifest);

 private:
  void lock();
  /// Makes the folder's content permanent, temporary files included.
  void commit() {
    keep();
    committed_ = true;
    renews_ = false;
  }
  void refuse_folders(const Scene& scene) const;
  void put(const string& name, const string& bytes);
  void remove_own_parts() const;

  Durability durability_;
  Descriptor folder_;
  vector<Descriptor> series_;
  FilePlace place_;
  bool made_ = false;
  std::atomic<bool> keep_ = false;
  bool committed_ = false;
  vector<FileRecord> begun_;  // the files written by begin()
  // After renew(), series are written in temporary folders until publish().
  bool renews_ = false;
  vector<unique_ptr<OutputFile>> first_files_;
};

}  // namespace carom
