// What a run measured itself is in its manifest. Other measures of the end come from the last rows of trajectory.csv,
// those of collisions from collisions.csv. Extremes over a run are not stored: the run has to measure them.
#include "compare/stored_measures.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "files/run_folder.h"
#include "files/stored_file.h"
#include "files/stored_table.h"
#include "files/summary_columns.h"
#include "render/mesh.h"
#include "run/measure_scope.h"
#include "run/stored_trajectory.h"
#include "scene/formula.h"
#include "scene/load.h"
#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/value_json.h"

namespace carom {
namespace {

constexpr double undefined = numeric_limits<double>::quiet_NaN();

/// The file from which a measure can be derived. Null: from none.
const char* table_of(const Measure& measure) {
  switch (measure.form) {
    case MeasureForm::at_end:
    case MeasureForm::count:
      return "trajectory.csv";

    case MeasureForm::first_hit:
    case MeasureForm::hits:
      return "collisions.csv";

    case MeasureForm::entries:
    case MeasureForm::inside:
    case MeasureForm::first_entry:
    case MeasureForm::first_entrant:
      return "regions.csv";

    default:
      return nullptr;
  }
}

}  // namespace

Scene load_run_scene(const string& folder) {
  LoadOptions options;
  options.budget.enforced = false;
  options.mesh_points = [](const string& path) { return read_mesh_points(path); };
  return load_scene(folder + "/scene.yaml", options);
}

const Manifest* StoredMeasures::manifest() {
  if (!manifest_) manifest_ = read_manifest(folder_, manifest_name);
  return *manifest_ ? &**manifest_ : nullptr;
}

const Measured* StoredMeasures::measured(const string& name) {
  const Manifest* of = manifest();
  if (of == nullptr) return nullptr;
  const auto found = ranges::find_if(of->measures, [&](const Measured& one) { return one.name == name; });
  return found == of->measures.end() ? nullptr : &*found;
}

bool StoredMeasures::has_file(const char* name) const {
  return stored_table(folder_, name).has_value();
}

const Scene& StoredMeasures::scene() {
  if (!scene_) scene_ = load_run_scene(path_);
  return *scene_;
}

const vector<EndMotion>& StoredMeasures::ends() {
  if (ends_) return *ends_;
  TrajectoryEnd end = end_of_trajectory(folder_);
  // The last rows are those of the end, unless no body is left then.
  if (end.time < duration_) end.bodies.clear();
  ends_ = std::move(end.bodies);
  return *ends_;
}

bool StoredMeasures::has(const Measure& measure) {
  if (measure.form == MeasureForm::column || measured(measure.name) != nullptr) return true;
  if (!all_of(measure.parts, [this](const Measure& part) { return has(part); })) return false;
  if (measure.form == MeasureForm::expression || measure.form == MeasureForm::given) return true;
  const char* table = table_of(measure);
  return table != nullptr && has_file(table) && lacking(measure).empty();
}

/// The bodies that trajectory.csv has rows of, if these are not all that the measure names. Empty: they are.
string StoredMeasures::lacking(const Measure& measure) {
  if (measure.form != MeasureForm::at_end && measure.form != MeasureForm::count) return {};

  // The manifest says whether it may be so, and is read sooner than a scene.
  const Manifest* of = manifest();
  const auto outputs = of == nullptr ? nlohmann::ordered_json() : json_of_text(of->outputs);
  const auto table = outputs.is_object() ? outputs.find("trajectory") : outputs.end();
  if (table == outputs.end() || !table->is_object() || !table->contains("on") || (*table)["on"].is_null()) return {};

  const string some = bodies_in_table(scene());
  if (some.empty()) return {};
  const vector<Entity>& written = scene().requested.trajectory->bodies;
  try {
    const EntityRange named = bodies_of(measure, scene());
    for (Entity i = named.first; i < named.first + named.count; ++i)
      if (!std::binary_search(written.begin(), written.end(), i)) return some;
  } catch (const MeasureError&) {
    // The scene does not have them. Their measure is undefined.
  }
  return {};
}

bool StoredMeasures::have(span<const Measure> measures) {
  return all_of(measures, [this](const Measure& measure) { return has(measure); });
}

Measured StoredMeasures::value(const Measure& measure, const vector<string>& summary) {
  if (measure.form != MeasureForm::column)
    if (const Measured* known = measured(measure.name)) return *known;
  Measured value{measure.name, number(measure, summary), {}};
  if (measure.is_text()) value.text = visits(measure).entrant;
  return value;
}

double StoredMeasures::number(const Measure& measure, const vector<string>& summary) {
  static const auto duration = size_t(find_summary_column("duration_s") - summary_columns().data());
  duration_ = number_in(summary[duration]).value_or(0);
  if (measure.form == MeasureForm::column) {
    const auto column = size_t(measure.column - summary_columns().data());
    return number_in(summary[column]).value_or(undefined);
  }

  if (const Measured* known = measured(measure.name)) return known->value;
  if (const char* table = table_of(measure); table != nullptr && !has_file(table))
    throw ExportError(fmt::format(
        "{} has no {}, needed for {}: run its scene.yaml again with that output, or with the measure in `measures`",
        path_, table, measure.name));
  if (const string some = lacking(measure); !some.empty())
    throw ExportError(
        fmt::format("{}/trajectory.csv has rows of {} alone, which {} needs more of: run its scene.yaml "
                    "again without `on` in `trajectory`, or with the measure in `measures`",
                    path_, some, measure.name));

  switch (measure.form) {
    case MeasureForm::at_end:
      return at_end(measure);
    case MeasureForm::count:
      return counted(measure, summary);
    case MeasureForm::first_hit:
      return meetings(measure).first;
    case MeasureForm::hits:
      return meetings(measure).count;

    case MeasureForm::entries:
      return visits(measure).entries;
    case MeasureForm::inside:
      return visits(measure).inside;
    case MeasureForm::first_entry:
      return visits(measure).first;
    case MeasureForm::first_entrant:
      return undefined;

    case MeasureForm::expression:
      return evaluated(measure, summary);
    case MeasureForm::given: {
      const auto found = scene().measures.numbers.find(measure.things[0]);
      return found == scene().measures.numbers.end() ? undefined : found->second;
    }
    case MeasureForm::own:
      return undefined;

    default:
      throw ExportError(
          fmt::format("{} did not measure {}: run its scene.yaml again with this in `measures`", path_, measure.name));
  }
}

double StoredMeasures::quantity(const Measure& measure, size_t body) {
  const EndMotion& motion = ends()[body];
  double mass = 1;
  if (measure.quantity == Quantity::kinetic) {
    // Once bodies have merged or left, a trajectory does not contain their masses.
    if (ends().size() != scene().world.body_count()) return undefined;
    mass = scene().world.mass[body];
  }
  return quantity_of(measure.quantity, motion.position, motion.velocity, mass);
}

double StoredMeasures::at_end(const Measure& measure) {
  const auto found =
      std::find_if(ends().begin(), ends().end(), [&](const EndMotion& m) { return m.body == measure.body; });
  return found == ends().end() ? undefined : quantity(measure, size_t(found - ends().begin()));
}

double StoredMeasures::counted(const Measure& measure, const vector<string>& summary) {
  const double limit = evaluated(measure, summary);
  double count = 0;
  for (size_t i = 0; i < ends().size(); ++i)
    if (measure.body.empty() || is_named(ends()[i].body, measure.body))
      count += compares(quantity(measure, i), measure.relation, limit) ? 1 : 0;
  return count;
}

double StoredMeasures::evaluated(const Measure& measure, const vector<string>& summary) {
  vector<double> values;
  for (const Measure& part : measure.parts) values.push_back(number(part, summary));
  return formula_value(measure, values);
}

string StoredMeasures::second_body(string_view string) {
  const vector<std::string>& names = scene().roster.strings;
  const auto found = ranges::find(names, string);
  if (found == names.end()) return {};
  const Entity other = scene().world.strings[size_t(found - names.begin())].other;
  return other == no_entity ? std::string() : scene().roster.name(other);
}

StoredMeasures::Meetings StoredMeasures::meetings(const Measure& measure) {
  StoredTable table(open_stored_table(folder_, "collisions.csv"));
  const auto time = table.find("time_s"), kind = table.find("kind"), a = table.find("a"), b = table.find("b");
  Meetings found{0, undefined};
  const bool named = measure.from.starts_with("let.") || measure.until.starts_with("let.");
  const TimeWindow window = window_of(measure, named ? scene().measures.numbers : map<string, double>{});

  while (table.next() != nullptr) {
    if (table.cell(kind) == "rest") continue;
    if (!window.has(number_in(table.cell(time)).value_or(undefined))) continue;
    // A string that goes taut pulls at both of its bodies.
    const string other = table.cell(kind) == "string" ? second_body(table.cell(b)) : string();
    const auto has = [&](size_t name, bool first) {
      return is_named(table.cell(first ? a : b), measure.things[name]) ||
             (first && is_named(other, measure.things[name]));
    };

    if (!meet(measure.things.size(), has)) continue;
    if (found.count == 0) found.first = number_in(table.cell(time)).value_or(undefined);
    ++found.count;
  }
  return found;
}

StoredMeasures::Visits StoredMeasures::visits(const Measure& measure) {
  StoredTable table(open_stored_table(folder_, "regions.csv"));
  const auto time = table.find("time_s"), region = table.find("region"), body = table.find("body"),
             what = table.find("what");
  Visits found{0, 0, undefined, {}};

  // A body is removed where it enters such a region, and is then inside of none.
  set<string> removing;
  for (size_t r = 0; r < scene().world.regions.size(); ++r)
    if (scene().world.regions[r].removes) removing.insert(scene().roster.regions[r]);
  set<pair<string, string>> inside;  // region, body

  while (table.next() != nullptr) {
    const string in(table.cell(region)), who(table.cell(body));
    const bool enters = table.cell(what) == "enter";
    if (enters && removing.contains(in)) std::erase_if(inside, [&](const auto& of) { return of.second == who; });

    if (!is_named(in, measure.things[0])) continue;
    if (!enters) inside.erase({in, who});
    if (enters && !removing.contains(in)) inside.insert({in, who});

    if (!enters) continue;
    if (found.entries == 0) found.first = number_in(table.cell(time)).value_or(undefined), found.entrant = who;
    ++found.entries;
  }

  found.inside = double(inside.size());
  return found;
}

}  // namespace carom
