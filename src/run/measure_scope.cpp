// Looks names up in the scene's roster, where the members of a group are name.0, name.1, ...
#include "run/measure_scope.h"

#include <fmt/format.h>

#include <charconv>

#include "scene/engines.h"
#include "scene/formula.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/joined.h"
#include "yaml/values.h"

namespace carom {
namespace {

const BodyRange* find_range(const Scene& scene, string_view name) {
  const auto& bodies = scene.roster.bodies;
  const auto found = ranges::find_if(bodies, [&](const BodyRange& range) { return range.name == name; });
  return found == bodies.end() ? nullptr : &*found;
}

/// Whether a thing of this name has no members, and `fits`(the key that it stands under).
template <typename Fits>
bool is_empty(const Scene& scene, string_view name, const Fits& fits) {
  const auto& empty = scene.roster.empty;
  return any_of(empty, [&](const EmptyFamily& e) { return e.name == name && fits(e.of); });
}

/// The member "17" of a group. Throws MeasureError.
EntityRange member_of(const BodyRange& range, string_view number, const Measure& measure) {
  Entity member = 0;
  const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), member);
  if (error != std::errc() || stop != number.data() + number.size() || member >= range.count)
    throw MeasureError(fmt::format("{}: the members of {} are 0 to {}", in_backticks(measure.name),
                                   in_backticks(range.name), range.count == 0 ? "none" : to_string(range.count - 1)));
  return {range.first + member, 1};
}

}  // namespace

TextSpan within(const TextSpan& part, const TextSpan& span) {
  return span.length == 0 ? part : TextSpan{part.at + span.at, span.length};
}

string near_name(string_view word, const vector<string_view>& names) {
  const string near = nearest(word, names);
  return near.empty() ? "" : fmt::format("; did you mean {}?", in_backticks(near));
}

namespace {

/// For names of things of the scene.
string other_names(string_view name, const vector<string_view>& names) {
  const string suggestion = suggest_name(name, names);
  return suggestion.empty() ? "" : "; " + suggestion;
}

}  // namespace

bool is_named(string_view thing, string_view name) {
  return thing == name || (thing.size() > name.size() && thing.starts_with(name) && thing[name.size()] == '.');
}

EntityRange bodies_of(const Measure& measure, const Scene& scene) {
  if (measure.kind.empty()) return {0, scene.world.body_count()};
  const bool groups = measure.kind == "groups";
  const auto fits = [&](const BodyRange& range) { return range.group == groups && is_named(range.name, measure.body); };

  // A name stands for one thing, or for all members of a repeated one, which follow one another.
  EntityRange bodies;
  bool found = false;
  for (const BodyRange& range : scene.roster.bodies) {
    if (!fits(range)) continue;
    if (!found) bodies.first = range.first;
    found = true;
    bodies.count += range.count;
  }

  // The name may be that of one member of a group.
  const size_t dot = measure.body.rfind('.');
  if (!found && groups && dot != string::npos)
    if (const BodyRange* range = find_range(scene, measure.body.substr(0, dot)); range != nullptr && range->group)
      return member_of(*range, string_view(measure.body).substr(dot + 1), measure);

  const auto is_kind = [&](string_view of) { return groups ? of == "groups" : of == "balls" || of == "bodies"; };
  if (!found && !is_empty(scene, measure.body, is_kind)) {
    vector<string_view> names;
    for (const BodyRange& range : scene.roster.bodies)
      if (range.group == groups) names.push_back(range.name);
    throw MeasureError(fmt::format("{}: {} has no {}{}", in_backticks(measure.name), measure.kind,
                                   in_backticks(measure.body), other_names(measure.body, names)));
  }

  const BodyRange* whole = find_range(scene, measure.body);
  if (measure.form == MeasureForm::at_end && (whole == nullptr || whole->group))
    throw MeasureError(fmt::format("{} has no member; expected one such as {}.{}.0.{}", in_backticks(measure.name),
                                   measure.kind, measure.body, name_of(measure.quantity)));
  return bodies;
}

vector<EntityRange> things_named(string_view name, const Measure& measure, const Scene& scene) {
  vector<EntityRange> things;
  vector<string_view> names;
  for (const BodyRange& range : scene.roster.bodies) {
    names.push_back(range.name);
    if (is_named(range.name, name)) things.push_back({range.first, range.count});
  }

  for (size_t k = 0; k < scene.roster.fixed.size(); ++k) {
    const string_view fixed = scene.roster.fixed[k].name;
    names.push_back(fixed);
    if (is_named(fixed, name)) things.push_back({scene.world.body_count() + Entity(k), 1});
  }

  for (size_t k = 0; k < scene.roster.strings.size(); ++k) {
    names.push_back(scene.roster.strings[k]);
    if (is_named(scene.roster.strings[k], name)) things.push_back({scene.world.string_number(k), 1});
  }

  const auto is_thing = [](string_view of) { return of != "regions"; };
  if (!things.empty() || is_empty(scene, name, is_thing)) return things;

  const size_t dot = name.rfind('.');
  if (dot != string_view::npos)
    if (const BodyRange* range = find_range(scene, name.substr(0, dot)); range != nullptr && range->group)
      return {member_of(*range, name.substr(dot + 1), measure)};
  throw MeasureError(fmt::format("{}: nothing is named {}{}", in_backticks(measure.name), in_backticks(name),
                                 other_names(name, names)));
}

TimeWindow window_of(const Measure& measure, const map<string, double>& numbers) {
  const auto end = [&](const string& text, double otherwise) {
    if (text.empty()) return otherwise;
    if (const auto number = parse_number(text)) return *number;
    const auto found = numbers.find(text.substr(string_view("let.").size()));
    if (found != numbers.end()) return found->second;
    vector<string_view> names;
    for (const auto& [name, number] : numbers) names.push_back(name);
    throw MeasureError(fmt::format("{}: there is no {}{}", in_backticks(measure.name), in_backticks(text),
                                   other_names(text.substr(4), names)));
  };

  const TimeWindow window{end(measure.from, 0), end(measure.until, infinity)};
  if (window.from < 0)
    throw MeasureError(
        fmt::format("{}: `from` is {} s; expected at least 0", in_backticks(measure.name), shortest(window.from)));
  if (!(window.from < window.until))
    throw MeasureError(fmt::format("{}: `until` is {} s but `from` is {} s; expected from < until",
                                   in_backticks(measure.name), shortest(window.until), shortest(window.from)));
  return window;
}

vector<uint32_t> regions_named(const Measure& measure, const Scene& scene) {
  const string& name = measure.things[0];
  vector<uint32_t> regions;
  vector<string_view> names;
  for (uint32_t r = 0; r < scene.roster.regions.size(); ++r) {
    names.push_back(scene.roster.regions[r]);
    if (is_named(scene.roster.regions[r], name)) regions.push_back(r);
  }
  if (regions.empty() && !is_empty(scene, name, [](string_view of) { return of == "regions"; }))
    throw MeasureError(fmt::format("{}: no region is named {}{}", in_backticks(measure.name), in_backticks(name),
                                   other_names(name, names)));
  return regions;
}

namespace {

vector<string> own_names(const Scene& scene) {
  vector<string> names;
  for (const OwnMeasure& own : scene.measures.own) names.push_back(own.name);
  return names;
}

/// The scene's own measure of this name.
Measure defined(const string& name, const Scene& scene) {
  const auto found = ranges::find_if(scene.measures.own, [&](const OwnMeasure& own) { return own.name == name; });
  Measure measure = parse_measure(found->text, own_names(scene));
  measure.name = name;
  return measure;
}

/// Throws MeasureError unless the measure's window begins within the run.
void check_window(const Measure& measure, const Scene& scene) {
  const TimeWindow window = window_of(measure, scene.measures.numbers);
  if (measure.from.empty() || window.from < scene.simulate.duration) return;
  throw MeasureError(fmt::format("{}: `from` is {} s but the scene ends at {} s; expected less",
                                 in_backticks(measure.name), shortest(window.from), shortest(scene.simulate.duration)));
}

/// Throws MeasureError unless the scene has all that the measure names. `above`: the scene's own measures of which it
/// is a part.
void check(const Measure& measure, const Scene& scene, vector<string>& above) {
  for (const Measure& part : measure.parts) {
    try {
      check(part, scene, above);
    } catch (const MeasureError& error) {
      throw MeasureError(error.what(), within(part.span, error.span));
    }
  }

  switch (measure.form) {
    case MeasureForm::at_end:
    case MeasureForm::greatest:
    case MeasureForm::least:
    case MeasureForm::greatest_time:
    case MeasureForm::least_time:
    case MeasureForm::mean:
    case MeasureForm::count:
      bodies_of(measure, scene);
      return check_window(measure, scene);

    case MeasureForm::impulse:
      if (engine_of(scene.world, scene.simulate) == Engine::book)
        throw MeasureError(
            fmt::format("{}: the engine `book` has no impulse of lasting contact; expected `engine: exact` "
                        "or `stepped`, or hits(a, b)",
                        in_backticks(measure.name)));
      [[fallthrough]];
    case MeasureForm::first_hit:
    case MeasureForm::hits:
      check_window(measure, scene);
      for (const string& name : measure.things) things_named(name, measure, scene);
      return;

    case MeasureForm::entries:
    case MeasureForm::inside:
    case MeasureForm::first_entry:
    case MeasureForm::first_entrant:
      regions_named(measure, scene);
      return;

    case MeasureForm::given:
      if (!scene.measures.numbers.contains(measure.things[0])) {
        vector<string_view> names;
        for (const auto& [name, number] : scene.measures.numbers) names.push_back(name);
        throw MeasureError(
            fmt::format("`let` has no {}{}", in_backticks(measure.things[0]), other_names(measure.things[0], names)));
      }
      return;

    case MeasureForm::own: {
      if (contains(above, measure.things[0]))
        throw MeasureError(
            fmt::format("{} is defined by itself: {}", in_backticks(measure.things[0]), joined(above, ", ")));
      above.push_back(measure.things[0]);
      try {
        check(defined(measure.things[0], scene), scene, above);
      } catch (const MeasureError& error) {
        // Its place is in another text.
        throw MeasureError(error.what());
      }
      above.pop_back();
      return;
    }

    default:
      return;
  }
}

Measure own_measure(const OwnMeasure& own, const Scene& scene) {
  if (find_summary_column(own.name) != nullptr || is_formula_word(own.name))
    throw MeasureError(fmt::format("{} is already a {}; give the measure another name", in_backticks(own.name),
                                   is_formula_word(own.name) ? "function" : "column of summary.csv"));
  vector<string> above = {own.name};
  Measure measure = defined(own.name, scene);
  check(measure, scene, above);
  return measure;
}

}  // namespace

Measure parse_measure(string_view name, const Scene& scene) {
  Measure measure = parse_measure(name, own_names(scene));
  check_names(measure, scene);
  return measure;
}

void check_names(const Measure& measure, const Scene& scene) {
  vector<string> above;
  check(measure, scene, above);
}

vector<Measure> own_measures(const Scene& scene) {
  vector<Measure> measures;
  for (const OwnMeasure& own : scene.measures.own) measures.push_back(own_measure(own, scene));
  return measures;
}

TextFault measure_fault(const Scene& scene, const OwnMeasure& measure) {
  try {
    own_measure(measure, scene);
    return {};
  } catch (const MeasureError& error) {
    return {error.what(), error.span};
  }
}

}  // namespace carom
