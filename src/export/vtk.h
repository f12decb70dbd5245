#pragma once
// For ParaView: vtk/bodies_00000.vtp and on, a file an instant with a point a body; trajectory.pvd, which says when
// each is; surfaces.vtp, what stands still. VTK's XML files (VTK File Formats 4.2), their arrays in base64: valid XML,
// every bit of every double, the same bytes each time.
#include <string>
#include <vector>

#include "export/writer.h"
#include "files/series.h"

namespace carom {

struct Scene;

class VtkWriter : public Writer {
 public:
  VtkWriter(OpenFolder& folder, const Scene& scene, const ModelMakers& makers);
  void add(double time, const State& state, std::span<const ContactForce> contacts) override;
  std::vector<OutputFile*> files() override;
  std::vector<FileRecord> published() const override { return bodies_.records(); }
  static double bytes(const Scene& scene, double instants);

 private:
  const Scene& scene_;
  const ModelMakers& makers_;
  bool solids_;
  Series bodies_;
  OutputFile collection_, surfaces_;
  Extent extent_;  // of the bodies so far
};

}  // namespace carom
