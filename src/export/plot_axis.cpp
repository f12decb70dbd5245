// A tick is a whole multiple of a step 1, 2 or 5 times 10^k. Its text has the digits of that product, so that no text
// shows rounding.
#include "export/plot_axis.h"

#include <fmt/format.h>

#include "std.h"
#include "yaml/letters.h"

namespace carom {
namespace {

/// Ends closer than this share of their size differ by rounding, as far as a tick's text could show.
constexpr double rounding_share = 1e-6;

/// Above and below the values of a linear plot, as a share of their range.
constexpr double axis_margin = 0.05;
constexpr int most_x_ticks = 7, most_y_ticks = 6;

/// The least and the greatest of the values taken.
struct ValueRange {
  double low = infinity, high = -low;
  void take(double value) {
    if (!isfinite(value)) return;
    low = min(low, value);
    high = max(high, value);
  }
};

/// The text of count * 10^power.
string decimal_text(int64_t count, int power) {
  if (count == 0) return "0";
  if (power >= 0) return fmt::format("{}", count * int64_t(pow(10, power)));
  const string digits = fmt::format("{:0{}}", std::abs(count), 1 - power);
  const size_t point = digits.size() - size_t(-power);
  return (count < 0 ? "-" : "") + digits.substr(0, point) + "." + digits.substr(point);
}

string superscript(int exponent) {
  constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  string text;
  for (const char c : fmt::format("{}", exponent)) text += c == '-' ? "⁻" : digits[c - '0'];
  return text;
}

/// A multiple of 3, so that ticks have few digits. 0 from a hundredth to a hundred thousand.
int exponent_of(double largest) {
  const int power = int(floor(std::log10(largest)));
  return power >= -2 && power < 5 ? 0 : 3 * int(floor(power / 3.0));
}

}  // namespace

double RoundStep::value() const {
  // A quotient of exact numbers has one rounding.
  return power < 0 ? digit / pow(10, -power) : digit * pow(10, power);
}

RoundStep round_step(double least) {
  RoundStep step{1, int(floor(std::log10(least)))};
  for (const int digit : {1, 2, 5}) {
    step.digit = digit;
    if (step.value() >= least) return step;
  }
  return {1, step.power + 1};
}

double PlotAxis::part(double value) const {
  return logarithmic ? std::log10(value / from) / std::log10(to / from) : (value - from) / (to - from);
}

string PlotAxis::commands(char axis) const {
  if (logarithmic)
    return fmt::format(
        "set logscale {0}\nset {0}range [{1:.17g}:{2:.17g}]\nset format {0} '10^{{%T}}'\nset m{0}tics 10\n", axis, from,
        to);
  string list;
  for (const PlotTick& tick : ticks)
    list += fmt::format("{}'{}' {:.17g}", list.empty() ? "" : ", ", tick.text, tick.at);
  return fmt::format("set {0}range [{1:.17g}:{2:.17g}]\nset {0}tics ({3})\n", axis, from, to, list);
}

string PlotAxis::label(const string& what, const string& unit) const {
  const string power = exponent == 0 ? "" : "10" + superscript(exponent);
  if (power.empty() && unit.empty()) return what;
  return fmt::format("{} ({}{}{})", what, power, power.empty() || unit.empty() ? "" : " ", unit);
}

size_t PlotAxis::tick_letters() const {
  if (logarithmic) return 4;
  size_t most = 0;
  for (const PlotTick& tick : ticks) most = max(most, letters_of(tick.text));
  return most;
}

PlotAxis log_axis(double low, double high) {
  if (!(low <= high)) low = high = 1;
  constexpr double margin = 0.15;  // of a power of ten
  PlotAxis axis{pow(10, floor(std::log10(low) - margin)), pow(10, ceil(std::log10(high) + margin))};
  axis.logarithmic = true;
  return axis;
}

PlotAxis linear_axis(double low, double high, int most_ticks, double least_step) {
  // Beyond these a power of ten has no double.
  constexpr double most = 1e290, least = 1e-290;
  if (!(low <= high)) low = high = 0;
  low = clamp(low, -most, most);
  high = clamp(high, -most, most);
  if (max(std::abs(low), std::abs(high)) < least) low = high = 0;

  // Move equal ends apart.
  const double largest = max(std::abs(low), std::abs(high));
  if (high - low <= rounding_share * largest) {
    const double apart = largest == 0 ? 1 : largest / 10;
    low -= apart;
    high += apart;
  }

  PlotAxis axis{low, high};
  axis.exponent = exponent_of(max(std::abs(low), std::abs(high)));
  const RoundStep step = round_step(max((high - low) / most_ticks, least_step));
  const double slack = (high - low) * 1e-9;

  for (auto count = int64_t(ceil((low - slack) / step.value()));; ++count) {
    const double at = double(count) * step.value();
    if (!(at <= high + slack)) break;
    axis.ticks.push_back({at, decimal_text(count * step.digit, step.power - axis.exponent)});
  }
  return axis;
}

PlotAxes axes_of(const Plot& plot) {
  ValueRange x, y;
  for (const PlotSeries& series : plot.series) {
    for (const PlotPoint& point : series.points) {
      x.take(point.x);
      if (series.form != PlotForm::band) y.take(plot.height(point.y));
      if (series.form != PlotForm::band && plot.scale == PlotScale::logarithmic) continue;
      y.take(point.low);
      y.take(point.high);
    }
  }
  for (const PlotLevel& level : plot.levels) y.take(plot.height(level.y));

  if (plot.scale == PlotScale::logarithmic) return {log_axis(x.low, x.high), log_axis(y.low, y.high)};

  x.take(plot.x_from);
  x.take(plot.x_to);
  if (plot.from_zero) y.take(0);
  if (plot.from_zero && y.high <= 0) y.high = 1;

  // Round the values' range first, then leave room above and below.
  PlotAxis flat = linear_axis(y.low, y.high, most_y_ticks);
  const double room = axis_margin * (flat.to - flat.from);
  return {linear_axis(x.low, x.high, most_x_ticks),
          linear_axis(plot.from_zero ? 0 : flat.from - room, flat.to + room, most_y_ticks, plot.counts ? 1 : 0)};
}

}  // namespace carom
