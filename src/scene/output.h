#pragma once
// The keys of `output`: what a scene requests a run to write. Their rows are in output_kinds.cpp.

#include "physics/entity.h"
#include "physics/quantity.h"
#include "std.h"

namespace carom {

struct Size {
  int width = 1280, height = 720;  // pixels
  friend bool operator==(const Size&, const Size&) = default;
};

/// The sizes that have names in the format, separated by |.
inline constexpr string_view size_names = "720p|1080p|4k|square";
/// 1280 x 720, 1920 x 1080, 3840 x 2160, 1080 x 1080. None: no such name.
optional<Size> size_named(string_view name);

struct TrajectoryOutput {
  double every = 1.0 / 30;  // s
  bool wide = false;
  vector<string> on{};      // names as in the file; none: all bodies
  vector<Entity> bodies{};  // those of `on`, ascending; empty: all
};
/// How many of `bodies` have a row at an instant.
inline double rows_of(const TrajectoryOutput& trajectory, double bodies) {
  return trajectory.bodies.empty() ? bodies : double(trajectory.bodies.size());
}
struct EnergyOutput {
  double every = 1.0 / 30;  // s
};
struct ContactsOutput {
  double every = 1.0 / 30;  // s
};

/// Pictures at evenly spaced times.
struct PictureOutput {
  double fps = 30;
  Size size;
  int samples = 4;         // per pixel
  double from = 0;         // s
  optional<double> until;  // s; none: the duration
  friend bool operator==(const PictureOutput&, const PictureOutput&) = default;
};
struct FramesOutput : PictureOutput {};
/// What a chart beside the film shows.
struct ChartSubject {
  enum class Kind : uint8_t { energy, momentum, body };
  Kind kind = Kind::energy;
  // Of kind body.
  Quantity quantity = Quantity::x;
  Entity body = 0;
  friend bool operator==(const ChartSubject&, const ChartSubject&) = default;
};

/// Slow motion around the first collision in the time that a film shows.
struct SlowSettings {
  string around = "auto";       // as in the file: the name of bodies, auto or none
  Entity first = 0, count = 0;  // these bodies; count 0: any
};
struct VideoOutput : PictureOutput {
  string file = "animation.mp4";  // a plain file name; its ending chooses the format (film_format.h)
  int crf = 18;
  /// Seconds of motion a second of film. Picture i shows the time from + i * speed / fps.
  double speed = 1;
  bool title = false;            // a card with the scene's title comes first (film_layout.h)
  optional<string> beside{};     // as in the file; none: no chart
  optional<ChartSubject> chart;  // what `beside` names
  optional<SlowSettings> slow{};
  bool sound = false;  // of collisions
};

struct SheetOutput {
  int columns = 4, rows = 3;
  optional<Size> size{};     // of the whole sheet; none: by the columns
  double from = 0;           // s, of the first picture
  optional<double> until{};  // s, of the last picture; none: the duration
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

/// How a run writes its tables.
struct TablesOutput {
  /// gzip: compressed CSV; xlsx: CSV, and a workbook of all tables.
  enum class Format : uint8_t { csv, gzip, xlsx };
  enum class Separator : uint8_t { comma, semicolon, tab };
  enum class Decimal : uint8_t { point, comma };
  Format format = Format::csv;
  // Of CSV.
  Separator separator = Separator::comma;
  Decimal decimal = Decimal::point;

  char separator_mark() const { return ",;\t"[size_t(separator)]; }
  char decimal_mark() const { return ".,"[size_t(decimal)]; }
  friend bool operator==(const TablesOutput&, const TablesOutput&) = default;
};

/// The intervals of the tables of which charts show the rows, in s. None: the scene lists no such table.
struct PlotIntervals {
  optional<double> energy, trajectory;
};

/// The outputs of a run. An absent one is not written, and nothing is constructed for it.
/// summary, manifest and scene.yaml are always written.
struct Output {
  optional<TrajectoryOutput> trajectory;
  bool collisions = false;
  optional<EnergyOutput> energy;
  optional<ContactsOutput> contacts;
  bool regions = false;
  TablesOutput tables;
  optional<FramesOutput> frames;
  optional<VideoOutput> video;
  optional<SheetOutput> sheet;
  optional<VtkOutput> vtk;
  optional<XyzOutput> xyz;
  optional<GltfOutput> gltf;
  /// Only of an engine that moves bodies along parabolas.
  bool flights = false;
  bool plots = false;
  bool report = false;
  /// Those of tables that --only leaves out.
  PlotIntervals left_out_tables;
  bool charts() const { return plots || report; }
  bool needs_collisions() const { return collisions || charts(); }
  bool pictures() const { return frames || video || sheet; }
};

}  // namespace carom
