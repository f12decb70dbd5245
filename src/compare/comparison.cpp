// Reads one run after the other and writes it to every file and sheet at once. The rows of sheets go to files.
// Only a few numbers for each run stay in memory, for the charts.
#include "compare/comparison.h"

#include <fmt/format.h>

#include <future>

#include "compare/charts.h"
#include "compare/collision_sheet.h"
#include "compare/common_values.h"
#include "compare/compare_sheet.h"
#include "compare/compared_run.h"
#include "compare/comparison_page.h"
#include "compare/data_dictionary.h"
#include "compare/findings.h"
#include "compare/heat_map.h"
#include "compare/outcomes.h"
#include "compare/parameter_sheet.h"
#include "compare/pivot_sheet.h"
#include "compare/scenarios.h"
#include "compare/series.h"
#include "compare/sheet_charts.h"
#include "compare/summary_sheet.h"
#include "files/manifest.h"
#include "files/run_folder.h"
#include "scene/output_kinds.h"
#include "std.h"
#include "workbook/workbook.h"
#include "yaml/diagnostics.h"
#include "yaml/joined.h"

namespace carom {
namespace {

ComparisonPlan titled(ComparisonPlan plan, size_t count) {
  if (plan.title.empty()) plan.title = "Comparison of " + how_many(count, "run", "runs");
  return plan;
}

/// Among summary_columns().
size_t status_column() {
  return size_t(find_summary_column("status") - summary_columns().data());
}

/// What a first look at the values of all runs shows. Sheets are made in their order, before the runs are read.
struct Variation {
  bool two = false;  // whether two parameters vary independently
  /// Whether the scenes have little in common: most parameters exist in some of them only.
  bool unrelated = false;
  ChosenScenarios scenarios;
};

class Comparison {
 public:
  Comparison(const FilePlace& place, const ComparisonPlan& plan, size_t count, Variation variation)
      : place_(place),
        plan_(titled(plan, count)),
        count_{count},
        measures_(measures_of(plan)),
        book_(place, workbook_name, plan_.title),
        unrelated_(variation.unrelated),
        // The sheets, in their order.
        front_(book_),
        pivot_(variation.two ? &book_.add("Pivot", true) : nullptr),
        summary_(place, book_, plan_, measures_, count, unrelated_),
        repeats_(plan.seed ? &book_.add("Repeats", true) : nullptr),
        series_sheet_(book_.add("Series", true)),
        collisions_(plan.collisions ? make_unique<CollisionSheet>(book_.add("Collisions", true), count) : nullptr),
        charts_(book_, !SummarySheet::is_table(count)),
        parameters_(book_.add("Parameters"), plan_, unrelated_),
        about_(book_.add("About")),
        outcomes_(plan, measures_.size(), count),
        runs_(place, plan_, measures_, unrelated_),
        series_(std::move(variation.scenarios), measures_) {
    summary_.write_heads();
  }

  void add(size_t number, ComparedRun compared) {
    if (compared.values.size() != plan_.parameters.size())
      throw std::logic_error("a run has as many values as there are parameters");

    compared.id = valid_utf8(compared.id);
    const RunRecord run = read_run(std::move(compared), measures_);
    if (!run.done) ++count_.failed;
    if (run.done && run.summary[status_column()] == "doubtful") ++count_.doubtful;

    summary_.add(number, run);
    outcomes_.add(number, run.run, run.done, run.measures);
    series_.add(number, run);
    if (collisions_) collisions_->add(run);
    common_.add(run);
    parameters_.add(run.run);
    runs_.add(run);
  }

  size_t doubtful() const { return count_.doubtful; }  // so far

  vector<unique_ptr<OutputFile>> finish() {
    outcomes_.finish();
    summary_.finish();
    vector<unique_ptr<OutputFile>> files;
    files.push_back(summary_.take_table());

    if (plan_.seed) {
      files.push_back(make_unique<OutputFile>(place_, repeats_name, plan_.dialect));
      write_repeats(*files.back(), plan_, measures_, outcomes_);
      files.back()->complete();
      write_repeats(*repeats_, plan_, measures_, outcomes_);
    }

    // The page, of which gnuplot draws the charts in the meantime.
    const Findings findings = findings_of(outcomes_, measures_.size(), unrelated_);
    const vector<SceneValue> common = common_.values();
    parameters_.finish(outcomes_, common);
    const PageContent content{plan_, measures_, outcomes_, findings, runs_, parameters_.differences(), common, count_};
    std::future<string> page = std::async(std::launch::async, [&] { return comparison_page(content); });

    // The sheets that take all runs together.
    const vector<PlacedSeries> placed = write_series(series_sheet_, series_);
    if (collisions_) collisions_->finish();
    write_front(findings, placed);
    write_about(about_, plan_, measures_, remarks());

    files.push_back(make_unique<OutputFile>(place_, workbook_name));
    book_.write(*files.back());
    files.back()->complete();

    files.push_back(make_unique<OutputFile>(place_, page_name));
    files.back()->write(page.get());
    files.back()->complete();
    return files;
  }

 private:
  void write_front(const Findings& findings, const vector<PlacedSeries>& placed) {
    const auto two = unrelated_ ? nullopt : heat_map_parameters(plan_, outcomes_);
    const SummaryPlace place{summary_.parameter_columns(), summary_.measure_columns(), summary_.first_row(),
                             summary_.is_table() ? count_.all : 0};
    if (pivot_ != nullptr && two) write_pivot(*pivot_, plan_, measures_, outcomes_, *two, place);

    // A grid of two parameters begins with a heat map; of more parameters it is a mean over the others.
    front_.write({plan_, measures_, outcomes_, findings, lines(findings), parameters_.differences(),
                  findings.variety == Variety::plane ? two : nullopt, place, placed, series_.scenarios().all},
                 charts_);
  }

  /// What the runs are, how far they can be trusted, and what does not differ.
  vector<string> lines(const Findings& findings) const {
    string text = how_many(count_.all, "run", "runs");
    if (unrelated_)
      text += fmt::format(" of scenes with little in common; {}",
                          how_many(plan_.parameters.size(), "value differs", "values differ"));
    else if (!plan_.parameters.empty())
      text += "; varied: " + varied_ranges(plan_, outcomes_);

    string state = count_.failed + count_.doubtful == 0 ? "No run failed or is doubtful" : "";
    if (count_.failed > 0) state += how_many(count_.failed, "run failed", "runs failed");
    if (count_.doubtful > 0)
      state += fmt::format("{}{}", state.empty() ? "" : ", ",
                           how_many(count_.doubtful, "run is doubtful", "runs are doubtful"));

    string same;
    for (const MeasureFinding& finding : findings.measures)
      if (finding.is_constant && finding.points == outcomes_.points() && count_.all > 1)
        same += fmt::format("{}{} = {}", same.empty() ? "The same in all runs: " : "; ",
                            label_of(measures_[finding.measure].name),
                            shown_value(Cell{{}, outcomes_.spread(finding.highest.front(), finding.measure).mean()}));
    vector<string> lines = {text, state + "."};
    if (!same.empty()) lines.push_back(same + ".");
    return lines;
  }

  vector<string> remarks() const {
    vector<string> remarks;
    if (!summary_.is_table())
      remarks.push_back(fmt::format("Summary is a table for up to {} runs, and a range with filters for more.",
                                    SummarySheet::most_in_table));
    if (count_.all + summary_.first_row() > most_rows)
      remarks.push_back(
          fmt::format("Summary holds the first {} runs; summary.csv has all.", most_rows - summary_.first_row()));

    const ChosenScenarios& scenarios = series_.scenarios();
    if (scenarios.names.size() < scenarios.all)
      remarks.push_back(fmt::format("Series: {} of {} {}, spread over the values of the parameters.",
                                    scenarios.names.size(), scenarios.all, plan_.seed ? "scenarios" : "runs"));
    remarks.push_back(fmt::format("Series: at most {} points of each, evenly chosen.", SeriesGatherer::most_points));
    if (series_.left_out() > 0)
      remarks.push_back(fmt::format("Series: {} left out, for tables that are too long or other instants.",
                                    how_many(series_.left_out(), "run", "runs")));

    if (collisions_ && collisions_->full())
      remarks.push_back(fmt::format("Collisions: the first {} of each run; collisions.csv of each run has all.",
                                    collisions_->share()));
    if (!collisions_) remarks.emplace_back("Collisions: a sheet of them on request: carom compare DIR --collisions.");
    return remarks;
  }

  FilePlace place_;
  ComparisonPlan plan_;
  RunCounts count_;
  vector<Measure> measures_;
  Workbook book_;
  bool unrelated_;
  CompareSheet front_;
  Worksheet* pivot_;
  SummarySheet summary_;
  Worksheet* repeats_;
  Worksheet& series_sheet_;
  unique_ptr<CollisionSheet> collisions_;
  SheetCharts charts_;
  ParameterSheet parameters_;
  Worksheet& about_;
  Outcomes outcomes_;
  RunTable runs_;
  SeriesGatherer series_;
  CommonValues common_;
};

/// Reads the values of all runs, and no other file of them.
Variation variation_of(const ComparisonPlan& plan, size_t count, const function<ComparedRun(size_t)>& run,
                       const ComparisonWatch& watch) {
  Variation variation;
  Outcomes outcomes(plan, 0, count);
  vector<size_t> points(count);
  AbsentValues absent(plan.parameters.size());

  for (size_t i = 0; i < count; ++i) {
    watch.stop_check();
    const ComparedRun one = run(i);
    points[i] = outcomes.add(i, one, false, {});
    absent.add(one.values);
  }

  outcomes.finish();
  variation.unrelated = absent.unrelated();
  variation.two = plan.parameters.size() > 1 && !variation.unrelated && heat_map_parameters(plan, outcomes).has_value();
  variation.scenarios = chosen_scenarios(plan, outcomes, points, variation.unrelated);
  return variation;
}

/// That of the first run with a scene: the runs of a sweep have that of its base.
CsvDialect first_dialect(size_t count, const function<ComparedRun(size_t)>& run) {
  for (size_t i = 0; i < count; ++i)
    if (const optional<CsvDialect> dialect = dialect_of(run(i))) return *dialect;
  return {};
}

}  // namespace

vector<unique_ptr<OutputFile>> write_comparison(const FilePlace& place, const ComparisonPlan& plan, size_t count,
                                                const function<ComparedRun(size_t)>& run,
                                                const ComparisonWatch& watch) {
  check_charts(plan);
  ComparisonPlan own = plan;
  own.dialect = first_dialect(count, run);

  Comparison comparison(place, own, count, variation_of(own, count, run, watch));
  for (size_t i = 0; i < count; ++i) {
    watch.stop_check();
    comparison.add(i, run(i));
    watch.done(i + 1);
  }
  watch.doubtful(comparison.doubtful());
  return comparison.finish();
}

}  // namespace carom
