#pragma once
// The table of outputs: one row for each, with all but how it is written. That is in export/writer.cpp.
#include <nlohmann/json_fwd.hpp>

#include "scene/field.h"
#include "scene/output.h"
#include "std.h"

namespace carom {

/// Files in a folder of their own: numbered ones, <folder>/<stem>00000<ending>, five digits or more, or those of
/// `names`.
struct FileSeries {
  string_view folder, stem, ending;
  /// The words for one file and for several: "picture", "pictures".
  string_view what, whats;
  /// Separated by |. Empty: the files are numbered.
  string_view names = {};

  /// "frame_00012.png".
  string name(int64_t number) const;
  /// Whether name() can produce this name, or `names` has it.
  bool has(string_view name) const;
};

inline constexpr FileSeries frame_files{"frames", "frame_", ".png", "picture", "pictures"};
inline constexpr FileSeries vtk_files{"vtk", "bodies_", ".vtp", "instant", "instants"};
/// The page of a run with `report`, and that of a comparison.
inline constexpr const char* page_name = "index.html";

inline constexpr FileSeries plot_files{
    "plots", "",
    "",      "plot",
    "plots", "energy.svg|energy.png|heights.svg|heights.png|speeds.svg|speeds.png|collisions.svg|collisions.png"};

/// The member of Output that holds a scene's request for one output.
struct OutputMember {
  bool (*asked)(const Output& output);
  /// Adds the output to `to`: with the settings of `requested`, or with default ones if `requested` lacks it.
  void (*add)(Output& to, const Output& requested);
  /// The interval in s between the states written. Null: the output is not sampled.
  double (*every)(const Output& output);
  Member key = {};
};

struct OutputKind {
  /// The key in `output` and the name for --only.
  string_view name;
  string_view doc;
  string_view example;  // a value, as YAML
  /// Keys of its map. Empty: a flag.
  span<const Field> keys = {};
  string_view keys_doc = {};  // describes the map
  /// The output that supplies values missing in the map of this one.
  string_view beneath = {};
  OutputMember member = {};
  /// The file name that the scene gives to this output.
  string (*named)(const Output& output) = nullptr;
  /// Names of the other files, separated by |.
  string_view files = {};
  FileSeries series = {};
  /// What it holds of every body at every instant, and in which file. Empty: nothing of the kind.
  string_view rows = {};
  string_view spacing = {};  // the key of the interval
  /// All rows are held in memory until the run's end.
  bool in_memory = false;

  /// It depends on appearance and not only on the motion. carom render makes it anew.
  bool draws = false;

  Field field() const;  // in the map `output`
  bool asked(const Output& output) const { return member.asked(output); }
  bool is_sampled() const { return member.every != nullptr; }
  double every(const Output& output) const { return member.every(output); }  // s; only if is_sampled()
  nlohmann::ordered_json settings(const Output& output) const;               // only if asked()
  bool has_file(string_view name) const;                                     // whether it is among `files`
};

/// Every output, in the order of the scene's keys, of --only and of the manifest.
span<const OutputKind> output_kinds();

/// The key `tables` of `output`.
Field tables_field();

/// The file of a table: "energy.csv", and compressed "energy.csv.gz". Other names stay.
string table_file(const TablesOutput& tables, string_view name);
/// The workbook of a run's tables.
inline constexpr const char* tables_workbook = "tables.xlsx";

/// The kinds of maps that stand in the maps of outputs.
span<const Kind> kinds_below_outputs();

/// The outputs named in `only`, with the scene's settings. An output that the scene lacks gets default settings.
/// Frames and video take each other's rate, size and samples.
/// The scene's resolved text stays unchanged, so that runs with different outputs are recognised as runs of one scene.
Output restricted(const Output& requested, const vector<string>& only);

/// Whether every output named in `only` is among those requested.
bool holds_all(const Output& requested, const vector<string>& only);

/// All outputs: requested ones with their settings, the others with default ones.
Output with_all(const Output& requested);

/// The intervals of the samples for the charts of `plots`, in s.
PlotIntervals plot_intervals(const Output& output);

/// The files of these outputs, without series.
vector<string> output_files(const Output& output);

/// Whether a run may write a file or folder of this name, whatever the scene.
/// The file of a film and the copy of a mesh must not have such a name.
bool is_reserved(string_view name);

}  // namespace carom
