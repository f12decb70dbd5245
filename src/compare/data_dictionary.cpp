// The meanings of summary columns come from their own table (files/summary_columns.h), so that the two agree. Only the
// columns of collisions and series are described here.
#include "compare/data_dictionary.h"

#include <fmt/format.h>

#include "std.h"
#include "version.h"

namespace carom {
namespace {

constexpr array<ColumnText, 15> collision_texts = {
    {{"time_s", "time of the collision"},
     {"kind", "body-body, body-fixed, rest (end of the bounces), merge (two become one) or string (it goes taut)"},
     {"a", "the body; the first of two"},
     {"b", "the other body, the fixed thing or the string"},
     {"x_m", "x coordinate of the point of contact; of a string the centre of a"},
     {"y_m", "y coordinate of the point of contact"},
     {"z_m", "z coordinate of the point of contact"},
     {"nx", "x component of the normal, which points from a to b; of a string away from its other end"},
     {"ny", "y component of the normal"},
     {"nz", "z component of the normal"},
     {"approach_speed_m_per_s", "relative speed along the normal before the collision; above 0: approaching"},
     {"separation_speed_m_per_s", "the same after the collision; above 0: separating"},
     {"restitution", "the pair's coefficient of restitution"},
     {"impulse_N_s", "impulse along the normal"},
     {"energy_lost_J", "energy lost in this collision; below 0: gained"}}};

constexpr array<ColumnText, 3> series_texts = {
    {{"time_s", "instant of the columns to its right, up to the next time_s"},
     {"kinetic_J", "kinetic energy of all bodies"},
     {"total_J", "kinetic and potential energy of all bodies"}}};

struct SheetText {
  const char *name, *text;
};
constexpr SheetText sheets[] = {
    {"Compare", "the highest and lowest runs of each measure, rank correlations, heat maps and charts"},
    {"Pivot", "means of the measures by two parameters, if two vary"},
    {"Summary",
     "a row for each run: the varied values (tinted), the measures, and what else differs; above them what does not"},
    {"Repeats",
     "a row for each scenario: mean, standard deviation (n - 1), minimum and maximum of its repeats, if any"},
    {"Series",
     "energy and bodies' motion over time, thinned; a column for each of a few scenarios, the mean of its repeats"},
    {"Collisions", "the first collisions of each run, on request"},
    {"Points", "the numbers of the charts"},
    {"Parameters", "what varies, and the values that all runs share"},
    {"About", "this sheet"}};

string meaning_of(const Measure& measure) {
  switch (measure.form) {
    case MeasureForm::column:
      return string(measure.column->meaning);
    case MeasureForm::at_end:
      return fmt::format("{} of {} at the run's end", meaning_of(measure.quantity), measure.body);
    case MeasureForm::own:
      return "a measure that the scene defines";
    case MeasureForm::expression:
      return "an expression of measures";

    case MeasureForm::hits:
      return "number of collisions";
    case MeasureForm::impulse:
      return label_of(measure.name) + ": sum of the magnitudes of normal impulses, also in lasting contact";
    case MeasureForm::count:
      return "number of bodies at the run's end";

    // Of regions.
    case MeasureForm::entries:
      return fmt::format("bodies that entered {}, each time anew", measure.things[0]);
    case MeasureForm::inside:
      return fmt::format("bodies inside {} at the run's end", measure.things[0]);
    case MeasureForm::first_entry:
      return fmt::format("time of the first entry into {}", measure.things[0]);
    case MeasureForm::first_entrant:
      return fmt::format("the body that entered {} first", measure.things[0]);

    default:
      return label_of(measure.name) + (measure.from.empty() && measure.until.empty() ? ", over the whole run" : "");
  }
}

}  // namespace

span<const ColumnText> collision_columns() {
  return collision_texts;
}

void write_about(Worksheet& sheet, const ComparisonPlan& plan, const vector<Measure>& measures,
                 const vector<string>& remarks) {
  size_t row = 0;
  const auto section = [&](const char* title) {
    ++row;
    sheet.text(row++, 0, title, CellStyle::title);
  };
  const auto column = [&](const char* where, string_view name, string_view unit, string_view meaning) {
    sheet.text(row, 0, where);
    sheet.text(row, 1, name);
    sheet.text(row, 2, unit);
    sheet.text(row++, 3, meaning, CellStyle::wrapped);
  };

  sheet.text(row++, 0, plan.title, CellStyle::title);
  sheet.text(row++, 0,
             fmt::format("written by {}; SI units, right-handed axes, y is up; cells show about five digits and "
                         "have 16, the CSV files all",
                         program_and_version),
             CellStyle::note);

  section("Sheets");
  for (const SheetText& text : sheets) {
    sheet.text(row, 0, text.name);
    sheet.text(row++, 1, text.text, CellStyle::note);
  }

  if (!remarks.empty()) {
    section("Left out");
    for (const string& remark : remarks) sheet.text(row++, 0, remark, CellStyle::note);
  }

  section("Columns");
  for (size_t k = 0; const char* head : {"sheet", "column", "unit", "meaning"})
    sheet.text(row, k++, head, CellStyle::header);
  ++row;

  // Each sheet's columns, in the order of the sheets.
  for (const SummaryColumn& text : summary_columns()) column("Summary", text.name, unit_of(text.name), text.meaning);
  constexpr size_t most_parameters = 30;
  for (size_t p = 0; p < min(plan.parameters.size(), most_parameters); ++p)
    column("Summary", plan.parameters[p].path, plan.parameters[p].unit, "value of the scene that is varied");
  if (plan.parameters.size() > most_parameters)
    column("Summary", fmt::format("and {} more", plan.parameters.size() - most_parameters), "",
           "as the ones above; the sheet Parameters has all");
  for (const Measure& measure : measures)
    if (measure.column == nullptr) column("Summary", measure.name, unit_of(measure.name), meaning_of(measure));

  if (plan.seed) {
    column("Repeats", "n", "", "whole runs of the scenario");
    for (const Measure& measure : measures)
      column("Repeats", measure.name + ".mean, .sd, .min, .max", unit_of(measure.name), meaning_of(measure));
  }

  for (const ColumnText& text : series_texts) column("Series", text.name, unit_of(text.name), text.meaning);
  if (plan.collisions)
    for (const ColumnText& text : collision_columns())
      column("Collisions", text.name, unit_of(text.name), text.meaning);

  sheet.fit(0, 12, 20);
  sheet.fit(1, 20, 48);
  sheet.fit(2, 8, 10);
  sheet.fit(3, 110, 110);
  sheet.print_wide();
}

}  // namespace carom
