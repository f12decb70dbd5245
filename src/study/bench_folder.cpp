#include "study/bench_folder.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "export/csv.h"
#include "export/manifest.h"
#include "export/mesh_copies.h"
#include "study/engine.h"

namespace carom {

namespace {

using Json = nlohmann::ordered_json;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double least_deviation = 0.01;  // in the plot

Json outputs_json(const BenchOptions& options) {
  const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
  return {{"bench",
           {{"longest_step_s", number(options.longest)},
            {"shortest_step_s", number(options.shortest)},
            {"repeat", options.repeat},
            {"budget_s", options.budget},
            {"reference", options.reference ? Json(name_of(*options.reference)) : Json()}}}};
}

Json facts_json(const BenchResult& result) {
  const Differences& error = result.reference_error;
  Json reference = {{"engine", name_of(result.reference)}};
  if (result.reference == Engine::stepped) reference["integrator"] = name_of(Integrator::dop853);
  reference["position_error_m"] = error.position;
  reference["velocity_error_m_per_s"] = error.velocity;
  reference["energy_error_J"] = error.energy;
  return {{"reference", std::move(reference)},
          {"rounding_m", result.rounding},
          {"chaotic", result.chaotic},
          {"compared_until_s", result.horizon},
          {"ensemble", result.members},
          {"left_out", result.left_out},
          {"cpu_s", result.cpu_s}};
}

void write_table(OutputFile& file, const BenchResult& result) {
  file.write(
      "engine,integrator,step_s,cpu_s,position_error_m,velocity_error_m_per_s,energy_error_J,max_overlap_m,"
      "collisions_missed,collisions_invented,result_hash,status,repeats,collisions,compared_until_s,"
      "collision_rate_per_s,mean_speed_m_per_s,force_on_fixed_N,speed_distance,deviation,deviation_of\n");
  for (const BenchRow& row : result.rows) {
    const bool done = row.failure.empty(), errors = done && row.errors, statistics = done && result.chaotic;
    const auto if_any = [](bool there, double value) { return there ? value : nothing; };
    const Differences e = row.errors.value_or(Differences{});
    CsvRow cells(file);
    cells.text(name_of(row.engine)).text(row.engine == Engine::stepped ? name_of(row.integrator) : "");
    cells.number(row.step).number(if_any(done, row.cpu_s)).number(if_any(errors, e.position));
    cells.number(if_any(errors, e.velocity)).number(if_any(errors, e.energy)).number(if_any(done, row.max_overlap));
    cells.number(if_any(errors, static_cast<double>(e.missed)));
    cells.number(if_any(errors, static_cast<double>(e.invented)));
    cells.text(done ? fmt::format("{:016x}", row.hash) : "").text(done ? "done" : "failed");
    cells.number(if_any(done, row.repeats)).number(if_any(done, static_cast<double>(row.collisions)));
    cells.number(if_any(errors, result.horizon));
    cells.number(if_any(statistics, row.statistics.collision_rate));
    cells.number(if_any(statistics, row.statistics.mean_speed));
    cells.number(if_any(statistics, row.statistics.force_on_fixed));
    cells.number(if_any(statistics, row.speed_distance)).number(if_any(statistics, row.deviation.value));
    cells.text(statistics ? row.deviation.of : "").end();
  }
}

std::size_t look_of(const BenchRow& row) {
  return row.engine == Engine::exact  ? 0
         : row.engine == Engine::book ? 5
                                      : 1 + static_cast<std::size_t>(row.integrator);
}

/// "1/16 s", or a decimal where it is no such fraction.
std::string step_label(double step) {
  const double per_second = 1 / step;
  return per_second == std::round(per_second) && per_second < 1e7 ? fmt::format("1/{:.0f} s", per_second)
                                                                  : fmt::format("{:.2g} s", step);
}

std::string plot_subtitle(const BenchResult& result) {
  std::string text = result.reference == Engine::exact ? "error: from the exact engine's run; its own is estimated"
                                                       : "error: from a run by dop853; its own is estimated";
  if (result.chaotic)
    return fmt::format("a chaotic scene: from the mean of {} runs by the {} engine that differ by rounding",
                       result.members, name_of(result.reference));
  return text;
}

}  // namespace

Plot work_precision_plot(const Scene& scene, const BenchResult& result) {
  Plot plot;
  plot.title = valid_utf8(scene.title);
  plot.subtitle = plot_subtitle(result);
  plot.x_label = "CPU time of the run (s)";
  plot.y_label = result.chaotic ? "deviation of statistics (1: their spread by rounding)"
                                : "position error (m), greatest of all bodies and instants";
  plot.floor = result.chaotic ? least_deviation : rounding_of(scene);
  if (result.chaotic) plot.level = PlotLevel{"significant above", significant_deviation};
  if (!result.chaotic && result.reference == Engine::stepped)
    plot.level = PlotLevel{"reference's error", result.reference_error.position};
  for (const BenchRow& row : result.rows) {
    if (!row.failure.empty() || (!result.chaotic && !row.errors)) continue;
    const std::string name = method_name(row.engine, row.integrator);
    if (plot.series.empty() || plot.series.back().name != name) plot.series.push_back({name, look_of(row), {}});
    plot.series.back().points.push_back({row.cpu_s, result.chaotic ? row.deviation.value : row.errors->position});
    if (std::isfinite(row.step)) plot.series.back().points.back().label = step_label(row.step);
  }
  // The steps of the first and the last point tell those between.
  for (PlotSeries& series : plot.series)
    for (std::size_t k = 1; k + 1 < series.points.size(); ++k) series.points[k].label.clear();
  return plot;
}

FolderContent inspect_bench_folder(const std::string& folder, const Scene& scene, const BenchOptions& options) {
  std::vector<std::string> files = {"scene.yaml"};
  files.insert(files.end(), bench_files.begin(), bench_files.end());
  for (const MeshFile& mesh : scene.meshes)
    if (!mesh.copy.empty()) files.push_back(mesh.copy);
  Scene nothing_else;  // what a run of the scene would write is no part of a bench
  nothing_else.resolved = scene.resolved;
  nothing_else.meshes = scene.meshes;
  return inspect_folder(folder, nothing_else, outputs_json(options).dump(), files);
}

void BenchFolder::write(const Scene& scene, const BenchOptions& options, const BenchResult& result) {
  const PlotPictures pictures = draw_plot(work_precision_plot(scene, result), gnuplot_);
  std::vector<FileRecord> records = folder_.begin(scene, read_meshes(scene));
  const FilePlace& place = folder_.place();
  OutputFile table(place, bench_files[0]), png(place, bench_files[1]), svg(place, bench_files[2]);
  write_table(table, result);
  png.write(pictures.png);
  svg.write(pictures.svg);
  for (OutputFile* file : {&table, &png, &svg}) {
    file->complete();
    records.push_back(file->record());
  }
  OutputFile manifest(place, manifest_name);
  manifest.write(manifest_text(scene, outputs_json(options).dump(), facts_json(result).dump(), records));
  manifest.complete();
  folder_.publish({&table, &png, &svg}, manifest);
}

}  // namespace carom
