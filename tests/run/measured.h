#pragma once
// Measures of scenes that are written as text, without a run folder.

#include "engine/engine.h"
#include "run/measuring.h"
#include "scene/scene.h"
#include "scene/scenes_in_text.h"
#include "std.h"

namespace carom::testing {

/// A finished run: the values of measures, and the last state.
struct MeasuredScene {
  vector<double> values;
  State end;
  Tally tally;
};

/// Runs the scene, and measures.
inline MeasuredScene run_measured(const string& yaml, const vector<string>& measures) {
  const Scene scene = load_text(yaml);
  vector<Measure> parsed;
  for (const string& text : measures) parsed.push_back(parse_measure(text, scene));
  Measuring measuring(scene, parsed);
  const auto simulator = make_simulator(
      scene, {.collisions = true, .paths = false, .watch = measuring.watched(), .impulses = measuring.impulses()});
  do {
    simulator->advance_to(scene.simulate.duration);
    measuring.record(simulator->collisions(), simulator->crossings());
  } while (simulator->time() < scene.simulate.duration);

  MeasuredScene done{{}, simulator->state(), simulator->tally()};
  const Summary summary;
  for (const Measured& value : measuring.values({done.end, summary, simulator->extremes(), simulator->impulses()}))
    done.values.push_back(value.value);
  return done;
}

inline vector<double> measured(const string& yaml, const vector<string>& measures) {
  return run_measured(yaml, measures).values;
}
/// That of one measure.
inline double value_of(const string& measure, const string& yaml) {
  return measured(yaml, {measure}).front();
}

}  // namespace carom::testing
