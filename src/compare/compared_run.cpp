// Reads a run by its manifest, summary.csv and, for measures of bodies, the measures in the manifest.
// A measure that the run did not compute is derived from the last rows of trajectory.csv.
#include "compare/compared_run.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "files/manifest.h"
#include "files/open_folder.h"
#include "files/run_folder.h"
#include "files/stored_file.h"
#include "physics/world.h"
#include "render/mesh.h"
#include "run/stored_trajectory.h"
#include "scene/load.h"
#include "scene/scene.h"

namespace carom {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t motion_size = 6;

[[noreturn]] void refuse_run(const std::string& folder, const std::string& text) {
  throw ExportError(fmt::format("{} {}", folder, text));
}

std::vector<std::string> read_summary(const RunRecord& run) {
  StoredTable table = open_table(run, summary_name);
  const std::vector<std::string_view>* row = table.next();
  if (row == nullptr) refuse_run(run.run.folder, "has an empty summary.csv: run it again with --force");
  std::vector<std::string> cells;
  for (const SummaryColumn& column : summary_columns()) {
    const auto at = table.find(column.name);
    cells.emplace_back(at && *at < row->size() ? (*row)[*at] : std::string_view());
  }
  return cells;
}

/// A measure computed by the run itself, or null.
const Measured* find_measured(const std::optional<Manifest>& manifest, const std::string& name) {
  if (!manifest) return nullptr;
  const auto found = std::find_if(manifest->measures.begin(), manifest->measures.end(),
                                  [&](const Measured& measured) { return measured.name == name; });
  return found == manifest->measures.end() ? nullptr : &*found;
}

/// A measure of a body that is derived from its motion at the end alone.
double from_motion(const Measure& measure, const std::vector<EndMotion>& motions, const std::optional<Scene>& scene) {
  const auto motion =
      std::find_if(motions.begin(), motions.end(), [&](const EndMotion& m) { return m.body == measure.body; });
  if (motion == motions.end()) return undefined;
  double mass = 1;
  if (measure.quantity == Quantity::kinetic) {
    // Once bodies have merged, a trajectory does not contain the mass of a merged body.
    if (!scene || motions.size() != scene->world.body_count()) return undefined;
    mass = scene->world.mass[static_cast<std::size_t>(motion - motions.begin())];
  }
  return quantity_of(measure.quantity, motion->position, motion->velocity, mass);
}

void read_measures(RunRecord& run, const std::vector<Measure>& measures) {
  const bool of_bodies = std::any_of(measures.begin(), measures.end(), [](const Measure& m) { return !m.column; });
  const auto known = of_bodies ? read_manifest(run.folder.get(), manifest_name) : std::nullopt;
  std::optional<std::vector<EndMotion>> motions;
  std::optional<Scene> scene;
  for (const Measure& measure : measures) {
    if (measure.column != nullptr) {
      const auto column = static_cast<std::size_t>(measure.column - summary_columns().data());
      run.measures.push_back(number_in(run.summary[column]).value_or(undefined));
      continue;
    }
    if (const Measured* found = find_measured(known, measure.name)) {
      run.measures.push_back(found->value);
      continue;
    }
    if (!motions) {
      if (!has_file(run, "trajectory.csv"))
        refuse_run(run.run.folder,
                   fmt::format("has no trajectory.csv, needed for {}: run its scene.yaml again with the "
                               "output `trajectory`",
                               measure.name));
      motions = end_of_trajectory(run);
    }
    if (measure.quantity == Quantity::kinetic && !scene) scene = load_run_scene(run.run.folder);
    run.measures.push_back(from_motion(measure, *motions, scene));
  }
}

}  // namespace

StoredTable open_table(const RunRecord& run, const char* name) {
  Descriptor file = open_stored(run.folder.get(), name);
  if (!file) refuse_run(run.run.folder, fmt::format("has no {}", name));
  return StoredTable(std::move(file));
}

bool has_file(const RunRecord& run, const char* name) {
  return stored_size(run.folder.get(), name).has_value();
}

bool has_measures(const std::string& path, const std::vector<Measure>& measures) {
  if (std::all_of(measures.begin(), measures.end(), [](const Measure& m) { return m.column != nullptr; })) return true;
  const Descriptor folder = open_folder(AT_FDCWD, path, true);
  if (!folder) return false;
  if (stored_size(folder.get(), "trajectory.csv")) return true;
  const auto manifest = read_manifest(folder.get(), manifest_name);
  return std::all_of(measures.begin(), measures.end(), [&](const Measure& measure) {
    return measure.column != nullptr || find_measured(manifest, measure.name) != nullptr;
  });
}

RunRecord read_run(ComparedRun run, const std::vector<Measure>& measures) {
  RunRecord record{std::move(run), false, Descriptor(), {}, {}};
  record.folder = open_folder(AT_FDCWD, record.run.folder, true);
  if (!record.folder && !record.run.failed) refuse_run(record.run.folder, "cannot be opened: there is no such folder");
  record.done = !record.run.failed && has_file(record, manifest_name) && has_file(record, summary_name);
  if (!record.done && !record.run.failed && !has_file(record, failure_file))
    refuse_run(record.run.folder, "holds no whole run: run its scene again, or leave it out");
  if (!record.done) {
    record.summary.assign(summary_columns().size(), "");
    record.measures.assign(measures.size(), undefined);
    return record;
  }
  record.summary = read_summary(record);
  read_measures(record, measures);
  return record;
}

MotionColumns motion_columns(const StoredTable& trajectory, const std::vector<std::string>& bodies) {
  MotionColumns columns;
  if (const auto body = trajectory.find("body")) {
    columns.body = *body;
    return columns;
  }
  columns.wide = true;
  for (const std::string& body : bodies)
    columns.first.push_back(trajectory.find(fmt::format("{}.{}", body, name_of(Quantity::x))).value_or(0));
  return columns;
}

std::vector<EndMotion> end_of_trajectory(const RunRecord& run) {
  const StoredTable table = open_table(run, "trajectory.csv");
  const Descriptor file = open_stored(run.folder.get(), "trajectory.csv");
  const bool wide = !table.find("body");
  std::vector<EndMotion> motions;
  std::vector<std::string_view> cells;
  std::string unquoted, last_time;
  lines_from_end(file.get(), [&](std::string_view line) {
    split_cells(line, cells, unquoted);
    if (wide) {
      for (std::size_t first = 1; first + motion_size <= table.columns().size(); first += motion_size) {
        const std::string& column = table.columns()[first];
        EndMotion motion{column.substr(0, column.size() - 1 - name_of(Quantity::x).size()), {}, {}};
        if (read_motion(cells, first, motion.position, motion.velocity)) motions.push_back(std::move(motion));
      }
      return false;
    }
    if (cells.size() < 2 + motion_size) return true;
    if (last_time.empty()) last_time = cells[0];
    if (cells[0] != last_time) return false;
    EndMotion motion{std::string(cells[1]), {}, {}};
    if (read_motion(cells, 2, motion.position, motion.velocity)) motions.push_back(std::move(motion));
    return true;
  });
  if (!wide) std::reverse(motions.begin(), motions.end());
  return motions;
}

Scene load_run_scene(const std::string& folder) {
  LoadOptions options;
  options.budget.enforced = false;
  options.mesh_points = [](const std::string& path) { return read_mesh_points(path); };
  return load_scene(folder + "/scene.yaml", options);
}

}  // namespace carom
