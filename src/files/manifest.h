#pragma once
// manifest.json: what a run wrote, and of which request. Written last: with it a folder is whole.
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/output_file.h"
#include "files/summary.h"
#include "scene/output.h"

namespace carom {

struct Scene;

inline constexpr const char* manifest_name = "manifest.json";
inline constexpr std::uint64_t largest_manifest = 256 << 20;  // bytes; 100,000 frames take 14 million

/// What must be known of a run to tell whether another one is the same.
struct Manifest {
  std::string version;       // the tool's
  std::string scene_sha256;  // of scene.yaml; empty: no scene's
  std::string outputs;       // outputs_text()
  std::string meshes;        // meshes_text()
  std::vector<FileRecord> files;
  std::string scene_file{};         // its name, without a folder
  std::vector<LeftOut> left_out{};  // files of the outputs that there are none of
  std::vector<Measured> measures{};
  std::vector<Warning> warnings{};
  std::uint64_t collisions = 0;
  std::vector<std::string> failed{};  // of a sweep: the runs that did
};

/// The outputs that were chosen, as JSON: the scene's text alone does not tell, for the command line may have left some
/// out.
std::string outputs_text(const Output& output);

/// The text of a manifest of any kind. `outputs` and `facts`: objects, as JSON; the facts' members stand as they are.
std::string manifest_text(const Scene& scene, const std::string& outputs, const std::string& facts,
                          const std::vector<FileRecord>& files);

/// Of what is no scene's; its `outputs` tell what was asked for.
std::string manifest_text(const std::string& outputs, const std::string& facts, const std::vector<FileRecord>& files);

/// The whole text of a run's manifest.
std::string manifest_text(const Scene& scene, const Summary& summary, const RunFacts& facts,
                          const std::vector<FileRecord>& files);

/// A manifest that this tool wrote; none if the file is not there, not whole, another program's, or names files that no
/// run writes.
std::optional<Manifest> read_manifest(int folder, const std::string& name);

/// What a bench writes beside scene.yaml.
inline constexpr std::array<const char*, 3> bench_files = {"bench.csv", "bench.png", "bench.svg"};

/// Whether a run may write a file of this name: a plain one, or one of a series: frames/frame_<digits>.png.
bool is_run_file(std::string_view name);

/// The files of a run of this scene with these outputs, series aside.
std::vector<std::string> run_files(const Scene& scene, const Output& output);

/// The text with whatever is not UTF-8 in it replaced.
std::string valid_utf8(const std::string& text);

}  // namespace carom
