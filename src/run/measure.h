#pragma once
// The measures by which runs are compared. A measure is one of these, or an expression of them:
// - a number of summary.csv: `energy_lost_J`
// - a body's position or motion at the run's end: `balls.red.y_m`
// - an extreme of it over the run: `max(balls.red.y_m)`, `min(...)`, `time_of_max(...)`, `time_of_min(...)`
// - its mean over time: `mean(balls.red.y_m)`
// - the collisions of two things: `first(red, blue)`, in s, and `hits(red, blue)`
// - the impulse of their contact: `impulse(red, blue)`, in N s
// - one of these five over a part of the run: `max(balls.red.y_m, from: 1, until: 2)`
// - a region: `regions.pocket.entries`, `.inside`, `.first_s`, `.first`
// - the number of bodies with a property at the end: `count(y_m < 0)`
// - a value of the scene: `let.h`, or the name of a measure of its own

#include "files/summary.h"
#include "files/summary_columns.h"
#include "numerics/vec3.h"
#include "physics/quantity.h"
#include "std.h"
#include "yaml/diagnostics.h"

namespace carom {

struct OwnMeasure;
struct Scene;

/// "x_m", ..., "speed_m_per_s", "kinetic_J".
string_view name_of(Quantity quantity);
/// A phrase: "x coordinate of the centre".
string_view meaning_of(Quantity quantity);

/// The name of a measure is invalid. The text describes the fault and suggests a near name, if there is one.
struct MeasureError : runtime_error {
  using runtime_error::runtime_error;
  MeasureError(const string& text, TextSpan where) : runtime_error(text), span(where) {}
  TextSpan span{};  // in the text of the measure
};

enum class MeasureForm : uint8_t {
  column,         // a number of summary.csv
  at_end,         // a quantity of a body at the end
  greatest,       // max(...)
  least,          // min(...)
  greatest_time,  // time_of_max(...), s
  least_time,     // time_of_min(...), s
  mean,           // mean(...)
  first_hit,      // first(a, b), s
  hits,           // hits(a, b)
  impulse,        // impulse(a, b), N s
  entries,        // of a region: how many bodies entered
  inside,         // of a region: how many are inside at the end
  first_entry,    // of a region: the time of the first entry, s
  first_entrant,  // of a region: the name of the body that entered first
  count,          // count(y_m < 0)
  given,          // let.NAME, a value of the scene
  own,            // a measure of the scene's own, by its name
  expression      // '= ...'
};

enum class Relation : uint8_t { less, at_most, greater, at_least };

struct Measure {
  string name;
  MeasureForm form = MeasureForm::column;
  const SummaryColumn* column = nullptr;
  /// Of at_end, extremes and count: "balls", "bodies" or "groups", and a name as in trajectory.csv: "red", "gas.17".
  /// Both empty: all bodies.
  string kind, body;
  Quantity quantity = Quantity::x;
  /// Of a form with a window: its ends, a number (s) or "let.NAME". Empty: those of the run.
  string from{}, until{};
  /// Of hits, first_hit and impulse: one or two names. Of a region, a value of `let` or a measure of the scene: its
  /// name.
  vector<string> things{};
  Relation relation = Relation::less;
  /// Of count: what the quantity is compared with. Of an expression: the whole. Both are expressions in which `m0`,
  /// `m1`, ... stand for `parts`.
  string formula{};
  vector<Measure> parts{};
  /// Of a part: where it stands in the text of the whole.
  TextSpan span{};

  /// Whether summary.csv of the run has it.
  bool is_stored() const { return form == MeasureForm::column || form == MeasureForm::own; }
  bool is_text() const { return form == MeasureForm::first_entrant; }
};

/// Parses a measure by its grammar alone. `own`: the names of measures that scenes define. Throws MeasureError.
Measure parse_measure(string_view name, span<const string> own = {});
/// The same, and all that it names must exist in the scene.
Measure parse_measure(string_view name, const Scene& scene);
/// The name of the measure that a text means: the text itself, or, of an expression without it, with "= " in front.
string measure_text(const string& text);
/// The measures that the scene defines, each with its name. Throws MeasureError.
vector<Measure> own_measures(const Scene& scene);
/// The fault of one of them; an empty text: none. For LoadOptions.
TextFault measure_fault(const Scene& scene, const OwnMeasure& measure);

/// The value of a measure's formula with these values of its parts. NaN: undefined, as with a part that is, or where a
/// division by zero occurs.
double formula_value(const Measure& measure, span<const double> parts);

bool compares(double value, Relation relation, double limit);

/// Whether a collision is one of hits(a, b), or of hits(a) for one name. has(number, first): whether the name of this
/// number has the first of the two that collided, or the second.
template <typename Has>
bool meet(size_t names, const Has& has) {
  if (names == 1) return has(0, true) || has(0, false);
  return (has(0, true) && has(1, false)) || (has(0, false) && has(1, true));
}

/// A readable label: "energy lost (J)", "balls.red speed (m/s)".
string label_of(string_view column);
/// The unit at the end of a column's or measure's name: "J", "m/s". Empty: a pure number or text.
string_view unit_of(string_view column);

}  // namespace carom
