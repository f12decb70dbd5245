// Keeps a few numbers for each point, with values of parameters as indices into their distinct values.
// Repeats are accumulated in one pass (Spread), so that their runs need not be kept.
#include "compare/outcomes.h"

#include <fmt/format.h>

#include <numeric>

#include "files/csv.h"
#include "std.h"
#include "workbook/number_look.h"
#include "yaml/values.h"

namespace carom {
namespace {

struct SpreadColumn {
  const char* name;
  double (*value)(const Spread&);
};
constexpr SpreadColumn spread_columns[] = {{"mean", [](const Spread& s) { return s.mean(); }},
                                           {"sd", [](const Spread& s) { return s.sd(); }},
                                           {"min", [](const Spread& s) { return s.min(); }},
                                           {"max", [](const Spread& s) { return s.max(); }}};

/// By measure: whether it has no value in some complete runs, so that it needs its own n.
vector<bool> uneven_measures(const Outcomes& outcomes, size_t measures) {
  vector<bool> uneven(measures);
  for (size_t k = 0; k < measures; ++k)
    for (size_t i = 0; i < outcomes.points() && !uneven[k]; ++i)
      uneven[k] = outcomes.spread(i, k).count() != outcomes.runs(i);
  return uneven;
}

/// `uneven`: by measure. `labels`: readable ones, for a sheet.
vector<string> repeats_header(const ComparisonPlan& plan, const vector<Measure>& measures, const vector<bool>& uneven,
                              bool labels) {
  vector<string> header;
  for (size_t p = 0; p < plan.parameters.size(); ++p)
    if (p != plan.seed) header.push_back(labels ? label_of(plan.parameters[p]) : plan.parameters[p].path);
  header.emplace_back("n");

  for (size_t k = 0; k < measures.size(); ++k) {
    const auto add = [&](const char* name) {
      header.push_back(labels ? fmt::format("{}, {}", label_of(measures[k].name), name)
                              : fmt::format("{}.{}", measures[k].name, name));
    };
    if (uneven[k]) add("n");
    for (const SpreadColumn& column : spread_columns) add(column.name);
  }
  return header;
}

/// Calls use(column, cell) for the cells of a point's row. `uneven`: by measure.
template <typename Use>
void for_cells(const ComparisonPlan& plan, const vector<bool>& uneven, const Outcomes& outcomes, size_t point,
               const Use& use) {
  size_t column = 0;
  for (const Varied& varied : outcomes.varied())
    if (varied.parameter != plan.seed) use(column++, varied.values[varied.of_point[point]]);
  use(column++, Cell{{}, double(outcomes.runs(point))});
  for (size_t k = 0; k < uneven.size(); ++k) {
    const Spread spread = outcomes.spread(point, k);
    if (uneven[k]) use(column++, Cell{{}, double(spread.count())});
    for (const SpreadColumn& of : spread_columns) use(column++, Cell{{}, of.value(spread)});
  }
}

}  // namespace

void Spread::add(double value) {
  if (!isfinite(value)) return;
  ++count_;
  min_ = count_ == 1 ? value : std::min(min_, value);
  max_ = count_ == 1 ? value : std::max(max_, value);
  const double before = value - mean_;
  mean_ += before / double(count_);
  squares_ += before * (value - mean_);
}

double Spread::sd() const {
  return count_ > 1 ? sqrt(squares_ / double(count_ - 1)) : numeric_limits<double>::quiet_NaN();
}

Outcomes::Outcomes(const ComparisonPlan& plan, size_t measures, size_t runs)
    : seed_(plan.seed),
      measures_(measures),
      stride_(plan.seed ? 1 : 1 + (max<size_t>(runs, 1) - 1) / most_points),
      varied_(plan.parameters.size()),
      numbers_(plan.parameters.size()) {
  // Repeats are points of their scenarios, whose number is not known.
  const size_t points = seed_ ? 0 : (runs + stride_ - 1) / stride_;
  for (size_t p = 0; p < varied_.size(); ++p) {
    varied_[p].parameter = p;
    varied_[p].of_point.reserve(points);
  }
  runs_.reserve(points);
  id_ends_.reserve(points);
  values_.reserve(points * measures_);
}

size_t Outcomes::add(size_t number, const ComparedRun& run, bool done, const vector<double>& measures) {
  if (number % stride_ != 0) return no_point;

  // The run's values, as indices.
  vector<uint32_t> key;
  for (size_t p = 0; p < varied_.size(); ++p) {
    if (p == seed_) continue;
    const string& text = run.values.at(p);
    const auto [found, fresh] = numbers_[p].emplace(text, uint32_t(varied_[p].values.size()));
    if (fresh) found->second = number_of(cell_of(text), p);
    key.push_back(found->second);
  }

  // Its point: that of its scenario, or a new one.
  size_t point = points();
  if (seed_) point = scenarios_.emplace(key, point).first->second;
  if (point == points()) {
    runs_.push_back(0);
    ids_ += run.id;
    id_ends_.push_back(ids_.size());
    if (seed_)
      spreads_.resize(spreads_.size() + measures_);
    else
      values_.resize(values_.size() + measures_, numeric_limits<double>::quiet_NaN());
    for (size_t p = 0, k = 0; p < varied_.size(); ++p)
      if (p != seed_) varied_[p].of_point.push_back(key[k++]);
  }

  if (!done) return point;
  ++runs_[point];
  for (size_t k = 0; k < measures_; ++k) {
    if (seed_)
      spreads_[point * measures_ + k].add(measures[k]);
    else
      values_[point * measures_ + k] = measures[k];
  }
  return point;
}

/// The index of a value of parameter p: 1.0 is 1.
uint32_t Outcomes::number_of(Cell value, size_t p) {
  Varied& varied = varied_[p];
  const auto fresh = uint32_t(varied.values.size());
  if (value.is_number()) {
    const uint32_t known = numbers_[p].emplace(shortest(value.number), fresh).first->second;
    if (known != fresh) return known;
  }

  varied.numeric = varied.numeric && value.is_number();
  varied.values.push_back(std::move(value));
  return fresh;
}

string_view Outcomes::id(size_t point) const {
  const size_t begin = point == 0 ? 0 : id_ends_[point - 1];
  return string_view(ids_).substr(begin, id_ends_[point] - begin);
}

Spread Outcomes::spread(size_t point, size_t measure) const {
  if (seed_) return spreads_[point * measures_ + measure];
  Spread spread;
  spread.add(values_[point * measures_ + measure]);
  return spread;
}

void Outcomes::finish() {
  scenarios_.clear();
  numbers_.clear();
  for (Varied& varied : varied_) {
    if (!varied.numeric) continue;

    // Sort the values, and let the points have their new places.
    vector<uint32_t> order(varied.values.size()), place(order.size());
    std::iota(order.begin(), order.end(), 0);
    ranges::stable_sort(order, [&](auto a, auto b) { return varied.values[a].number < varied.values[b].number; });
    vector<Cell> sorted;
    for (uint32_t k = 0; k < order.size(); ++k) {
      place[order[k]] = k;
      sorted.push_back(std::move(varied.values[order[k]]));
    }

    varied.values = std::move(sorted);
    for (uint32_t& value : varied.of_point) value = place[value];
  }
}

/// Whether b has one value for each value of a.
bool Outcomes::follows(const Varied& a, const Varied& b) const {
  constexpr uint32_t unknown = numeric_limits<uint32_t>::max();
  vector<uint32_t> of(a.values.size(), unknown);
  for (size_t i = 0; i < a.of_point.size(); ++i) {
    uint32_t& known = of[a.of_point[i]];
    if (known != unknown && known != b.of_point[i]) return false;
    known = b.of_point[i];
  }

  // Samples and lists pair numbers at will. Only what rises or falls with another number follows from it. Indices of
  // values are in order of size.
  return !a.numeric || !b.numeric || ranges::is_sorted(of) || ranges::is_sorted(of, std::greater<>());
}

vector<size_t> Outcomes::independent() const {
  vector<size_t> chosen;
  for (const bool numeric : {true, false})
    for (size_t p = 0; p < varied_.size(); ++p) {
      if (varied_[p].values.size() < 2 || varied_[p].numeric != numeric) continue;
      const bool new_one = none_of(chosen, [&](size_t other) { return follows(varied_[other], varied_[p]); });
      if (new_one) chosen.push_back(p);
    }
  return chosen;
}

bool Outcomes::is_grid(size_t a, size_t b) const {
  return varied_[a].values.size() * varied_[b].values.size() <= 2 * points();
}

void AbsentValues::add(const vector<string>& values) {
  if (all_of(values, [](const string& value) { return value.empty(); })) return;
  for (size_t p = 0; p < values.size(); ++p) is_absent_[p] = is_absent_[p] || values[p].empty();
}

bool AbsentValues::unrelated() const {
  return 2 * size_t(ranges::count(is_absent_, true)) > is_absent_.size();
}

void write_repeats(OutputFile& file, const ComparisonPlan& plan, const vector<Measure>& measures,
                   const Outcomes& outcomes) {
  const vector<bool> uneven = uneven_measures(outcomes, measures.size());
  CsvRow row(file);
  for (const string& name : repeats_header(plan, measures, uneven, false)) row.text(name);
  row.end();

  const size_t count = plan.parameters.size() - 1;  // the column of n
  for (size_t i = 0; i < outcomes.points(); ++i) {
    for_cells(plan, uneven, outcomes, i, [&](size_t column, const Cell& cell) {
      if (column == count)
        row.count(outcomes.runs(i));
      else
        cell.is_number() ? row.number(cell.number) : row.text(cell.text);
    });
    row.end();
  }
}

void write_repeats(Worksheet& sheet, const ComparisonPlan& plan, const vector<Measure>& measures,
                   const Outcomes& outcomes) {
  const vector<bool> uneven = uneven_measures(outcomes, measures.size());
  const vector<string> header = repeats_header(plan, measures, uneven, true);
  const size_t parameters = plan.parameters.size() - 1;
  sheet.set_head_row(0);
  for (size_t column = 0; column < header.size(); ++column)
    sheet.head(0, column, header[column], column < parameters ? CellStyle::varied_header : CellStyle::header);

  vector<NumberLook> looks(header.size());
  for (size_t i = 0; i < outcomes.points(); ++i)
    for_cells(plan, uneven, outcomes, i, [&](size_t column, const Cell& cell) { looks[column].add(cell.number); });
  size_t row = 1;
  for (size_t i = 0; i < outcomes.points() && row < most_rows; ++i, ++row)
    for_cells(plan, uneven, outcomes, i, [&](size_t column, const Cell& cell) {
      sheet.cell(row, column, cell, column < parameters ? CellStyle::varied : CellStyle::plain, &looks[column]);
    });

  sheet.fit_table();
  sheet.freeze(1, parameters);
  worksheet_autofilter(sheet.get(), 0, 0, to_row(max<size_t>(row - 1, 1)), to_column(header.size() - 1));
  sheet.print_table(0);
}

}  // namespace carom
