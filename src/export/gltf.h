#pragma once
// animation.glb. The keyframes are collected here, and src/render/ makes a file of them at the end.

#include "export/writer.h"
#include "files/folder_writer.h"
#include "render/model.h"
#include "std.h"

namespace carom {

struct Scene;

class GltfWriter : public Writer {
 public:
  GltfWriter(FolderWriter& folder, const Scene& scene, const ModelMakers& makers)
      : scene_(scene), makers_(makers), file_(folder.place(), "animation.glb") {}
  void add(double time, const State& state, span<const ContactForce> contacts) override;
  vector<OutputFile*> files() override;
  void keep(StateWriter& archive) override { keep_all(archive); }
  void keep(StateReader& archive) override { keep_all(archive); }
  static double bytes(const Scene& scene, double instants);

 private:
  void keep_all(auto& archive) { archive(motion_, volumes_); }

  const Scene& scene_;
  const ModelMakers& makers_;
  OutputFile file_;
  KeyedMotion motion_;
  /// At the previous keyframe, once one has changed.
  vector<optional<Volume>> volumes_;
};

}  // namespace carom
