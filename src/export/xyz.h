#pragma once
// trajectory.xyz: extended XYZ, one frame after another, for OVITO and ASE.
// It uses columns that both read, and numbers that read back to the same doubles.

#include "export/writer.h"
#include "files/folder_writer.h"
#include "std.h"

namespace carom {

struct Scene;

class XyzWriter : public Writer {
 public:
  XyzWriter(FolderWriter& folder, const Scene& scene);
  void add(double time, const State& state, span<const ContactForce> contacts) override;
  vector<OutputFile*> files() override { return {&file_}; }
  static double bytes(const Scene& scene, double instants);

 private:
  const Scene& scene_;
  bool solids_;
  /// Part of the comment line: the room, the columns.
  string cell_;
  /// By range of bodies, each after a space.
  vector<string> colors_;
  OutputFile file_;
};

}  // namespace carom
