// Writes the rows and the work-precision plot of a bench, and its manifest.
// Points of the stepped engine with the same bits as the exact engine's are left out, because they are that engine's.
#include "bench/bench_folder.h"

#include <fmt/format.h>

#include <deque>

#include "bench/shifted.h"
#include "engine/engine.h"
#include "export/gnuplot.h"
#include "files/csv.h"
#include "files/manifest.h"
#include "files/mesh_copies.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/value_json.h"

namespace carom {

namespace {

using Json = nlohmann::ordered_json;

// In the plot.
constexpr double least_deviation = 0.01;

Json outputs_json(const BenchOptions& options) {
  const auto number = [](const optional<double>& value) { return value ? Json(*value) : Json(); };
  return {{"bench",
           {{"longest_step_s", number(options.longest)},
            {"shortest_step_s", number(options.shortest)},
            {"repeat", options.repeat},
            {"budget_s", options.budget},
            {"reference", options.reference ? Json(name_of(*options.reference)) : Json()}}}};
}

Json facts_json(const BenchResult& result) {
  const Differences& error = result.reference_error;
  Json reference = method_json(result.reference);
  reference["position_error_m"] = error.position;
  reference["velocity_error_m_per_s"] = error.velocity;
  reference["energy_error_J"] = error.energy;
  reference["held_against"] = witnesses_json(result.witnesses);

  return {{"reference", std::move(reference)},
          {"rounding_m", result.rounding},
          {"chaotic", result.chaotic},
          {"compared_until_s", result.horizon},
          {"ensemble", result.members},
          {"left_out", result.left_out},
          {"cpu_s", result.cpu_s}};
}

/// A row for each object, with its members of these names. A cell is empty where it has none.
void write_table(OutputFile& file, span<const char* const> columns, const vector<Json>& rows) {
  CsvRow cells(file);
  for (const char* name : columns) cells.text(name);
  cells.end();
  for (const Json& row : rows) {
    for (const char* name : columns) {
      const Json value = row.value(name, Json(""));
      value.is_string() ? cells.text(value.get<string>()) : cells.number(value.get<double>());
    }
    cells.end();
  }
}

/// Of bench.csv and of qualities.csv.
constexpr const char* row_columns[] = {"engine",
                                       "integrator",
                                       "step_s",
                                       "cpu_s",
                                       "position_error_m",
                                       "velocity_error_m_per_s",
                                       "energy_error_J",
                                       "max_overlap_m",
                                       "collisions_missed",
                                       "collisions_invented",
                                       "result_hash",
                                       "status",
                                       "repeats",
                                       "collisions",
                                       "compared_until_s",
                                       "collision_rate_per_s",
                                       "mean_speed_m_per_s",
                                       "force_on_fixed_N",
                                       "speed_distance",
                                       "deviation",
                                       "deviation_of",
                                       "step_error",
                                       "reference_error_m"};

constexpr const char* quality_columns[] = {"quality",           "cpu_s",        "runs",          "dissipated_error",
                                           "dissipated_spread", "height_error", "height_spread", "contact_made_J",
                                           "unsolved_steps",    "max_overlap_m"};

vector<Json> rows_of(const BenchResult& result) {
  vector<Json> rows;
  for (const BenchRow& row : result.rows) {
    Json& json = rows.emplace_back(row_json(row, result.chaotic));
    if (!row.failure.empty() || !row.errors) continue;
    json["compared_until_s"] = result.horizon;
    json["reference_error_m"] = result.reference_error.position;
  }
  return rows;
}

vector<Json> rows_of(const QualityCurve& curve) {
  vector<Json> rows;
  for (const QualityRow& row : curve.rows) rows.emplace_back(quality_json(row))["runs"] = curve.runs;
  return rows;
}

/// One curve of the errors over run time. The reference has none.
PlotSeries quality_series(const QualityCurve& curve, string name, size_t style, MeanError QualityRow::*error) {
  PlotSeries series{std::move(name), style, {}};
  for (size_t k = 0; k + 1 < curve.rows.size(); ++k) {
    const QualityRow& row = curve.rows[k];
    const MeanError& of = row.*error;
    if (!isfinite(of.value)) continue;
    const double size = std::abs(of.value);
    series.points.push_back({row.cpu_s, size, string(name_of(row.level)), size - of.spread, size + of.spread});
  }
  return series;
}

size_t style_of(const SimulationMethod& method) {
  return method.engine == Engine::exact ? 0 : method.engine == Engine::book ? 5 : 1 + size_t(method.integrator);
}

string plot_subtitle(const BenchResult& result) {
  if (result.chaotic)
    return fmt::format("a chaotic scene: from the mean of {} runs by the {} engine that differ by rounding",
                       result.members, name_of(result.reference.engine));
  return fmt::format("error: distance from a run by {}; bars: that run's own error", full_name_of(result.reference));
}

PlotPoint point_of(const BenchRow& row, const BenchResult& result) {
  PlotPoint point{row.cpu_s, result.chaotic ? row.deviation.value : row.errors->position, steps_text(row.method)};
  if (result.chaotic) return point;
  point.low = point.y - result.reference_error.position;
  point.high = point.y + result.reference_error.position;
  return point;
}

bool has_exact_bits(const BenchRow& row, const BenchRow& first) {
  return row.method.engine == Engine::stepped && first.method.engine == Engine::exact && row.hash == first.hash;
}

vector<PlotLevel> levels_of(const BenchResult& result) {
  if (result.chaotic) return {{"significant above", significant_deviation}};
  return {{"limit of rounding", result.rounding}};
}

}  // namespace

nlohmann::ordered_json method_json(const SimulationMethod& method) {
  Json json = {{"engine", name_of(method.engine)}};
  if (method.engine == Engine::stepped) json["integrator"] = name_of(method.integrator);
  if (method.steps.length) json["step_s"] = *method.steps.length;
  if (method.steps.error > 0) json["step_error"] = method.steps.error;
  return json;
}

nlohmann::ordered_json witnesses_json(const vector<Witness>& witnesses) {
  Json list = Json::array();
  for (const Witness& witness : witnesses) {
    Json json = method_json(witness.method);
    json["apart_m"] = witness.apart;
    json["agrees"] = witness.agrees;
    list.push_back(std::move(json));
  }
  return list;
}

nlohmann::ordered_json differences_json(const Differences& errors) {
  return {{"position_error_m", errors.position},
          {"velocity_error_m_per_s", errors.velocity},
          {"energy_error_J", errors.energy},
          {"collisions_missed", errors.missed},
          {"collisions_invented", errors.invented}};
}

nlohmann::ordered_json statistics_json(const Statistics& s) {
  return {{"collision_rate_per_s", s.collision_rate},
          {"mean_speed_m_per_s", s.mean_speed},
          {"force_on_fixed_N", s.force_on_fixed}};
}

nlohmann::ordered_json row_json(const BenchRow& row, bool chaotic) {
  Json json = method_json(row.method);
  json["status"] = row.failure.empty() ? "done" : "failed";
  if (!row.failure.empty()) return json;

  json["cpu_s"] = row.cpu_s;
  json["repeats"] = row.repeats;
  if (row.errors) json.update(differences_json(*row.errors));
  json["max_overlap_m"] = row.max_overlap;
  json["collisions"] = row.collisions;
  json["result_hash"] = fmt::format("{:016x}", row.hash);

  if (!chaotic) return json;
  json.update(statistics_json(row.statistics));
  json["speed_distance"] = row.speed_distance;
  json["deviation"] = row.deviation.value;
  json["deviation_of"] = row.deviation.of;
  return json;
}

nlohmann::ordered_json quality_json(const QualityRow& row) {
  return {{"quality", name_of(row.level)},
          {"cpu_s", row.cpu_s},
          {"dissipated_error", row.dissipated.value},
          {"dissipated_spread", row.dissipated.spread},
          {"height_error", row.height.value},
          {"height_spread", row.height.spread},
          {"contact_made_J", row.made},
          {"unsolved_steps", row.unsolved},
          {"max_overlap_m", row.max_overlap}};
}

Plot work_precision_plot(const Scene& scene, const BenchResult& result) {
  Plot plot;
  plot.title = valid_utf8(scene.title);
  plot.subtitle = plot_subtitle(result);
  plot.x_label = "CPU time of the run (s)";
  plot.y_label = result.chaotic ? "deviation of statistics (1: their spread by rounding)"
                                : "position error (m), greatest of all bodies and instants";
  plot.floor = result.chaotic ? least_deviation : rounding_of(scene.world, scene.initial);
  plot.levels = levels_of(result);

  // Integrators of which runs have the same bits as the exact engine's. They share its point.
  set<string> exact;
  for (const BenchRow& row : result.rows) {
    if (!row.failure.empty() || (!result.chaotic && !row.errors)) continue;
    if (has_exact_bits(row, result.rows.front())) {
      exact.emplace(name_of(row.method.integrator));
      continue;
    }
    const string name = name_of(row.method);
    if (plot.series.empty() || plot.series.back().name != name) plot.series.push_back({name, style_of(row.method), {}});
    plot.series.back().points.push_back(point_of(row, result));
  }

  if (exact.size() == 3) exact = {"stepped"};
  for (const string& name : exact) plot.series.front().name += ", " + name;
  // The labels of the first and the last point suffice for those between.
  for (PlotSeries& series : plot.series)
    for (size_t k = 1; k + 1 < series.points.size(); ++k) series.points[k].label.clear();
  return plot;
}

Plot quality_plot(const Scene& scene, const QualityCurve& curve) {
  Plot plot;
  plot.title = valid_utf8(scene.title);
  plot.subtitle = fmt::format("means of {} runs, against those at quality {}; bars: standard errors", curve.runs,
                              name_of(curve.rows.back().level));
  plot.x_label = "CPU time of the run (s)";
  plot.y_label = "share of the whole";
  plot.floor = 1e-5;

  plot.series.push_back(quality_series(curve, "energy lost", 0, &QualityRow::dissipated));
  plot.series.push_back(quality_series(curve, "height of the heap", 1, &QualityRow::height));
  for (PlotPoint& point : plot.series.back().points) point.label.clear();
  return plot;
}

FolderContent inspect_bench_folder(const string& folder, const Scene& scene, const BenchOptions& options,
                                   FolderChanges* changes) {
  vector<string> files = {"scene.yaml"};
  files.insert(files.end(), bench_files.begin(), bench_files.end());
  for (const MeshFile& mesh : scene.meshes)
    if (!mesh.copy.empty()) files.push_back(mesh.copy);

  // The outputs of a run of the scene are not part of a bench.
  Scene nothing_else;
  nothing_else.resolved = scene.resolved;
  nothing_else.meshes = scene.meshes;
  return inspect_folder(folder, nothing_else, text_of_json(outputs_json(options)), files, changes);
}

void BenchFolder::write(const Scene& scene, const BenchOptions& options, const BenchResult& result) {
  const bool has_qualities = !result.qualities.rows.empty();
  vector<Plot> plots = {work_precision_plot(scene, result)};
  if (has_qualities) plots.push_back(quality_plot(scene, result.qualities));
  const vector<PlotPictures> pictures = draw_plots(plots, gnuplot_);

  vector<FileRecord> records = folder_.begin(scene, read_meshes(scene));
  const FilePlace& place = folder_.place();
  std::deque<OutputFile> files;
  for (size_t k = 0; k < 3 * plots.size(); ++k) files.emplace_back(place, bench_files[k]);

  write_table(files[0], row_columns, rows_of(result));
  if (has_qualities) write_table(files[3], quality_columns, rows_of(result.qualities));

  vector<PartFile*> written;
  for (size_t k = 0; k < files.size(); ++k) {
    if (k % 3 == 1) files[k].write(pictures[k / 3].png);
    if (k % 3 == 2) files[k].write(pictures[k / 3].svg);
    files[k].complete();
    records.push_back(files[k].record());
    written.push_back(&files[k]);
  }

  OutputFile manifest(place, manifest_name);
  manifest.write(manifest_text(scene, text_of_json(outputs_json(options)), text_of_json(facts_json(result)), records));
  manifest.complete();
  folder_.publish(written, manifest);
}

}  // namespace carom
