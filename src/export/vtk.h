#pragma once
// Files for ParaView, in VTK's XML format (VTK File Formats 4.2) with arrays in base64.
// - vtk/bodies_00000.vtp and on: a file for each instant, with a point for each body.
// - trajectory.pvd: the time of each of these files.
// - surfaces.vtp: everything that does not move.
// The files are valid XML, keep every bit of every double, and have reproducible bytes.

#include "export/writer.h"
#include "files/series.h"
#include "render/model.h"
#include "std.h"

namespace carom {

struct Scene;

class VtkWriter : public Writer {
 public:
  VtkWriter(FolderWriter& folder, const Scene& scene, const ModelMakers& makers);
  void add(double time, const State& state, span<const ContactForce> contacts) override;
  vector<OutputFile*> files() override;
  vector<FileRecord> published() const override { return bodies_.records(); }
  void keep(StateWriter& archive) override { keep_all(archive); }
  void keep(StateReader& archive) override { keep_all(archive); }
  static double bytes(const Scene& scene, double instants);

 private:
  void keep_all(auto& archive) {
    archive(bodies_, instants_, extent_);
    keep_part(archive, collection_);
  }

  const Scene& scene_;
  const ModelMakers& makers_;
  bool solids_;
  Series bodies_;
  int64_t instants_ = 0;
  OutputFile collection_, surfaces_;
  /// Of the bodies at all instants so far.
  Extent extent_;
};

}  // namespace carom
