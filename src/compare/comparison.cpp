// Reads one run after the other and writes it to every file and sheet at once. The rows of sheets go to files.
// Only a few numbers for each run stay in memory, for the charts.
#include "compare/comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "compare/charts.h"
#include "compare/collision_sheet.h"
#include "compare/common_values.h"
#include "compare/compare_sheet.h"
#include "compare/compared_run.h"
#include "compare/data_dictionary.h"
#include "compare/outcomes.h"
#include "compare/parameter_sheet.h"
#include "compare/pivot_sheet.h"
#include "compare/series.h"
#include "compare/summary_sheet.h"
#include "compare/workbook.h"
#include "files/manifest.h"
#include "files/run_folder.h"
#include "yaml/diagnostics.h"
#include "yaml/joined.h"

namespace carom {
namespace {

/// The default measures.
constexpr const char* usual_measures[] = {"energy_lost_J", "collisions", "max_speed_m_per_s"};

ComparisonPlan titled(ComparisonPlan plan, std::size_t count) {
  if (plan.title.empty()) plan.title = fmt::format("Comparison of {} runs", count);
  return plan;
}

class Comparison {
 public:
  Comparison(const FilePlace& place, const ComparisonPlan& plan, std::size_t count, bool two_vary)
      : place_(place),
        plan_(titled(plan, count)),
        count_(count),
        measures_(measures_of(plan)),
        book_(place, workbook_name, plan_.title),
        charts_(book_, !SummarySheet::is_table(count)),
        summary_(place, book_, plan_, measures_, count),
        repeats_(plan.seed ? &book_.add("Repeats", true) : nullptr),
        pivot_(two_vary ? &book_.add("Pivot", true) : nullptr),
        series_sheet_(book_.add("Series", true)),
        collisions_(book_.add("Collisions", true)),
        parameters_(book_.add("Parameters"), plan_),
        about_(book_.add("About")),
        outcomes_(plan, measures_.size(), count),
        series_(count, measures_) {
    summary_.write_heads();
  }

  void add(std::size_t number, ComparedRun compared) {
    if (compared.values.size() != plan_.parameters.size())
      throw std::logic_error("a run has as many values as there are parameters");
    compared.id = valid_utf8(compared.id);
    const RunRecord run = read_run(std::move(compared), measures_);
    if (!run.done) ++failed_;
    if (run.done && run.summary[status_] == "doubtful") ++doubtful_;
    summary_.add(number, run);
    outcomes_.add(number, run.run, run.done, run.measures);
    series_.add(run);
    collisions_.add(run);
    common_.add(run);
    parameters_.add(run.run);
  }

  std::size_t doubtful() const { return doubtful_; }  // so far

  std::vector<std::unique_ptr<OutputFile>> finish() {
    outcomes_.finish();
    std::vector<std::unique_ptr<OutputFile>> files;
    files.push_back(summary_.take_table());
    if (plan_.seed) {
      files.push_back(std::make_unique<OutputFile>(place_, repeats_name));
      write_repeats(*files.back(), plan_, measures_, outcomes_);
      write_repeats(*repeats_, plan_, measures_, outcomes_);
    }
    summary_.finish();
    write_pivot_sheet();
    const std::vector<PlacedSeries> placed = write_series(series_sheet_, series_);
    collisions_.finish();
    parameters_.finish(outcomes_, common_.values());
    write_charts(placed);
    write_about(about_, plan_, measures_, remarks());
    files.push_back(std::make_unique<OutputFile>(place_, workbook_name));
    book_.write(*files.back());
    for (const auto& file : files) file->complete();
    return files;
  }

 private:
  void write_pivot_sheet() {
    if (pivot_ == nullptr) return;
    const auto parameters = pivot_parameters(plan_, outcomes_);
    if (!parameters) return;
    write_pivot(*pivot_, plan_, measures_, outcomes_, *parameters, summary_.parameter_columns(),
                summary_.measure_columns(), summary_.is_table() ? count_ : 0);
  }

  void write_charts(const std::vector<PlacedSeries>& placed) {
    std::vector<ChartData> charts;
    for (const Chart& chart : chosen_charts(plan_, measures_, outcomes_))
      charts.push_back(chart_data(chart, plan_, measures_, outcomes_));
    std::string varied;
    for (const Parameter& parameter : plan_.parameters) varied += (varied.empty() ? "" : ", ") + parameter.path;
    std::string text = fmt::format("{} runs", count_);
    if (failed_ > 0) text += fmt::format(", {} of them failed", failed_);
    if (doubtful_ > 0) text += fmt::format(", {} of them doubtful", doubtful_);
    if (!varied.empty()) text += "; varied: " + varied;
    charts_.write(plan_.title, {text}, charts, placed);
  }

  std::vector<std::string> remarks() const {
    std::vector<std::string> remarks;
    if (!summary_.is_table())
      remarks.push_back(fmt::format("Summary is a table for up to {} runs, and a range with filters for more.",
                                    SummarySheet::most_in_table));
    if (count_ + 1 > most_rows)
      remarks.push_back(fmt::format("Summary holds the first {} runs; summary.csv has all.", most_rows - 1));
    remarks.push_back(fmt::format("Series: at most {} points of a run, evenly chosen.", series_.points()));
    if (series_.left_out() > 0)
      remarks.push_back(fmt::format("Series: {} runs left out, for lack of room or for tables that are too long.",
                                    series_.left_out()));
    if (collisions_.full())
      remarks.push_back(
          fmt::format("Collisions: the first {}; collisions.csv of each run has all.", CollisionSheet::most));
    return remarks;
  }

  FilePlace place_;
  ComparisonPlan plan_;
  std::size_t count_, failed_ = 0, doubtful_ = 0;
  const std::size_t status_ = static_cast<std::size_t>(find_summary_column("status") - summary_columns().data());
  std::vector<Measure> measures_;
  Workbook book_;
  CompareSheet charts_;
  SummarySheet summary_;
  Worksheet *repeats_, *pivot_;
  Worksheet& series_sheet_;
  CollisionSheet collisions_;
  ParameterSheet parameters_;
  Worksheet& about_;
  Outcomes outcomes_;
  SeriesGatherer series_;
  CommonValues common_;
};

/// Whether two parameters vary independently. Sheets are made in their order, before the runs are read.
bool do_two_vary(const ComparisonPlan& plan, std::size_t count, const std::function<ComparedRun(std::size_t)>& run,
                 const ComparisonWatch& watch) {
  if (plan.parameters.size() < 2) return false;
  Outcomes outcomes(plan, 0, count);
  for (std::size_t i = 0; i < count; ++i) {
    watch.stop_check();
    outcomes.add(i, run(i), false, {});
  }
  outcomes.finish();
  return pivot_parameters(plan, outcomes).has_value();
}

}  // namespace

std::vector<Measure> measures_of(const ComparisonPlan& plan) {
  std::vector<Measure> measures;
  const auto add = [&](std::string_view name) {
    const bool known =
        std::any_of(measures.begin(), measures.end(), [&](const Measure& measure) { return measure.name == name; });
    if (!known) measures.push_back(parse_measure(name, plan.own));
  };
  for (const std::string& name : plan.measures) add(name);
  for (const Chart& chart : plan.charts) {
    add(chart.y);
    if (!find_parameter(plan, chart.x)) add(chart.x);
  }
  for (const std::string& name : plan.own) add(name);
  if (measures.empty())
    for (const char* name : usual_measures) add(name);
  return measures;
}

void check_charts(const ComparisonPlan& plan) {
  std::vector<std::string_view> paths;
  for (const Parameter& parameter : plan.parameters) paths.push_back(parameter.path);
  const auto refuse = [&](const std::string& name, const char* what) {
    const std::string near = nearest(name, paths);
    std::string remedy;
    if (!near.empty()) remedy = fmt::format("; did you mean {}?", in_backticks(near));
    if (near.empty() && !paths.empty()) remedy = fmt::format("; the varied paths are {}", joined(paths, ", "));
    throw MeasureError(fmt::format("a chart's {} {}{}", in_backticks(name), what, remedy));
  };
  for (const Chart& chart : plan.charts) {
    if (!chart.by.empty() && !find_parameter(plan, chart.by)) refuse(chart.by, "is not varied");
    if (find_parameter(plan, chart.x)) continue;
    try {
      parse_measure(chart.x, plan.own);
    } catch (const MeasureError&) {
      refuse(chart.x, "is neither varied nor a measure");
    }
  }
  measures_of(plan);
}

std::vector<std::unique_ptr<OutputFile>> write_comparison(const FilePlace& place, const ComparisonPlan& plan,
                                                          std::size_t count,
                                                          const std::function<ComparedRun(std::size_t)>& run,
                                                          const ComparisonWatch& watch) {
  check_charts(plan);
  Comparison comparison(place, plan, count, do_two_vary(plan, count, run, watch));
  for (std::size_t i = 0; i < count; ++i) {
    watch.stop_check();
    comparison.add(i, run(i));
    watch.done(i + 1);
  }
  watch.doubtful(comparison.doubtful());
  return comparison.finish();
}

}  // namespace carom
