#pragma once
// The table of outputs. Of each, one row has all but how it is written: export/writer.cpp has that.
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/fields.h"
#include "scene/output.h"

namespace carom {

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

/// What a scene's wish for an output is: the member of Output.
struct OutputMember {
  bool (*asked)(const Output& output);
  /// `to` has it from then on: with the settings of `asked`, or with default ones if that has none.
  void (*add)(Output& to, const Output& asked);
  double (*every)(const Output& output);  // s, between the states that it is written of; null: of none
  Member key = {};
};

struct OutputKind {
  std::string_view name;  // the key in `output`; what --only calls it
  std::string_view doc;
  std::string_view example;          // of its value, as YAML
  std::span<const Field> keys = {};  // of its map; empty: it is a flag
  std::string_view keys_doc = {};    // of the map
  std::string_view beneath = {};     // the output whose values hold where its map has none
  OutputMember member = {};
  std::string (*named)(const Output& output) = nullptr;  // a file's name that the scene gives
  std::string_view files = {};                           // the other files' names, separated by |
  FileSeries series = {};
  std::string_view rows = {};     // what it has of every body at every instant, in which file; empty: nothing
  std::string_view spacing = {};  // the key that says how often
  bool in_memory = false;         // all of that, until the run's end

  bool looks = false;  // it tells how things look, not only how they move: carom render makes it anew

  bool asked(const Output& output) const { return member.asked(output); }
  bool is_sampled() const { return member.every != nullptr; }
  double every(const Output& output) const { return member.every(output); }  // s; of one that is sampled
  nlohmann::ordered_json settings(const Output& output) const;               // of one that is asked for
  bool has_file(std::string_view name) const;                                // among `files`
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
