#include "scene/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "scene/fields.h"

namespace carom {
namespace {

using Json = nlohmann::ordered_json;

template <typename Settings>
void take(std::optional<Settings>& to, const std::optional<Settings>& asked) {
  to = asked.value_or(Settings{});
}

FramesOutput frames_like(const VideoOutput& video) {
  return {video.fps, video.size, video.samples, video.from, video.until};
}

VideoOutput video_like(const FramesOutput& frames) {
  VideoOutput video;
  video.fps = frames.fps;
  video.size = frames.size;
  video.samples = frames.samples;
  video.from = frames.from;
  video.until = frames.until;
  return video;
}

Json size_json(Size size) {
  return Json::array({size.width, size.height});
}

Json optional_json(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}

constexpr OutputKind output_table[] = {
    {.name = "trajectory",
     .asked = [](const Output& o) { return o.trajectory.has_value(); },
     .add = [](Output& to, const Output& asked) { take(to.trajectory, asked.trajectory); },
     .settings =
         [](const Output& o) {
           return Json{{"every", o.trajectory->every}, {"layout", o.trajectory->wide ? "wide" : "long"}};
         },
     .every = [](const Output& o) { return o.trajectory->every; },
     .files = "trajectory.csv",
     .rows = "rows of trajectory.csv",
     .spacing = "every"},
    {.name = "collisions",
     .asked = [](const Output& o) { return o.collisions; },
     .add = [](Output& to, const Output&) { to.collisions = true; },
     .settings = [](const Output&) { return Json(true); },
     .files = "collisions.csv"},
    {.name = "energy",
     .asked = [](const Output& o) { return o.energy.has_value(); },
     .add = [](Output& to, const Output& asked) { take(to.energy, asked.energy); },
     .settings =
         [](const Output& o) {
           return Json{{"every", o.energy->every}};
         },
     .every = [](const Output& o) { return o.energy->every; },
     .files = "energy.csv"},
    {.name = "contacts",
     .asked = [](const Output& o) { return o.contacts.has_value(); },
     .add = [](Output& to, const Output& asked) { take(to.contacts, asked.contacts); },
     .settings =
         [](const Output& o) {
           return Json{{"every", o.contacts->every}};
         },
     .every = [](const Output& o) { return o.contacts->every; },
     .files = "contacts.csv"},
    {.name = "frames",
     .asked = [](const Output& o) { return o.frames.has_value(); },
     .add =
         [](Output& to, const Output& asked) {
           to.frames = asked.frames.value_or(asked.video ? frames_like(*asked.video) : FramesOutput{});
         },
     .settings =
         [](const Output& o) {
           const FramesOutput& f = *o.frames;
           return Json{{"fps", f.fps},
                       {"size", size_json(f.size)},
                       {"samples", f.samples},
                       {"from", f.from},
                       {"until", optional_json(f.until)}};
         },
     .series = frame_files,
     .looks = true},
    {.name = "video",
     .asked = [](const Output& o) { return o.video.has_value(); },
     .add =
         [](Output& to, const Output& asked) {
           to.video = asked.video.value_or(asked.frames ? video_like(*asked.frames) : VideoOutput{});
         },
     .settings =
         [](const Output& o) {
           const VideoOutput& v = *o.video;
           return Json{{"file", v.file}, {"fps", v.fps},   {"size", size_json(v.size)},      {"samples", v.samples},
                       {"crf", v.crf},   {"from", v.from}, {"until", optional_json(v.until)}};
         },
     .named = [](const Output& o) { return o.video->file; },
     .looks = true},
    {.name = "sheet",
     .asked = [](const Output& o) { return o.sheet.has_value(); },
     .add = [](Output& to, const Output& asked) { take(to.sheet, asked.sheet); },
     .settings =
         [](const Output& o) {
           return Json{{"columns", o.sheet->columns}, {"rows", o.sheet->rows}};
         },
     .files = "sheet.png",
     .looks = true},
    {.name = "vtk",
     .asked = [](const Output& o) { return o.vtk.has_value(); },
     .add = [](Output& to, const Output& asked) { take(to.vtk, asked.vtk); },
     .settings =
         [](const Output& o) {
           return Json{{"every", o.vtk->every}};
         },
     .every = [](const Output& o) { return o.vtk->every; },
     .files = "trajectory.pvd|surfaces.vtp",
     .series = vtk_files,
     .rows = "points of vtk/",
     .spacing = "every",
     .looks = true},
    {.name = "xyz",
     .asked = [](const Output& o) { return o.xyz.has_value(); },
     .add = [](Output& to, const Output& asked) { take(to.xyz, asked.xyz); },
     .settings =
         [](const Output& o) {
           return Json{{"every", o.xyz->every}};
         },
     .every = [](const Output& o) { return o.xyz->every; },
     .files = "trajectory.xyz",
     .rows = "rows of trajectory.xyz",
     .spacing = "every",
     .looks = true},
    {.name = "gltf",
     .asked = [](const Output& o) { return o.gltf.has_value(); },
     .add = [](Output& to, const Output& asked) { take(to.gltf, asked.gltf); },
     .settings =
         [](const Output& o) {
           return Json{{"fps", o.gltf->fps}};
         },
     .every = [](const Output& o) { return 1 / o.gltf->fps; },
     .files = "animation.glb",
     .rows = "keys of animation.glb",
     .spacing = "fps",
     .in_memory = true,
     .looks = true},
    {.name = "flights",
     .asked = [](const Output& o) { return o.flights; },
     .add = [](Output& to, const Output&) { to.flights = true; },
     .settings = [](const Output&) { return Json(true); },
     .files = "flights.bin"},
};

}  // namespace

std::string FileSeries::name(std::int64_t number) const {
  return fmt::format("{}{:05}{}", stem, number, ending);
}

bool FileSeries::has(std::string_view name) const {
  constexpr std::size_t digits = 5;
  if (!name.starts_with(stem) || !name.ends_with(ending) || name.size() < stem.size() + digits + ending.size())
    return false;
  const std::string_view number = name.substr(stem.size(), name.size() - stem.size() - ending.size());
  return std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool OutputKind::has_file(std::string_view file) const {
  const std::vector<std::string_view> all = parts_of(files);
  return std::find(all.begin(), all.end(), file) != all.end();
}

std::span<const OutputKind> output_kinds() {
  return output_table;
}

Output restricted(const Output& asked, const std::vector<std::string>& only) {
  Output output;
  for (const OutputKind& kind : output_table)
    if (std::find(only.begin(), only.end(), kind.name) != only.end()) kind.add(output, asked);
  return output;
}

bool holds_all(const Output& asked, const std::vector<std::string>& only) {
  return std::all_of(only.begin(), only.end(), [&](const std::string& name) {
    return std::any_of(std::begin(output_table), std::end(output_table),
                       [&](const OutputKind& kind) { return kind.name == name && kind.asked(asked); });
  });
}

Output with_all(const Output& asked) {
  Output output;
  for (const OutputKind& kind : output_table) kind.add(output, asked);
  return output;
}

std::vector<std::string> output_files(const Output& output) {
  std::vector<std::string> names;
  for (const OutputKind& kind : output_table) {
    if (!kind.asked(output)) continue;
    for (const std::string_view name : parts_of(kind.files)) names.emplace_back(name);
    if (kind.named) names.push_back(kind.named(output));
  }
  return names;
}

bool is_reserved(std::string_view name) {
  for (const std::string_view always : {"scene.yaml", "summary.csv", "manifest.json"})
    if (name == always) return true;
  return std::any_of(std::begin(output_table), std::end(output_table), [&](const OutputKind& kind) {
    return kind.has_file(name) || (!kind.series.folder.empty() && kind.series.folder == name);
  });
}

}  // namespace carom
