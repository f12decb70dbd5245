// Each measure says what has to be recorded, before the run. Its value is made from that at the end.
#include "run/measuring.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/body_now.h"
#include "scene/scene.h"

namespace carom {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

bool any_has(const std::vector<EntityRange>& ranges, Entity e) {
  return std::any_of(ranges.begin(), ranges.end(), [&](const EntityRange& range) { return range.has(e); });
}

bool is_extreme(MeasureForm form) {
  return form == MeasureForm::greatest || form == MeasureForm::least || form == MeasureForm::greatest_time ||
         form == MeasureForm::least_time;
}

WatchedQuantity watched_by(const Measure& measure, const Scene& scene) {
  const EntityRange bodies = bodies_of(measure, scene);
  return {measure.quantity, bodies.first, bodies.count};
}

}  // namespace

Measuring::Measuring(const Scene& scene, std::vector<Measure> measures)
    : scene_(scene), measures_(std::move(measures)) {
  for (const Measure& measure : measures_) prepare(measure);
}

void Measuring::prepare(const Measure& measure) {
  for (const Measure& part : measure.parts) prepare(part);
  if (measure.form == MeasureForm::at_end || measure.form == MeasureForm::count) bodies_of(measure, scene_);
  if (is_extreme(measure.form)) {
    const WatchedQuantity watched = watched_by(measure, scene_);
    if (std::find(watched_.begin(), watched_.end(), watched) == watched_.end()) watched_.push_back(watched);
  }
  if (measure.form != MeasureForm::first_hit && measure.form != MeasureForm::hits) return;
  if (std::any_of(meetings_.begin(), meetings_.end(), [&](const Meeting& m) { return m.things == measure.things; }))
    return;
  Meeting meeting{measure.things, things_named(measure.things[0], measure, scene_), {}, 0, undefined};
  if (measure.things.size() > 1) meeting.b = things_named(measure.things[1], measure, scene_);
  meetings_.push_back(std::move(meeting));
}

void Measuring::record(std::span<const Collision> collisions) {
  for (Meeting& meeting : meetings_) {
    for (const Collision& c : collisions) {
      if (c.kind == CollisionKind::rest) continue;
      const auto has = [&](const std::string& name, bool first) {
        return any_has(name == meeting.things[0] ? meeting.a : meeting.b, first ? c.a : c.b);
      };
      if (!meet(meeting.things, has)) continue;
      if (meeting.count == 0) meeting.first = c.time;
      ++meeting.count;
    }
  }
}

std::vector<Measured> Measuring::values(const RunEnd& run) const {
  std::vector<Measured> values;
  for (const Measure& measure : measures_) {
    Measured& measured = values.emplace_back(measure.name);
    measured.value = value(measure, run);
  }
  return values;
}

double Measuring::at_end(const Measure& measure, Entity body, const State& end) const {
  if (is_part_of_another(end, body)) return undefined;
  return quantity_of(measure.quantity, end.position[body], end.velocity[body], mass_now(scene_.world, end, body));
}

double Measuring::evaluated(const Measure& measure, const RunEnd& run) const {
  std::vector<double> values;
  for (const Measure& part : measure.parts) values.push_back(value(part, run));
  return formula_value(measure, values);
}

double Measuring::counted(const Measure& measure, const RunEnd& run) const {
  const double limit = evaluated(measure, run);
  const EntityRange bodies = bodies_of(measure, scene_);
  double count = 0;
  for (Entity i = bodies.first; i < bodies.first + bodies.count; ++i)
    count += compares(at_end(measure, i, run.state), measure.relation, limit) ? 1 : 0;
  return count;
}

const Extremes& Measuring::extremes(const Measure& measure, const RunEnd& run) const {
  const auto found = std::find(watched_.begin(), watched_.end(), watched_by(measure, scene_));
  return run.extremes[static_cast<std::size_t>(found - watched_.begin())];
}

double Measuring::value(const Measure& measure, const RunEnd& run) const {
  const auto meeting = [&]() -> const Meeting& {
    return *std::find_if(meetings_.begin(), meetings_.end(),
                         [&](const Meeting& m) { return m.things == measure.things; });
  };
  switch (measure.form) {
    case MeasureForm::column:
      return measure.column->number(run.summary);
    case MeasureForm::at_end:
      return at_end(measure, bodies_of(measure, scene_).first, run.state);
    case MeasureForm::greatest:
      return extremes(measure, run).greatest.value;
    case MeasureForm::least:
      return extremes(measure, run).least.value;
    case MeasureForm::greatest_time:
      return extremes(measure, run).greatest.time;
    case MeasureForm::least_time:
      return extremes(measure, run).least.time;
    case MeasureForm::first_hit:
      return meeting().first;
    case MeasureForm::hits:
      return meeting().count;
    case MeasureForm::count:
      return counted(measure, run);
    case MeasureForm::expression:
      return evaluated(measure, run);
    case MeasureForm::given:
      return scene_.numbers.at(measure.things[0]);
    case MeasureForm::own:
      return value(*std::find_if(measures_.begin(), measures_.end(),
                                 [&](const Measure& other) { return other.name == measure.things[0]; }),
                   run);
    default:
      return undefined;
  }
}

}  // namespace carom
