// Each measure says what has to be recorded, before the run. Its value is made from that at the end.
#include "run/measuring.h"

#include "physics/body_now.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

constexpr double undefined = numeric_limits<double>::quiet_NaN();

bool any_has(const vector<EntityRange>& ranges, Entity e) {
  return any_of(ranges, [&](const EntityRange& range) { return range.has(e); });
}

/// Whether it is an extreme, or a mean, along paths.
bool is_along_paths(MeasureForm form) {
  return form == MeasureForm::greatest || form == MeasureForm::least || form == MeasureForm::greatest_time ||
         form == MeasureForm::least_time || form == MeasureForm::mean;
}

bool is_of_region(MeasureForm form) {
  return form == MeasureForm::entries || form == MeasureForm::inside || form == MeasureForm::first_entry ||
         form == MeasureForm::first_entrant;
}

WatchedQuantity watched_by(const Measure& measure, const Scene& scene) {
  const EntityRange bodies = bodies_of(measure, scene);
  return {measure.quantity, bodies.first, bodies.count, window_of(measure, scene.measures.numbers),
          measure.form == MeasureForm::mean};
}

}  // namespace

Measuring::Measuring(const Scene& scene, vector<Measure> measures) : scene_(scene), measures_(std::move(measures)) {
  for (const Measure& measure : measures_) {
    try {
      prepare(measure);
      known_.push_back(true);
    } catch (const MeasureError&) {
      known_.push_back(false);
    }
  }
}

void Measuring::prepare(const Measure& measure) {
  for (const Measure& part : measure.parts) prepare(part);
  check_names(measure, scene_);

  if (is_along_paths(measure.form)) {
    const WatchedQuantity watched = watched_by(measure, scene_);
    if (!contains(watched_, watched)) watched_.push_back(watched);
  }
  if (is_of_region(measure.form) &&
      none_of(visits_, [&](const Visits& visits) { return visits.name == measure.things[0]; }))
    visits_.push_back({measure.things[0], regions_named(measure, scene_), 0, undefined});

  if (measure.form == MeasureForm::impulse)
    if (WatchedImpulse impulse = impulse_of(measure); !contains(impulses_, impulse))
      impulses_.push_back(std::move(impulse));

  if (measure.form != MeasureForm::first_hit && measure.form != MeasureForm::hits) return;
  const TimeWindow window = window_of(measure, scene_.measures.numbers);
  if (any_of(meetings_, [&](const Meeting& m) { return m.things == measure.things && m.window == window; })) return;
  Meeting meeting{measure.things, window, things_named(measure.things[0], measure, scene_), {}, 0, undefined};
  if (measure.things.size() > 1) meeting.b = things_named(measure.things[1], measure, scene_);
  meetings_.push_back(std::move(meeting));
}

void Measuring::record(span<const Collision> collisions, span<const RegionCrossing> crossings) {
  for (Visits& visits : visits_) {
    for (const RegionCrossing& c : crossings) {
      if (!std::binary_search(visits.regions.begin(), visits.regions.end(), c.region)) continue;
      visits.inside[{c.region, c.body}] = c.enters;
      if (!c.enters) continue;
      if (visits.entries == 0) visits.first = c.time, visits.entrant = c.body;
      ++visits.entries;
    }
  }

  for (Meeting& meeting : meetings_) {
    for (const Collision& c : collisions) {
      if (c.kind == CollisionKind::rest || !meeting.window.has(c.time)) continue;
      const auto has = [&](size_t name, bool first) {
        const vector<EntityRange>& named = name == 0 ? meeting.a : meeting.b;
        // A string that goes taut pulls at both of its bodies.
        const bool is_other = first && c.kind == CollisionKind::taut && any_has(named, scene_.world.second_body(c.b));
        return is_other || any_has(named, first ? c.a : c.b);
      };
      if (!meet(meeting.things.size(), has)) continue;
      if (meeting.count == 0) meeting.first = c.time;
      ++meeting.count;
    }
  }
}

vector<Measured> Measuring::values(const MeasuredRun& run) const {
  vector<Measured> values;
  for (size_t k = 0; k < measures_.size(); ++k) {
    const Measure& measure = measures_[k];
    Measured& measured = values.emplace_back();
    measured.name = measure.name;
    if (!known_[k]) continue;
    measured.value = value(measure, run);
    if (measure.is_text()) measured.text = first_entrant(measure);
  }
  return values;
}

double Measuring::at_end(const Measure& measure, Entity body, const State& end) const {
  if (is_gone(end, body)) return undefined;
  return quantity_of(measure.quantity, end.position[body], end.velocity[body], mass_now(scene_.world, end, body));
}

double Measuring::evaluated(const Measure& measure, const MeasuredRun& run) const {
  vector<double> values;
  for (const Measure& part : measure.parts) values.push_back(value(part, run));
  return formula_value(measure, values);
}

double Measuring::counted(const Measure& measure, const MeasuredRun& run) const {
  const double limit = evaluated(measure, run);
  const EntityRange bodies = bodies_of(measure, scene_);
  double count = 0;
  for (Entity i = bodies.first; i < bodies.first + bodies.count; ++i)
    count += compares(at_end(measure, i, run.state), measure.relation, limit) ? 1 : 0;
  return count;
}

WatchedImpulse Measuring::impulse_of(const Measure& measure) const {
  WatchedImpulse impulse{things_named(measure.things[0], measure, scene_), nullopt,
                         window_of(measure, scene_.measures.numbers)};
  if (measure.things.size() > 1) impulse.b = things_named(measure.things[1], measure, scene_);
  return impulse;
}

const Extremes& Measuring::extremes(const Measure& measure, const MeasuredRun& run) const {
  const auto found = ranges::find(watched_, watched_by(measure, scene_));
  return run.extremes[size_t(found - watched_.begin())];
}

/// Bodies inside a region that are still in the world.
double Measuring::inside(const Visits& visits, const State& end) const {
  double count = 0;
  for (const auto& [of, is_inside] : visits.inside) count += is_inside && !is_gone(end, of.second) ? 1 : 0;
  return count;
}

string Measuring::first_entrant(const Measure& measure) const {
  const auto found = ranges::find_if(visits_, [&](const Visits& v) { return v.name == measure.things[0]; });
  return found->entrant == no_entity ? string() : scene_.roster.name(found->entrant);
}

double Measuring::value(const Measure& measure, const MeasuredRun& run) const {
  const auto visits = [&]() -> const Visits& {
    return *ranges::find_if(visits_, [&](const Visits& v) { return v.name == measure.things[0]; });
  };
  const auto meeting = [&]() -> const Meeting& {
    const TimeWindow window = window_of(measure, scene_.measures.numbers);
    return *ranges::find_if(meetings_,
                            [&](const Meeting& m) { return m.things == measure.things && m.window == window; });
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
    case MeasureForm::mean:
      return extremes(measure, run).mean();
    case MeasureForm::impulse:
      return run.impulses[size_t(ranges::find(impulses_, impulse_of(measure)) - impulses_.begin())];

    case MeasureForm::first_hit:
      return meeting().first;
    case MeasureForm::hits:
      return meeting().count;

    case MeasureForm::entries:
      return visits().entries;
    case MeasureForm::inside:
      return inside(visits(), run.state);
    case MeasureForm::first_entry:
      return visits().first;

    case MeasureForm::count:
      return counted(measure, run);
    case MeasureForm::expression:
      return evaluated(measure, run);
    case MeasureForm::given:
      return scene_.measures.numbers.at(measure.things[0]);
    case MeasureForm::own:
      return value(*ranges::find_if(measures_, [&](const Measure& other) { return other.name == measure.things[0]; }),
                   run);

    default:
      return undefined;
  }
}

}  // namespace carom
