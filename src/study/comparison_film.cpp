// Takes the name and the start of each film from the manifest of its run, and labels it with its varied values.
// A label lists only parameters that vary independently, because the others follow from them.
#include "study/comparison_film.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "compare/comparison_plan.h"
#include "compare/outcomes.h"
#include "compare/stored_measures.h"
#include "files/folder_writer.h"
#include "files/manifest.h"
#include "files/run_folder.h"
#include "scene/film_format.h"
#include "scene/film_layout.h"
#include "scene/path_field.h"
#include "scene/sweep.h"
#include "std.h"
#include "study/sweep_folder.h"
#include "yaml/value_json.h"
#include "yaml/values.h"

namespace carom {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t most_labels = 4;  // values below a run's id

/// Commands after which the film of this run has another setting. A sweep refuses a run that was drawn again, so its
/// runs are drawn elsewhere.
string redrawing(const string& run, string_view setting) {
  const std::filesystem::path runs = std::filesystem::path(absolute(run)).parent_path();
  if (!is_sweep_file((runs.parent_path() / stored_sweep).string()))
    return fmt::format("carom render {} --set output.video.{}", run, setting);
  return fmt::format("carom render {} -o OTHER --set output.video.{}, then carom compare OTHER/* --video",
                     (std::filesystem::path(run).parent_path() / "*").string(), setting);
}

FilmTile tile_of(const ListedRun& run) {
  FilmTile tile{run.folder, {}, 0, {}};
  const Descriptor folder = open_folder(AT_FDCWD, run.folder, true);
  const auto manifest = folder ? read_manifest(folder.get(), manifest_name) : nullopt;
  const Json outputs = manifest ? json_of_text(manifest->outputs) : Json();

  if (!outputs.is_object() || !outputs.contains("video"))
    throw ExportError(
        fmt::format("{} has no film: run its scene again with the output `video` (--only video)", run.folder));

  const Json& video = outputs["video"];
  const auto damaged = [&] {
    return ExportError(fmt::format("{}/{} is damaged: carom run --force runs it again", run.folder, manifest_name));
  };
  if (!video.is_object()) throw damaged();

  const Json file = video.value("file", Json("animation.mp4")), from = video.value("from", Json(0.0)),
             speed = video.value("speed", Json(1.0)), fps = video.value("fps", Json(30.0)),
             title = video.value("title", Json(false));
  if (!file.is_string() || !is_plain_name(file.get<string>()) || !from.is_number() || !speed.is_number() ||
      !fps.is_number() || !title.is_boolean())
    throw damaged();

  tile.file = file.get<string>();
  tile.from = from.get<double>();
  tile.speed = speed.get<double>();
  VideoOutput settings;
  settings.fps = fps.get<double>();
  settings.title = title.get<bool>();
  tile.before = uint64_t(title_pictures(settings));

  // Each slows down around a collision of its own.
  if (const Json slow = video.value("slow", Json()); slow.is_object())
    throw ExportError(
        fmt::format("{} has a film that slows down around a collision, out of step with the others: draw "
                    "it at an even speed ({})",
                    run.folder, redrawing(run.folder, "slow=none")));

  if (film_format(tile.file) == FilmFormat::webp)
    throw ExportError(fmt::format("{} has a film that ffmpeg cannot read, {}: draw it as .mp4 ({})", run.folder,
                                  tile.file, redrawing(run.folder, "file=animation.mp4")));
  return tile;
}

void refuse_other_speed(const FilmTile& tile, const FilmTile& first) {
  if (tile.speed == first.speed) return;
  throw ExportError(fmt::format("the films of {} and {} have the speeds {} and {}: draw one of them again ({})",
                                first.folder, tile.folder, shortest(first.speed), shortest(tile.speed),
                                redrawing(tile.folder, "speed=" + shortest(first.speed))));
}

}  // namespace

vector<FilmTile> film_tiles(const RunSet& runs) {
  const size_t count = runs.runs().size();
  if (count > most_tiles)
    throw ExportError(fmt::format("a film shows at most {} runs side by side, not {}: name fewer, or leave --video out",
                                  most_tiles, count));

  // The parameters that no other determines.
  ComparisonPlan plan;
  plan.parameters = runs.parameters();
  Outcomes outcomes(plan, 0, count);
  for (size_t i = 0; i < count; ++i) outcomes.add(i, runs.run(i), true, {});
  outcomes.finish();
  const vector<size_t> varied = outcomes.independent();

  vector<FilmTile> tiles;
  vector<string> titles;
  for (size_t i = 0; i < count; ++i) {
    tiles.push_back(tile_of(runs.runs()[i]));
    refuse_other_speed(tiles.back(), tiles.front());
    titles.push_back(load_run_scene(runs.runs()[i].folder).title);
  }

  // Titles that tell the runs apart, or else their names, unless these are a sweep's numbers.
  const bool titled = any_of(titles, [&](const string& title) { return title != titles.front(); });
  for (size_t i = 0; i < count; ++i) {
    vector<string>& labels = tiles[i].labels;
    if (titled && !titles[i].empty())
      labels.push_back(titles[i]);
    else if (!runs.is_sweep() || varied.empty())
      labels.push_back(runs.runs()[i].id);

    const ComparedRun run = runs.run(i);
    for (size_t k = 0; k < min(varied.size(), most_labels); ++k) {
      const Parameter& parameter = plan.parameters[varied[k]];
      const string& value = run.values[varied[k]];
      if (!value.empty())
        labels.push_back(fmt::format("{} {}{}{}", words_of(parameter.path), value, parameter.unit.empty() ? "" : " ",
                                     parameter.unit));
    }
    if (labels.empty()) labels.push_back(runs.runs()[i].id);
  }
  return tiles;
}

}  // namespace carom
