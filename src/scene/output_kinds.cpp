// The rows of the table of outputs, and functions over the set of requested ones.
// A template for each sort of output makes its functions from the member of Output.
// A new output therefore is one member, one row, and one writer.
#include "scene/output_kinds.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "scene/member.h"
#include "std.h"

namespace carom {
namespace {

constexpr Range above_0{0, infinity, true, false};
constexpr Range from_0{0, infinity, false, false};
constexpr Range image_side{16, 16384};

constexpr string_view table_ending = ".csv";

// clang-format off
constexpr Field trajectory_fields[] = {
    row<TrajectoryOutput, &TrajectoryOutput::every>("every", "Time between rows.", "0.01", {.unit = "s", .range = above_0, .title = "Time between rows"}),
    row<TrajectoryOutput, &TrajectoryOutput::wide>("layout", "long: a row for each body and time; wide: a row for each time.", "wide", {.type = Type::choice, .of = "long|wide"}),
    row_if_given<TrajectoryOutput, &TrajectoryOutput::on>("on", "Balls, bodies, groups and members that have rows. Default: all.", "[red, gas.3]", {.type = Type::names, .title = "Bodies that have rows", .pattern = reference}),
};

constexpr Field energy_fields[] = {
    row<EnergyOutput, &EnergyOutput::every>("every", "Time between rows.", "0.01", {.unit = "s", .range = above_0, .title = "Time between rows"}),
};

constexpr Field contacts_fields[] = {
    row<ContactsOutput, &ContactsOutput::every>("every", "Time between rows.", "0.1", {.unit = "s", .range = above_0, .title = "Time between rows"}),
};

constexpr Field tables_fields[] = {
    row<TablesOutput, &TablesOutput::format>("format", "csv; csv.gz: the tables of the motion compressed, to half of the size or less; xlsx: CSV, and all tables in tables.xlsx.", "csv.gz", {.of = "csv|csv.gz|xlsx"}),
    row<TablesOutput, &TablesOutput::separator>("separator", "The character between the cells of CSV files, those of a sweep included. A spreadsheet with decimal commas expects a semicolon.", "\";\"", {.of = ",|;|tab"}),
    row<TablesOutput, &TablesOutput::decimal>("decimal", "The decimal mark in CSV files. A comma needs another separator.", "\",\"", {.of = ".|,", .title = "Decimal mark"}),
};

constexpr Field vtk_fields[] = {
    row<VtkOutput, &VtkOutput::every>("every", "Time between files.", "0.1", {.unit = "s", .range = above_0, .title = "Time between files"}),
};

constexpr Field xyz_fields[] = {
    row<XyzOutput, &XyzOutput::every>("every", "Time between frames.", "0.1", {.unit = "s", .range = above_0, .title = "Time between frames"}),
};

constexpr Field gltf_fields[] = {
    row<GltfOutput, &GltfOutput::fps>("fps", "Keyframes a second; one more at the end.", "24", {.unit = "1/s", .range = above_0, .title = "Keyframes a second"}),
};

constexpr Field fps = row("fps", "Pictures a second.", "25", {.unit = "1/s", .range = above_0, .title = "Pictures a second"});
constexpr Field film_fps = row("fps", "Pictures a second. A GIF can have 50, 25, 20 or another 100/n. Left out, its rate is the highest of these up to that of frames.", "25", {.unit = "1/s", .range = above_0, .title = "Pictures a second"});
constexpr Field size = row("size", "Width and height of a picture.", "[640, 360]", {.type = Type::pixels, .unit = "pixels", .range = image_side, .of = size_names, .title = "Width and height"});
// A film stores colours for blocks of 2 x 2 pixels.
constexpr Field film_size = row("size", "Width and height of a picture, both even.", "[640, 360]", {.type = Type::pixels, .unit = "pixels", .range = {16, 16384, false, false, true}, .of = size_names, .title = "Width and height"});
constexpr Field samples = row("samples", "Samples a pixel, against jagged edges.", "8", {.type = Type::choice, .of = "1|2|4|8"});
constexpr Field from = row("from", "No picture before this time.", "0.5", {.unit = "s", .range = from_0, .title = "Start", .own = true});
// The windows are not shared: a window of frames/ is often a single picture.
constexpr Field film_from = row("from", "Time of the first picture.", "0.5", {.unit = "s", .range = from_0, .title = "Start", .own = true});
constexpr Field until = row("until", "No picture after this time. Default: the duration.", "1.5", {.unit = "s", .range = from_0, .title = "End", .own = true});

constexpr Field frames_fields[] = {
    with(fps, fills<FramesOutput, &FramesOutput::fps>),
    with(size, fills<FramesOutput, &FramesOutput::size>),
    with(samples, fills<FramesOutput, &FramesOutput::samples>),
    with(from, fills<FramesOutput, &FramesOutput::from>),
    with(until, fills<FramesOutput, &FramesOutput::until>),
};

constexpr Field slow_fields[] = {
    row<SlowSettings, &SlowSettings::around>("around", "auto: the first collision in the time that the film shows. A ball, body, group or member (gas.3): the first one of these. none: no slow motion.", "red", {.type = Type::name, .title = "Whose collision", .pattern = reference}),
};
constexpr Kind kinds_below[] = {{"slow", "", "Slow motion around a collision.", slow_fields},
                                {"tables", "", "How tables are written.", tables_fields}};

constexpr Field video_fields[] = {
    row<VideoOutput, &VideoOutput::file>("file", "Name of the file, ending in .mp4 (H.264), .gif or .webp.", "break.mp4", {.pattern = R"(^(?=.{5,200}$)(?![-.])[^/\\\u0000-\u001f]+\.(mp4|gif|webp)$)"}),
    with(film_fps, fills<VideoOutput, &VideoOutput::fps>),
    with(film_size, fills<VideoOutput, &VideoOutput::size>),
    row<VideoOutput, &VideoOutput::crf>("crf", "0: largest and best, 51: smallest and worst. Not of a GIF; quality 100 to 0 of a WebP.", "23", {.range = {0, 51}, .title = "Constant rate factor"}),
    with(samples, fills<VideoOutput, &VideoOutput::samples>),
    with(film_from, fills<VideoOutput, &VideoOutput::from>),
    with(until, fills<VideoOutput, &VideoOutput::until>),
    row<VideoOutput, &VideoOutput::speed>("speed", "Seconds of motion a second of film; 0.125 is eightfold slow motion.", "0.125", {.range = {1e-6, 1e6}, .title = "Seconds of motion a second of film"}),
    row<VideoOutput, &VideoOutput::title>("title", "Whether the film begins with the scene's title, for 2 s.", "true", {.title = "Title card"}),
    row_if_given<VideoOutput, &VideoOutput::beside>("beside", "A chart that grows in the right third of the film: energy, momentum, or a quantity of a body: x(red), y, z, vx, vy, vz, speed or kinetic.", "energy", {.title = "Chart beside the pictures", .pattern = R"(^(energy|momentum|(x|y|z|vx|vy|vz|speed|kinetic)\([A-Za-z_][A-Za-z0-9_-]*(\.[0-9]+)*\))$)"}),
    row_if_given<VideoOutput, &VideoOutput::slow>("slow", "Slow motion around a collision, eased in and out, with its factor in the caption. A word alone is `around`.", "auto", {.of = "slow", .plain = "around", .held = kinds_below}),
    row<VideoOutput, &VideoOutput::sound>("sound", "A click at each collision: louder with its impulse, higher with smaller bodies. Only of an .mp4.", "true", {.title = "Sound of collisions"}),
};

constexpr Field sheet_fields[] = {
    row<SheetOutput, &SheetOutput::columns>("columns", "Pictures side by side.", "5", {.range = {1, 100}}),
    row<SheetOutput, &SheetOutput::rows>("rows", "Pictures one below another.", "2", {.range = {1, 100}}),
    row_if_given<SheetOutput, &SheetOutput::size>("size", "Width and height of the whole sheet. Default: by the columns and the shape of frames, else of video, at most 1920 wide.", "1080p", {.unit = "pixels", .range = image_side, .of = size_names, .title = "Width and height"}),
    row<SheetOutput, &SheetOutput::from>("from", "Time of the first picture.", "0.5", {.unit = "s", .range = from_0, .title = "Start"}),
    row<SheetOutput, &SheetOutput::until>("until", "Time of the last picture. Default: the duration.", "1.5", {.unit = "s", .range = from_0, .title = "End"}),
};
// clang-format on

/// The interval in s between the states that an output writes.
template <typename Settings>
requires requires(Settings settings) {
  settings.every;
}
double every_of(const Settings& settings) {
  return settings.every;
}
double every_of(const GltfOutput& settings) {
  return 1 / settings.fps;
}

template <auto member>
constexpr double (*every_in())(const Output&) {
  using Settings = std::remove_cvref_t<decltype(*(Output{}.*member))>;
  if constexpr (requires(Settings settings) { every_of(settings); })
    return [](const Output& output) { return every_of(*(output.*member)); };
  else
    return nullptr;
}

/// An output with settings.
template <auto member>
constexpr OutputMember part = {[](const Output& output) { return (output.*member).has_value(); },
                               [](Output& to, const Output& requested) {
                                 to.*member = requested.*member;
                                 if (!(to.*member)) (to.*member).emplace();
                               },
                               every_in<member>(), fills_if_given<Output, member>};

/// Pictures. If `requested` lacks this output, it takes rate, size and samples of the other picture output, `like`, as
/// a map without these keys does by OutputKind::beneath.
template <auto member, auto like>
constexpr OutputMember pictures = {[](const Output& output) { return (output.*member).has_value(); },
                                   [](Output& to, const Output& requested) {
                                     to.*member = requested.*member;
                                     if (to.*member) return;
                                     PictureOutput& settings = (to.*member).emplace();
                                     if (!(requested.*like)) return;
                                     const PictureOutput& other = *(requested.*like);
                                     settings.fps = other.fps;
                                     settings.size = other.size;
                                     settings.samples = other.samples;
                                   },
                                   nullptr, fills_if_given<Output, member>};

/// Charts show the rows of tables, whether these are written or not.
template <auto member>
constexpr OutputMember charts = {[](const Output& output) { return output.*member; },
                                 [](Output& to, const Output& requested) {
                                   to.*member = true;
                                   to.left_out_tables = plot_intervals(requested);
                                 },
                                 nullptr, fills<Output, member>};

/// An output without settings, either present or absent.
template <auto member, const Member& key>
constexpr OutputMember flag = {[](const Output& output) { return output.*member; },
                               [](Output& to, const Output&) { to.*member = true; }, nullptr, key};

constexpr OutputKind all_kinds[] = {
    {.name = "trajectory",
     .doc = "trajectory.csv: position and velocity of bodies.",
     .example = "{every: 0.01}",
     .keys = trajectory_fields,
     .keys_doc = "trajectory.csv.",
     .member = part<&Output::trajectory>,
     .files = "trajectory.csv",
     .rows = "rows of trajectory.csv",
     .spacing = "every"},
    {.name = "collisions",
     .doc = "collisions.csv: every collision.",
     .example = "true",
     .member = flag<&Output::collisions, fills<Output, &Output::collisions>>,
     .files = "collisions.csv"},
    {.name = "energy",
     .doc = "energy.csv: energy and momentum of all bodies.",
     .example = "{every: 0.01}",
     .keys = energy_fields,
     .keys_doc = "energy.csv.",
     .member = part<&Output::energy>,
     .files = "energy.csv"},
    {.name = "contacts",
     .doc = "contacts.csv: the forces of lasting contact.",
     .example = "{every: 0.1}",
     .keys = contacts_fields,
     .keys_doc = "contacts.csv.",
     .member = part<&Output::contacts>,
     .files = "contacts.csv"},
    {.name = "regions",
     .doc = "regions.csv: when bodies enter and leave regions.",
     .example = "true",
     .member = flag<&Output::regions, fills<Output, &Output::regions>>,
     .files = "regions.csv"},
    {.name = "frames",
     .doc = "frames/frame_00000.png and so on.",
     .example = "{fps: 30, size: [1280, 720]}",
     .keys = frames_fields,
     .keys_doc = "One PNG a picture; `fps`, `size` and `samples` left out are those of video.",
     .beneath = "video",
     .member = pictures<&Output::frames, &Output::video>,
     .series = frame_files,
     .draws = true},
    {.name = "video",
     .doc = "A film: H.264, GIF or WebP.",
     .example = "true",
     .keys = video_fields,
     .keys_doc = "A film; `fps`, `size` and `samples` left out are those of frames.",
     .beneath = "frames",
     .member = pictures<&Output::video, &Output::frames>,
     .named = [](const Output& o) { return o.video->file; },
     .draws = true},
    {.name = "sheet",
     .doc = "sheet.png: pictures at even times side by side.",
     .example = "{columns: 4, rows: 3}",
     .keys = sheet_fields,
     .keys_doc = "A contact sheet.",
     .member = part<&Output::sheet>,
     .files = "sheet.png",
     .draws = true},
    {.name = "vtk",
     .doc = "For ParaView: trajectory.pvd, vtk/bodies_00000.vtp and so on, surfaces.vtp.",
     .example = "{every: 0.1}",
     .keys = vtk_fields,
     .keys_doc = "Files for ParaView.",
     .member = part<&Output::vtk>,
     .files = "trajectory.pvd|surfaces.vtp",
     .series = vtk_files,
     .rows = "points of vtk/",
     .spacing = "every",
     .draws = true},
    {.name = "xyz",
     .doc = "For OVITO: trajectory.xyz, extended XYZ.",
     .example = "{every: 0.1}",
     .keys = xyz_fields,
     .keys_doc = "A file for OVITO.",
     .member = part<&Output::xyz>,
     .files = "trajectory.xyz",
     .rows = "rows of trajectory.xyz",
     .spacing = "every",
     .draws = true},
    {.name = "gltf",
     .doc = "For Blender: animation.glb, the scene and its motion.",
     .example = "{fps: 24}",
     .keys = gltf_fields,
     .keys_doc = "An animation for Blender.",
     .member = part<&Output::gltf>,
     .files = "animation.glb",
     .rows = "keyframes of animation.glb",
     .spacing = "fps",
     .in_memory = true,
     .draws = true},
    {.name = "flights",
     .doc =
         "flights.bin: the paths of the bodies, from which carom render draws other pictures. Only where free flight "
         "is along parabolas. Default: true with pictures. With --only they are written only if it names them, as with "
         "`only` of a sweep.",
     .example = "true",
     .member = flag<&Output::flights, fills_if_given<Output, &Output::flights>>,
     .files = "flights.bin"},
    {.name = "plots",
     .doc = "plots/energy.svg and so on: charts of energy, heights, speeds and collisions, by gnuplot.",
     .example = "true",
     .member = charts<&Output::plots>,
     .series = plot_files},
    {.name = "report",
     .doc = "index.html: a page for browsers with the numbers of the run, its charts, its film or a picture, and links "
            "to all its files. The charts need gnuplot.",
     .example = "true",
     .member = charts<&Output::report>,
     .files = "index.html"},
};

/// In the order of size_names.
constexpr Size named_sizes[] = {{1280, 720}, {1920, 1080}, {3840, 2160}, {1080, 1080}};

}  // namespace

optional<Size> size_named(string_view name) {
  const vector<string_view> names = parts_of(size_names);
  const auto at = ranges::find(names, name);
  return at == names.end() ? nullopt : optional(named_sizes[at - names.begin()]);
}

Field tables_field() {
  return row_if_given<Output, &Output::tables>("tables",
                                               "How tables are written. A word alone is `format`. `{separator: \";\", "
                                               "decimal: \",\"}` suits spreadsheets with decimal commas.",
                                               "{separator: \";\", decimal: \",\"}",
                                               {.of = "tables", .plain = "format"});
}

string table_file(const TablesOutput& tables, string_view name) {
  const bool packed = tables.format == TablesOutput::Format::gzip && name.ends_with(table_ending);
  return string(name) + (packed ? ".gz" : "");
}

string FileSeries::name(int64_t number) const {
  return fmt::format("{}{:05}{}", stem, number, ending);
}

bool FileSeries::has(string_view name) const {
  if (!names.empty()) {
    const vector<string_view> all = parts_of(names);
    return contains(all, name);
  }
  constexpr size_t digits = 5;
  if (!name.starts_with(stem) || !name.ends_with(ending) || name.size() < stem.size() + digits + ending.size())
    return false;
  const string_view number = name.substr(stem.size(), name.size() - stem.size() - ending.size());
  return all_of(number, [](char c) { return c >= '0' && c <= '9'; });
}

Field OutputKind::field() const {
  const bool is_flag = keys.empty();
  return {.key = name,
          .type = is_flag ? Type::flag : Type::part_or_flag,
          .of = is_flag ? string_view() : name,
          .doc = doc,
          .example = example,
          .member = member.key};
}

nlohmann::ordered_json OutputKind::settings(const Output& output) const {
  const Kind map{name, "", keys_doc, keys};
  Field whole = field();
  whole.held = &map;
  return member.key.json(&output, whole);
}

bool OutputKind::has_file(string_view file) const {
  const vector<string_view> all = parts_of(files);
  return any_of(all, [&](string_view name) {
    return file == name ||
           (name.ends_with(table_ending) && file.starts_with(name) && file.substr(name.size()) == ".gz");
  });
}

span<const OutputKind> output_kinds() {
  return all_kinds;
}

span<const Kind> kinds_below_outputs() {
  return kinds_below;
}

Output restricted(const Output& requested, const vector<string>& only) {
  Output output;
  output.tables = requested.tables;
  for (const OutputKind& kind : all_kinds)
    if (contains(only, kind.name)) kind.member.add(output, requested);
  return output;
}

bool holds_all(const Output& requested, const vector<string>& only) {
  return all_of(only, [&](const string& name) {
    return std::any_of(std::begin(all_kinds), std::end(all_kinds),
                       [&](const OutputKind& kind) { return kind.name == name && kind.asked(requested); });
  });
}

Output with_all(const Output& requested) {
  Output output;
  output.tables = requested.tables;
  for (const OutputKind& kind : all_kinds) kind.member.add(output, requested);
  return output;
}

PlotIntervals plot_intervals(const Output& output) {
  PlotIntervals intervals = output.left_out_tables;
  if (output.energy) intervals.energy = output.energy->every;
  if (output.trajectory) intervals.trajectory = output.trajectory->every;
  return intervals;
}

vector<string> output_files(const Output& output) {
  vector<string> names;
  for (const OutputKind& kind : all_kinds) {
    if (!kind.asked(output)) continue;
    for (const string_view name : parts_of(kind.files)) names.push_back(table_file(output.tables, name));
    if (kind.named) names.push_back(kind.named(output));
  }
  if (output.tables.format == TablesOutput::Format::xlsx) names.emplace_back(tables_workbook);
  return names;
}

bool is_reserved(string_view name) {
  for (const string_view always : {"scene.yaml", "summary.csv", "manifest.json", tables_workbook})
    if (name == always) return true;
  return std::any_of(std::begin(all_kinds), std::end(all_kinds), [&](const OutputKind& kind) {
    return kind.has_file(name) || (!kind.series.folder.empty() && kind.series.folder == name);
  });
}

}  // namespace carom
