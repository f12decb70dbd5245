#pragma once
// manifest.json: the files that a run wrote, and its request. It is written last and marks a folder as complete.

#include "files/output_file.h"
#include "files/summary.h"
#include "scene/output.h"
#include "std.h"

namespace carom {

struct Scene;

inline constexpr const char* manifest_name = "manifest.json";
/// Bytes. A run of 100,000 frames takes 14 million.
inline constexpr uint64_t largest_manifest = 256 << 20;

/// The content of a manifest, by which a run is recognised as the same as another one.
struct Manifest {
  string version;  // of the program
  /// Of scene.yaml. Empty: the manifest belongs to no scene.
  string scene_sha256;
  string outputs;  // outputs_text()
  string meshes;   // meshes_text()
  vector<FileRecord> files;
  string scene_file{};  // the file name, without a folder
  /// As in MadeFrom.
  map<string, string> expressions{};
  SceneOrigin origin{};
  /// Files of the outputs that were given up.
  vector<LeftOut> left_out{};
  vector<Measured> measures{};
  vector<Warning> warnings{};
  uint64_t collisions = 0;
  /// Ids of the failed runs of a sweep.
  vector<string> failed{};
};

/// The chosen outputs as JSON. The scene's text does not determine them, because the command line may exclude some.
string outputs_text(const Output& output);

/// The text of a manifest of any kind. `outputs` and `facts` are JSON objects.
/// The members of `facts` are copied unchanged.
string manifest_text(const Scene& scene, const string& outputs, const string& facts, const vector<FileRecord>& files);

/// The manifest of files that belong to no scene. `outputs` describes the request.
string manifest_text(const string& outputs, const string& facts, const vector<FileRecord>& files);

/// The complete text of a run's manifest.
string manifest_text(const Scene& scene, const Summary& summary, const RunFacts& facts,
                     const vector<FileRecord>& files);

/// The text of a run's manifest with the outputs of `scene`, which has the same motion, and with other files.
/// The number of pictures and the files given up remain as far as the outputs have them, and all else remains.
/// Throws ExportError for a text that is no manifest.
string changed_manifest(const string& text, const Scene& scene, const vector<FileRecord>& files);

/// A manifest that this program wrote.
/// None if the file is absent, incomplete, another program's, or names files that no run writes.
optional<Manifest> read_manifest(int folder, const string& name);

/// The files that a bench writes beside scene.yaml.
inline constexpr array<const char*, 6> bench_files = {"bench.csv",     "bench.png",     "bench.svg",
                                                      "qualities.csv", "qualities.png", "qualities.svg"};

/// Whether a run may write a file of this name: a plain one, or one of a series: frames/frame_<digits>.png.
bool is_run_file(string_view name);

/// The files of a run of this scene with these outputs, without numbered ones.
vector<string> run_files(const Scene& scene, const Output& output);

/// The text with invalid UTF-8 replaced.
string valid_utf8(const string& text);

}  // namespace carom
