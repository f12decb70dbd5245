#pragma once
// What a scene asks a run to write. Of every output one row tells all but how it is written.
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

struct Size {
  int width = 1280, height = 720;  // pixels
};

struct TrajectoryOutput {
  double every = 1.0 / 30;  // s
  bool wide = false;
};
struct EnergyOutput {
  double every = 1.0 / 30;  // s
};
struct ContactsOutput {
  double every = 1.0 / 30;  // s
};
struct FramesOutput {
  double fps = 30;
  Size size;
  int samples = 4;              // per pixel
  double from = 0;              // s
  std::optional<double> until;  // s; none: the duration
};
struct VideoOutput {
  std::string file = "animation.mp4";  // a plain file name
  double fps = 30;
  Size size;
  int samples = 4;
  int crf = 18;
  double from = 0;
  std::optional<double> until;
};
struct SheetOutput {
  int columns = 4, rows = 3;
};
struct VtkOutput {
  double every = 1.0 / 30;  // s
};
struct XyzOutput {
  double every = 1.0 / 30;  // s
};
struct GltfOutput {
  double fps = 30;
};

/// What the run shall write; absent means not wanted and nothing is made for it. summary, manifest and scene.yaml
/// always are.
struct Output {
  std::optional<TrajectoryOutput> trajectory;
  bool collisions = false;
  std::optional<EnergyOutput> energy;
  std::optional<ContactsOutput> contacts;
  std::optional<FramesOutput> frames;
  std::optional<VideoOutput> video;
  std::optional<SheetOutput> sheet;
  std::optional<VtkOutput> vtk;
  std::optional<XyzOutput> xyz;
  std::optional<GltfOutput> gltf;
  bool flights = false;  // of an engine that goes along parabolas alone
  bool pictures() const { return frames || video || sheet; }
};

/// Numbered files in a folder of their own: <folder>/<stem>00000<ending>, five digits or more.
struct FileSeries {
  std::string_view folder, stem, ending;
  std::string_view what, whats;  // one of them, several: "picture", "pictures"

  /// "frame_00012.png".
  std::string name(std::int64_t number) const;
  /// Whether name() gives such names.
  bool has(std::string_view name) const;
};

inline constexpr FileSeries frame_files{"frames", "frame_", ".png", "picture", "pictures"};
inline constexpr FileSeries vtk_files{"vtk", "bodies_", ".vtp", "instant", "instants"};

struct OutputKind {
  std::string_view name;  // the key in `output`; what --only calls it
  bool (*asked)(const Output& output);
  /// `to` has it from then on: with the settings of `asked`, or with default ones if that has none.
  void (*add)(Output& to, const Output& asked);
  // Of one that asks for it:
  nlohmann::ordered_json (*settings)(const Output& output);
  double (*every)(const Output& output) = nullptr;       // s, between the states that it is written of; null: of none
  std::string (*named)(const Output& output) = nullptr;  // a file's name that the scene gives
  std::string_view files = {};                           // the other files' names, separated by |
  FileSeries series = {};
  std::string_view rows = {};     // what it has of every body at every instant, in which file; empty: nothing
  std::string_view spacing = {};  // the key that says how often
  bool in_memory = false;         // all of that, until the run's end

  bool looks = false;  // it tells how things look, not only how they move: carom render makes it anew

  bool has_file(std::string_view name) const;  // among `files`
};

/// Every output, in the order of the scene's keys, of --only and of the manifest.
std::span<const OutputKind> output_kinds();

/// Of what is asked for, the outputs named, with the scene's settings. One that it does not ask for gets default
/// settings; frames and video take each other's. (The scene's resolved text stays as it is, so that runs of one scene
/// with different outputs are known to be the same scene's.)
Output restricted(const Output& asked, const std::vector<std::string>& only);

/// Whether every output named is among those asked for.
bool holds_all(const Output& asked, const std::vector<std::string>& only);

/// All outputs: those asked for with their settings, the others with default ones.
Output with_all(const Output& asked);

/// The files of these outputs, series aside.
std::vector<std::string> output_files(const Output& output);

/// Whether a file or folder of a run may have this name whatever the scene: a film's, a mesh's must not be one.
bool is_reserved(std::string_view name);

}  // namespace carom
