// Runs are read one after the other and go to every file and sheet at once. What grows with their number is a few
// numbers a run, for the charts: the sheets' rows go to files.
#include "study/comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "export/csv.h"
#include "export/manifest.h"
#include "export/run_folder.h"
#include "scene/diagnostics.h"
#include "study/charts.h"
#include "study/collision_sheet.h"
#include "study/common_values.h"
#include "study/compare_sheet.h"
#include "study/compared_run.h"
#include "study/data_dictionary.h"
#include "study/outcomes.h"
#include "study/parameter_sheet.h"
#include "study/pivot_sheet.h"
#include "study/series.h"
#include "study/workbook.h"

namespace carom {
namespace {

/// Up to so many runs the sheet Summary is a table; of more it is streamed, with filters.
constexpr std::size_t most_in_table = 2000;
/// A table's names of columns.
constexpr std::size_t longest_name = 255;
/// What is compared where nothing is said.
constexpr const char* usual_measures[] = {"energy_lost_J", "collisions", "max_speed_m_per_s"};

/// One column of summary.csv and of the sheet Summary.
struct Column {
  std::string name;
  Look look = Look::plain;
  bool is_text = false;
  // Where the cell comes from: one of these.
  std::optional<std::size_t> summary, parameter, measure;
};

std::vector<Column> make_columns(const ComparisonPlan& plan, const std::vector<Measure>& measures) {
  std::vector<Column> columns;
  for (std::size_t k = 0; k < summary_columns().size(); ++k) {
    const SummaryColumn& summary = summary_columns()[k];
    Column column{std::string(summary.name), Look::plain, summary.number == nullptr, k, {}, {}};
    for (const char* name : {"energy_residual_J", "momentum_drift_kg_m_per_s", "max_overlap_m"})
      if (column.name == name) column.look = Look::rounding;
    if (!column.is_text && unit_of(summary.name).empty()) column.look = Look::whole;
    columns.push_back(std::move(column));
  }
  for (std::size_t k = 0; k < plan.parameters.size(); ++k)
    columns.push_back({plan.parameters[k].path, Look::swept, false, {}, k, {}});
  for (std::size_t k = 0; k < measures.size(); ++k)
    if (measures[k].column == nullptr) columns.push_back({measures[k].name, Look::plain, false, {}, {}, k});
  if (columns.size() > most_columns)
    throw ExportError(
        fmt::format("a comparison of {} columns is more than a spreadsheet's {}: compare fewer parameters",
                    columns.size(), most_columns));
  return columns;
}

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
        columns_(make_columns(plan, measures_)),
        in_table_(count <= most_in_table),
        book_(place, workbook_name, plan_.title),
        charts_(book_, !in_table_),
        sheet_(book_.add("Summary", !in_table_)),
        repeats_(plan.seed ? &book_.add("Repeats", true) : nullptr),
        pivot_(two_vary ? &book_.add("Pivot", true) : nullptr),
        series_sheet_(book_.add("Series", true)),
        collisions_(book_.add("Collisions", true)),
        parameters_(book_.add("Parameters"), plan_),
        about_(book_.add("About")),
        table_(std::make_unique<OutputFile>(place, summary_name)),
        outcomes_(plan, measures_.size(), count),
        series_(count, measures_) {
    write_heads();
  }

  void add(std::size_t number, ComparedRun compared) {
    if (compared.values.size() != plan_.parameters.size())
      throw std::logic_error("a run has as many values as there are parameters");
    compared.id = valid_utf8(compared.id);
    const RunRecord run = read_run(std::move(compared), measures_);
    if (!run.done) ++failed_;
    write_row(number, run);
    outcomes_.add(number, run.run, run.done, run.measures);
    series_.add(run);
    collisions_.add(run);
    common_.add(run);
    parameters_.add(run.run);
  }

  std::vector<std::unique_ptr<OutputFile>> finish() {
    outcomes_.finish();
    std::vector<std::unique_ptr<OutputFile>> files;
    files.push_back(std::move(table_));
    if (plan_.seed) {
      files.push_back(std::make_unique<OutputFile>(place_, repeats_name));
      write_repeats(*files.back(), plan_, measures_, outcomes_);
      write_repeats(*repeats_, plan_, measures_, outcomes_);
    }
    finish_summary();
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
  void write_heads() {
    CsvRow row(*table_);
    // A table's names differ in more than their letters' case, and are not long.
    std::map<std::string, int> taken;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      row.text(columns_[k].name);
      std::string head = columns_[k].name.substr(0, longest_name - 8), lower = head;
      std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
      if (const int before = taken[lower]++; before > 0) head += fmt::format(" ({})", before + 1);
      heads_.push_back(head);
      sheet_.text(0, k, head, columns_[k].look == Look::swept ? Look::swept_header : Look::header);
    }
    row.end();
  }

  void write_row(std::size_t number, const RunRecord& run) {
    CsvRow row(*table_);
    const bool room = number + 1 < most_rows;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const Column& column = columns_[k];
      if (column.measure) {
        row.number(run.measures[*column.measure]);
        if (room) sheet_.number(number + 1, k, run.measures[*column.measure], column.look);
        continue;
      }
      std::string text = column.parameter ? run.run.values[*column.parameter] : run.summary[*column.summary];
      if (column.name == "run") text = run.run.id;
      if (column.name == "status" && !run.done) text = "failed";
      Cell cell{text};
      if (!column.is_text) cell = cell_of(text);
      cell.is_number() ? row.number(cell.number) : row.text(text);
      if (room) sheet_.cell(number + 1, k, cell, column.look);
    }
    row.end();
  }

  void finish_summary() {
    const std::size_t rows = std::min(count_, most_rows - 1);
    const auto last_row = static_cast<lxw_row_t>(rows);
    const auto last_column = static_cast<lxw_col_t>(columns_.size() - 1);
    if (in_table_ && rows > 0) {
      std::vector<lxw_table_column> tables(columns_.size());
      std::vector<lxw_table_column*> pointers;
      for (std::size_t k = 0; k < columns_.size(); ++k) {
        tables[k].header = const_cast<char*>(heads_[k].c_str());
        tables[k].header_format = sheet_.format(columns_[k].look == Look::swept ? Look::swept_header : Look::header);
        pointers.push_back(&tables[k]);
      }
      pointers.push_back(nullptr);
      lxw_table_options options{};
      options.name = const_cast<char*>("Runs");
      options.style_type = LXW_TABLE_STYLE_TYPE_LIGHT;
      options.style_type_number = 1;
      options.columns = pointers.data();
      worksheet_add_table(sheet_.get(), 0, 0, last_row, last_column, &options);
    } else if (rows > 0) {
      worksheet_autofilter(sheet_.get(), 0, 0, last_row, last_column);
    }
    sheet_.fit_all(9, 60, 3);  // room for the filters' buttons
    sheet_.freeze(1, 1);
    sheet_.print_table();
  }

  void write_pivot_sheet() {
    if (pivot_ == nullptr) return;
    const auto parameters = pivot_parameters(plan_, outcomes_);
    if (!parameters) return;
    std::vector<std::size_t> of_parameter(plan_.parameters.size()), of_measure(measures_.size());
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (columns_[k].parameter) of_parameter[*columns_[k].parameter] = k;
      if (columns_[k].measure) of_measure[*columns_[k].measure] = k;
      for (std::size_t m = 0; m < measures_.size(); ++m)
        if (columns_[k].summary && measures_[m].name == columns_[k].name) of_measure[m] = k;
    }
    write_pivot(*pivot_, plan_, measures_, outcomes_, *parameters, of_parameter, of_measure, in_table_ ? count_ : 0);
  }

  void write_charts(const std::vector<PlacedSeries>& placed) {
    std::vector<ChartData> charts;
    for (const Chart& chart : chosen_charts(plan_, measures_, outcomes_))
      charts.push_back(chart_data(chart, plan_, measures_, outcomes_));
    std::string varied;
    for (const Parameter& parameter : plan_.parameters) varied += (varied.empty() ? "" : ", ") + parameter.path;
    std::string text = fmt::format("{} runs", count_);
    if (failed_ > 0) text += fmt::format(", {} of them failed", failed_);
    if (!varied.empty()) text += "; varied: " + varied;
    charts_.write(plan_.title, {text}, charts, placed);
  }

  std::vector<std::string> remarks() const {
    std::vector<std::string> remarks;
    if (count_ > most_in_table)
      remarks.push_back(
          fmt::format("Summary is a table of up to {} runs; of more it is a range with filters.", most_in_table));
    if (count_ + 1 > most_rows)
      remarks.push_back(fmt::format("Summary holds the first {} runs; summary.csv has all.", most_rows - 1));
    remarks.push_back(fmt::format("Series: at most {} points of a run, evenly chosen.", series_.points()));
    if (series_.left_out() > 0)
      remarks.push_back(
          fmt::format("Series: {} runs had no room, or have tables too long for it.", series_.left_out()));
    if (collisions_.full())
      remarks.push_back(
          fmt::format("Collisions: the first {}; collisions.csv of each run has all.", CollisionSheet::most));
    return remarks;
  }

  FilePlace place_;
  ComparisonPlan plan_;
  std::size_t count_, failed_ = 0;
  std::vector<Measure> measures_;
  std::vector<Column> columns_;
  std::vector<std::string> heads_;  // of the table, by column
  bool in_table_;
  Workbook book_;
  CompareSheet charts_;
  Sheet& sheet_;
  Sheet *repeats_, *pivot_;
  Sheet& series_sheet_;
  CollisionSheet collisions_;
  ParameterSheet parameters_;
  Sheet& about_;
  std::unique_ptr<OutputFile> table_;
  Outcomes outcomes_;
  SeriesGatherer series_;
  CommonValues common_;
};

/// Whether two parameters vary by themselves: sheets are made in their order, before the runs are read.
bool do_two_vary(const ComparisonPlan& plan, std::size_t count, const std::function<ComparedRun(std::size_t)>& run,
                 const ComparisonWatch& watch) {
  if (plan.parameters.size() < 2) return false;
  Outcomes outcomes(plan, 0, count);
  for (std::size_t i = 0; i < count; ++i) {
    watch.look();
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
    if (!known) measures.push_back(parse_measure(name));
  };
  for (const std::string& name : plan.measures) add(name);
  for (const Chart& chart : plan.charts) {
    add(chart.y);
    if (!find_parameter(plan, chart.x)) add(chart.x);
  }
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
    if (!near.empty()) remedy = fmt::format("; did you mean {}?", quoted(near));
    if (near.empty() && !paths.empty()) remedy = fmt::format("; what varies is {}", fmt::join(paths, ", "));
    throw MeasureError(fmt::format("a chart's {} {}{}", quoted(name), what, remedy));
  };
  for (const Chart& chart : plan.charts) {
    if (!chart.by.empty() && !find_parameter(plan, chart.by)) refuse(chart.by, "does not vary");
    if (find_parameter(plan, chart.x)) continue;
    try {
      parse_measure(chart.x);
    } catch (const MeasureError&) {
      refuse(chart.x, "does not vary and is no measure");
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
    watch.look();
    comparison.add(i, run(i));
    watch.done(i + 1);
  }
  return comparison.finish();
}

}  // namespace carom
