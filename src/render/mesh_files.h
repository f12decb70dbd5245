#pragma once
// The files that the import of a mesh may open, in the child process only. They are the mesh itself and those in its
// folder and below. What their text says about materials is found before assimp reads it.
#include <assimp/DefaultIOSystem.h>

#include <filesystem>

#include "std.h"

namespace carom {

/// The lines of a Wavefront file that name materials.
struct WavefrontNames {
  vector<string> libraries;  // of mtllib
  size_t changes = 0;        // of usemtl
  bool vertex_colors = false;
};

/// How the texture of a material lies on the surface: u' = scale u + offset, with v upwards.
struct WavefrontPlacement {
  array<float, 2> scale = {1, 1}, offset = {};
};

class MeshFiles : public Assimp::DefaultIOSystem {
 public:
  /// `painted`: whether assimp sees the names of materials.
  MeshFiles(const string& file, const string& ending, bool painted);

  bool Exists(const char* file) const override;
  /// Returns nullptr for a file that may not be opened, or written. The caller owns the stream.
  Assimp::IOStream* Open(const char* file, const char* mode) override;

  /// Whether the text of the mesh mentions colours or materials. Throws runtime_error if it names material files
  /// that are not there or have options that are not used, or changes its material too often.
  bool mentions_colors() const;
  /// Whether a material file that was opened defines this material.
  bool defines(const string& material) const { return defined_.contains(material); }
  /// By -s and -o of its map_Kd.
  WavefrontPlacement placement(const string& material) const {
    const auto found = placements_.find(material);
    return found == placements_.end() ? WavefrontPlacement{} : found->second;
  }
  /// Throws runtime_error if assimp found no file of a name that the mesh gives it.
  void check_opened() const;
  /// The bytes of a file by the name that the mesh gives it. `what`: "texture", for the error. Throws
  /// runtime_error.
  string read(const string& what, const string& name, uint64_t most_bytes) const;

 private:
  bool within(const std::filesystem::path& file) const;
  /// `instead`: the end of the remedy.
  std::filesystem::path found(const string& what, const string& name, string_view instead = or_color) const;

  static constexpr string_view or_color = ", or give the body a `color`";

  string file_, ending_;
  bool painted_;
  std::filesystem::path folder_;
  string unopened_;  // the first file that could not be opened, by its name in the mesh
  set<string> defined_;
  map<string, WavefrontPlacement> placements_;  // by material, where it is not the usual one
};

}  // namespace carom
