// A slowdown follows from one constant, the time T that a viewer needs to react to what is seen. With n = 2^k:
// - At the slowest, bodies close by a radius of the smaller one in T: at the speed w that takes n = w T / r, times the
//   film's own speed. Each is rounded to a power of 2, which is exact, and reads well in a caption.
// - That holds for 2 T before the collision and after it, so that the last diameter of the approach is seen.
// - Before and after that the speed halves or doubles in T. The eye compares speeds by their ratio (Weber's law; McKee,
//   Vision Research 21, 1981), so that equal ratios in equal times look even. At 30 pictures a second it is a tenth
//   from picture to picture.
// With v = T' y, T' the motion in T at full speed, and u the motion shown, both from the collision: u = v / n up to
// y = 2, then du/dv = 2^(y - 2) / n up to y = 2 + k, so that
//   u = T'/n (2 + (2^(y - 2) - 1) / ln 2),
// and 1 beyond. A film that shows all of it is longer by 2 T (k + 2 - 2/n - (1 - 1/n) / ln 2).
#include "scene/film_clock.h"

#include <fmt/format.h>

#include <numbers>

#include "std.h"

namespace carom {
namespace {

/// s, of a simple reaction to something seen: Woods et al., Frontiers in Human Neuroscience 9:131 (2015), have 0.231.
constexpr double reaction = 0.25;
constexpr double hold = 2;  // of these, at the slowest, before the collision and after it
constexpr int most_halvings = 6;

using std::numbers::ln2;

/// By how much more a half of it lasts in a film than its motion does at full speed, in T.
double delay_of_half(int halvings) {
  const double slowest = std::exp2(-halvings);
  return halvings + hold - hold * slowest - (1 - slowest) / ln2;
}

}  // namespace

int halvings_for(double relative_speed, double radius, double film_speed) {
  const double ratio = relative_speed * reaction * film_speed / radius;
  return ratio > 2 ? int(clamp(std::round(std::log2(ratio)), 1.0, double(most_halvings))) : 1;
}

double most_delay() {
  return 2 * reaction * delay_of_half(most_halvings);
}

FilmClock::FilmClock(double speed, double from, const optional<Slowdown>& slow)
    : speed_(speed), from_(from), slow_(slow) {
  if (!slow_) return;
  unit_ = reaction * speed;
  slowest_ = std::exp2(-slow_->halvings);
  half_ = (hold + slow_->halvings) * unit_;
  shown_half_ = half_ - delay_of_half(slow_->halvings) * unit_;
  middle_ = from + back(slow_->time - from);
}

double FilmClock::way(double v) const {
  const double y = std::abs(v) / unit_;
  if (y <= hold) return v * slowest_;
  const double u = std::abs(v) < half_ ? unit_ * slowest_ * (hold + (std::exp2(y - hold) - 1) / ln2)
                                       : std::abs(v) - (half_ - shown_half_);
  return std::copysign(u, v);
}

double FilmClock::back(double u) const {
  const double z = std::abs(u) / (unit_ * slowest_);
  if (z <= hold) return u / slowest_;
  const double v = std::abs(u) < shown_half_ ? unit_ * (hold + std::log2(1 + (z - hold) * ln2))
                                             : std::abs(u) + (half_ - shown_half_);
  return std::copysign(v, u);
}

double FilmClock::shown(double plain) const {
  if (!slow_ || plain <= from_ || plain <= slow_->time - shown_half_) return plain;
  return slow_->time + way(plain - middle_);
}

double FilmClock::plain(double shown) const {
  if (!slow_ || shown <= from_ || shown <= slow_->time - shown_half_) return shown;
  return middle_ + back(shown - slow_->time);
}

double FilmClock::pace(double shown) const {
  if (!slow_) return 1;
  const double y = std::abs(back(shown - slow_->time)) / unit_;
  return slowest_ * std::exp2(clamp(y - hold, 0.0, double(slow_->halvings)));
}

string FilmClock::text(double shown) const {
  const double halvings = std::round(-std::log2(pace(shown)));
  if (!(halvings > 0)) return "";
  const double speed = speed_ * std::exp2(-halvings), parts = std::round(1 / speed);
  return parts > 1 && std::abs(parts * speed - 1) < 1e-9 ? fmt::format("1/{:.0f} speed", parts)
                                                         : fmt::format("{:.2g} × speed", speed);
}

}  // namespace carom
