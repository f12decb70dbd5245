// Tick i is (offset + i * numerator) / denominator, rounded once.
// A sum of intervals would drift, and the product i * 0.01 is not the double of the decimal that the author means.
// Intervals are therefore recovered as decimals or as one over a whole number.
#include "export/timeline.h"

#include <charconv>

#include "numerics/whole.h"
#include "std.h"

namespace carom {
namespace {

/// Beyond this number doubles do not represent every whole number, so no tick has a higher number.
constexpr int64_t most_ticks = int64_t{1} << 53;

/// The whole number below `x`, limited to what can be counted.
int64_t tick_number(double x) {
  return clamp<int64_t>(whole_below(x), 0, most_ticks);
}

struct Ratio {
  double numerator, denominator;
};

/// `value` as the short decimal m/10^k that an author wrote, if it is one.
/// Both parts are exact doubles.
/// Their quotient, and that of any multiple, is therefore the double nearest to the decimal.
optional<Ratio> as_decimal(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific).ptr;

  // The digits as a whole number, and those behind the point.
  int64_t digits = 0;
  int exponent = 0, places = 0, count = 0;
  bool after_point = false;
  const char* c = text;
  for (; c != end && *c != 'e'; ++c) {
    if (*c == '.') {
      after_point = true;
      continue;
    }
    digits = digits * 10 + (*c - '0');
    ++count;
    places += after_point;
  }

  std::from_chars(c + (c[1] == '+' ? 2 : 1), end, exponent);
  exponent -= places;

  // At most 15 digits: more are the digits of a quotient like 1/30, not of a written number.
  // 10^22 is the largest exact power.
  if (count > 15 || exponent > 0 || exponent < -22) return nullopt;

  double power = 1;
  for (int i = exponent; i < 0; ++i) power *= 10;
  const Ratio ratio{double(digits), power};
  return ratio.numerator / ratio.denominator == value ? optional(ratio) : nullopt;
}

Ratio as_ratio(double interval) {
  if (const auto decimal = as_decimal(interval)) return *decimal;
  const double n = std::round(1 / interval);
  if (n < double(most_ticks) && 1 / n == interval) return {1, n};
  return {interval, 1};
}

}  // namespace

Ticks Ticks::every(double interval, double duration) {
  if (!(interval > 0) || !(duration >= 0) || !isfinite(duration))
    throw std::invalid_argument("Ticks::every: the interval must be positive, the duration finite and not negative");
  Ticks ticks;
  const Ratio ratio = as_ratio(interval);
  ticks.numerator_ = ratio.numerator;
  ticks.denominator_ = ratio.denominator;
  // A tick that differs from the end only by rounding is the end itself.
  const double rounding = max(1e-9 * interval, 2 * numeric_limits<double>::epsilon() * duration);
  const double limit = duration - min(rounding, interval / 2);
  // The number of ticks below the limit, except for rounding.
  int64_t below = tick_number(duration / interval);
  for (int i = 0; i < 3 && below > 0 && ticks.at(below - 1) >= limit; ++i) --below;
  for (int i = 0; i < 3 && below < most_ticks && ticks.at(below) < limit; ++i) ++below;
  // A start is never rounded away.
  ticks.last_ = duration > 0 ? max<int64_t>(below, 1) : 0;
  ticks.end_ = duration;
  ticks.closes_ = true;
  return ticks;
}

Ticks Ticks::rate(double per_second, double from, double until) {
  if (!(per_second > 0) || !isfinite(per_second))
    throw std::invalid_argument("Ticks::rate: the rate must be positive and finite");
  Ticks ticks;
  ticks.denominator_ = per_second;
  // Compare with the quotient, not the product. i/fps is the time of a tick, and `from` and `until` refer to it.
  int64_t first = tick_number(from * per_second);
  for (int i = 0; i < 3 && first > 0 && ticks.at(first - 1) >= from; ++i) --first;
  for (int i = 0; i < 3 && first < most_ticks && ticks.at(first) < from; ++i) ++first;
  ticks.first_ = first;
  ticks.last_ = max(until >= 0 ? ticks.last_until(until, until * per_second) : -1, first - 1);
  return ticks;
}

// a/b + i c/d / fps = (a d fps + i b c) / (b d fps), with a/b = from and c/d = speed.
Ticks Ticks::film(double per_second, double speed, double from, double until, const optional<Slowdown>& slow) {
  if (!(per_second > 0) || !isfinite(per_second) || !(speed > 0) || !isfinite(speed))
    throw std::invalid_argument("Ticks::film: the rate and the speed must be positive and finite");
  Ticks ticks;
  const Ratio start = as_ratio(from), pace = as_ratio(speed);
  ticks.offset_ = start.numerator * pace.denominator * per_second;
  ticks.numerator_ = start.denominator * pace.numerator;
  ticks.denominator_ = start.denominator * pace.denominator * per_second;
  if (slow) ticks.clock_.emplace(speed, from, slow);
  const double plain = slow ? ticks.clock_->plain(until) : until;
  ticks.last_ = until >= from ? ticks.last_until(until, (plain - from) / speed * per_second) : -1;
  return ticks;
}

int64_t Ticks::last_until(double until, double guess) const {
  int64_t last = tick_number(guess);
  for (int i = 0; i < 3 && last >= 0 && at(last) > until; ++i) --last;
  for (int i = 0; i < 3 && last >= 0 && last < most_ticks && at(last + 1) <= until; ++i) ++last;
  return last;
}

Ticks Ticks::even(int64_t count, double from, double until) {
  Ticks ticks;
  if (count <= 0) return ticks;
  const auto steps = double(max<int64_t>(count - 1, 1));
  ticks.last_ = count - 1;
  ticks.offset_ = from * steps;
  ticks.numerator_ = until - from;
  ticks.denominator_ = steps;
  ticks.end_ = until;
  return ticks;
}

double Ticks::at(int64_t i) const {
  // The products are exact for every run of practical length. The division then rounds once.
  if (end_ && i == last_) return *end_;
  const double plain = (offset_ + double(i) * numerator_) / denominator_;
  return clock_ ? clock_->shown(plain) : plain;
}

double Ticks::number_at(double time) const {
  return ((clock_ ? clock_->plain(time) : time) * denominator_ - offset_) / numerator_;
}

void Ticks::cut(double end) {
  if (last_ < first_ || at(last_) <= end) return;
  end_.reset();
  last_ = numerator_ > 0 ? last_until(end, number_at(end)) : -1;
  last_ = max(last_, first_ - 1);
  if (!closes_) return;
  if (last_ < first_ || at(last_) < end) ++last_;
  end_ = end;
}

bool Ticks::has_times_of(const Ticks& other) const {
  return count() == other.count() && !clock_ && !other.clock_ &&
         (count() == 0 || (at(first_) == other.at(other.first_) && at(last_) == other.at(other.last_)));
}

int Ticks::decimals() const {
  constexpr int most = 6;
  double interval = this->interval();
  if (count() < 2 || !(interval > 0)) interval = 1;
  if (clock_) return clamp(1 - int(floor(std::log10(interval * clock_->slowest()))), 0, 17);
  const auto is_whole = [](double x) { return std::abs(x - std::round(x)) < 1e-6; };
  double power = 1;
  for (int i = 0; i <= most; ++i, power *= 10)
    if (is_whole(at(first_) * power) && is_whole(at(last_) * power) && (count() < 2 || is_whole(interval * power)))
      return i;
  return count() < 2 ? most : clamp(1 - int(floor(std::log10(interval))), 0, 17);
}

Timeline::Timeline(double duration) : duration_(duration) {}

int Timeline::add(const Ticks& ticks) {
  streams_.push_back({ticks, ticks.first(), false});
  return int(streams_.size()) - 1;
}

bool Timeline::advance() {
  // Mark all due outputs as done.
  for (Stream& stream : streams_) {
    stream.next += stream.due;
    stream.due = false;
  }
  if (ended_) return false;
  find_due();
  return true;
}

void Timeline::find_due() {
  double next = duration_;
  for (const Stream& stream : streams_)
    if (stream.next <= stream.ticks.last()) next = min(next, stream.ticks.at(stream.next));
  time_ = next;
  for (Stream& stream : streams_)
    stream.due = stream.next <= stream.ticks.last() && stream.ticks.at(stream.next) == next;
  ended_ = next == duration_;
}

void Timeline::end_at(double time) {
  duration_ = time;
  for (Stream& stream : streams_) stream.ticks.cut(time);
  find_due();
}

optional<int64_t> Timeline::due(int stream) const {
  const Stream& s = streams_.at(size_t(stream));
  return s.due ? optional(s.next) : nullopt;
}

bool Timeline::is_empty(int stream) const {
  return streams_.at(size_t(stream)).ticks.count() < 1;
}

optional<double> Timeline::next(int stream) const {
  const Stream& s = streams_.at(size_t(stream));
  return s.next <= s.ticks.last() ? optional(s.ticks.at(s.next)) : nullopt;
}

}  // namespace carom
