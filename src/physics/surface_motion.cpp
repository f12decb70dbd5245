// The positions of fixed things that move. A leg's start is a sum of products in double-double, so that a thousand
// windows cost no digits. The instants of windows stay those of the scene: no running time is added up. A swing's angle
// is reduced in double-double before its sine is taken.
#include "physics/surface_motion.h"

#include "numerics/degrees.h"
#include "numerics/elementary.h"
#include "physics/trigger.h"
#include "std.h"

namespace carom {

namespace {

/// 2 pi, the second double being the rounding error of the first.
constexpr DoubleDouble full_turn{0x1.921fb54442d18p+2, 0x1.1a62633145c07p-52};
// Pieces of a period in which a polynomial of degree 8 is the path to 1e-15: for 1 / 36 of a turn.
constexpr double pieces = 36;
// Keyframes of a period: 1 - cos(pi / 72) is less than 1e-3.
constexpr double keys = 72;

/// A leg as it is in one period.
struct LegAt {
  double period = 0;  // number
  size_t leg = 0;
};

/// When it starts (s).
DoubleDouble start_of(const SurfaceMotion& motion, const LegAt& at) {
  const DoubleDouble within{motion.legs[at.leg].from, 0};
  return at.period == 0 ? within : two_product(at.period, motion.every) + within;
}

bool is_before(const DoubleDouble& a, const DoubleDouble& b) {
  return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}

/// The last leg that starts no later than `time` (s). Starts are compared as start_of() gives them, so that each leg
/// has begun at its own start.
LegAt present_leg(const SurfaceMotion& motion, const DoubleDouble& time) {
  LegAt at;
  if (motion.every < infinity) {
    at.period = max(0.0, std::floor(time.hi / motion.every) - 1);
    while (!is_before(time, start_of(motion, {at.period + 1, 0}))) ++at.period;
  }

  const auto later = [&](const DoubleDouble& t, const MotionLeg& leg) {
    return is_before(t, start_of(motion, {at.period, size_t(&leg - motion.legs.data())}));
  };
  at.leg = size_t(std::upper_bound(motion.legs.begin() + 1, motion.legs.end(), time, later) - motion.legs.begin()) - 1;
  return at;
}

/// Whether the first leg of a period goes on as the last one of the period before. It is then no leg of its own.
bool goes_on(const SurfaceMotion& motion, const LegAt& at) {
  return at.period > 0 && at.leg == 0 && motion.legs.front().velocity == motion.legs.back().velocity;
}

/// The displacement on a leg since time 0 (m), at a time (s), along one axis.
DoubleDouble along(const MotionLeg& leg, const DoubleDouble& since, int axis) {
  const DoubleDouble start{leg.start[axis], leg.start_low[axis]};
  if (leg.velocity[axis] == 0) return start;
  return start + since * DoubleDouble{leg.velocity[axis], 0};
}

MotionLeg next_leg(const vector<MotionLeg>& legs, double from, const Vec3& velocity) {
  MotionLeg next{from, velocity, Vec3::Zero(), Vec3::Zero()};
  for (int axis = 0; axis < 3 && !legs.empty(); ++axis) {
    const DoubleDouble since = DoubleDouble{from, 0} - DoubleDouble{legs.back().from, 0};
    const DoubleDouble at = along(legs.back(), since, axis);
    next.start[axis] = at.hi;
    next.start_low[axis] = at.lo;
  }
  return next;
}

/// The legs of windows, which may overlap: there their velocities add up. A window that waits for an event is left out,
/// and one that waits for its end has none.
vector<MotionLeg> legs_of(span<const MotionWindow> windows, double every) {
  vector<MotionWindow> known;
  vector<double> starts;
  for (const MotionWindow& window : windows) {
    if (window.velocity.isZero(0) || window.from == not_yet || !(window.from < window.until)) continue;
    known.push_back(window);
    starts.push_back(window.from);
    if (window.until < min(every, not_yet)) starts.push_back(window.until);
  }
  ranges::sort(starts);
  starts.erase(std::unique(starts.begin(), starts.end()), starts.end());

  vector<MotionLeg> legs;
  if (!starts.empty() && starts.front() > 0) legs.push_back(next_leg(legs, 0, Vec3::Zero()));

  // The windows that hold from each start on.
  ranges::stable_sort(known, {}, &MotionWindow::from);
  auto next = known.begin();
  vector<MotionWindow> now;
  for (const double start : starts) {
    std::erase_if(now, [&](const MotionWindow& window) { return window.until <= start; });
    for (; next != known.end() && next->from == start; ++next) now.push_back(*next);
    Vec3 velocity = Vec3::Zero();
    for (const MotionWindow& window : now) velocity += window.velocity;
    legs.push_back(next_leg(legs, start, velocity));
  }
  return legs;
}

/// Sine and cosine of a swing's angle at a time (s).
SinCos turned(const Swing& swing, const DoubleDouble& time) {
  const DoubleDouble period{swing.period, 0};
  const DoubleDouble since = time - two_product(std::floor(time.hi / swing.period), swing.period);
  const DoubleDouble turns = since / period;
  const double quarters = std::nearbyint(4 * turns.hi);
  const auto [sine, cosine] = sin_cos((turns - DoubleDouble{0.25 * quarters, 0}) * full_turn);

  switch ((int(quarters) + 8) % 4) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

/// The greatest distance from the middle (m).
double width_of(const Swing& swing) {
  // The greater eigenvalue of sine sine^T + cosine cosine^T.
  const double ss = swing.sine.squaredNorm();
  const double cc = swing.cosine.squaredNorm();
  const double sc = swing.sine.dot(swing.cosine);
  const double half = 0.5 * (ss - cc);
  return sqrt(0.5 * (ss + cc) + sqrt(half * half + sc * sc));
}

SurfaceMotion swinging(double period, const Vec3& sine, const Vec3& cosine) {
  SurfaceMotion motion;
  if (!sine.isZero(0) || !cosine.isZero(0)) motion.swing = Swing{period, -cosine, sine, cosine};
  return motion;
}

/// The starts of legs within a span of time (s), with those of periods `first` to `last`.
void add_starts(const SurfaceMotion& motion, double first, double last, double from, double until,
                vector<double>& times) {
  for (double period = first; period <= last; ++period)
    for (size_t leg = 0; leg < motion.legs.size(); ++leg) {
      const double start = start_of(motion, {period, leg}).value();
      if (start > from && start < until) times.push_back(start);
    }
}

/// At even spaces a whole number of times in a period, from `from` on.
void add_samples(const Swing& swing, double from, double until, vector<double>& times) {
  const double space = swing.period / keys;
  for (double k = 1; from + k * space < until; ++k) times.push_back(from + k * space);
}

}  // namespace

SurfaceMotion motion_in_windows(span<const MotionWindow> windows, double every) {
  SurfaceMotion motion;
  vector<MotionLeg>& legs = motion.legs;
  legs = legs_of(windows, every);
  if (legs.empty() || every == infinity) return motion;

  // The period ends where a leg in the next one would start.
  motion.every = every;
  const MotionLeg end = next_leg(legs, every, Vec3::Zero());
  motion.gain = end.start;
  motion.gain_low = end.start_low;
  return motion;
}

SurfaceMotion motion_by_events(vector<MotionWindow> windows) {
  SurfaceMotion motion;
  motion.windows = std::move(windows);
  motion.follow_windows();
  return motion;
}

void SurfaceMotion::follow_windows() {
  legs = legs_of(windows, infinity);
  if (legs.empty()) legs.push_back(next_leg({}, 0, Vec3::Zero()));
}

SurfaceMotion motion_on_sine(const Vec3& amplitude, double period, double phase) {
  const SinCos of = sin_cos_degrees(phase);
  return swinging(period, of.cos * amplitude, of.sin * amplitude);
}

SurfaceMotion motion_on_circle(const Vec3& place, const Vec3& center, const Vec3& axis, double period) {
  const Vec3 n = axis.normalized();
  const Vec3 from_center = place - center;
  const Vec3 out = from_center - n.dot(from_center) * n;
  return swinging(period, n.cross(out), out);
}

DoubleDouble leg_start(const SurfaceMotion& motion, const DoubleDouble& time) {
  if (motion.legs.empty()) return {0, 0};
  LegAt at = present_leg(motion, time);
  if (goes_on(motion, at)) at = {at.period - 1, motion.legs.size() - 1};
  // One velocity throughout.
  return motion.legs.size() == 1 ? DoubleDouble{0, 0} : start_of(motion, at);
}

DoubleDouble next_leg_start(const SurfaceMotion& motion, const DoubleDouble& time) {
  if (motion.legs.empty()) return {infinity, 0};
  LegAt next = present_leg(motion, time);
  // Before time 0 the first leg is the next one.
  if (is_before(time, start_of(motion, next))) return start_of(motion, next);
  if (++next.leg == motion.legs.size()) {
    if (motion.every == infinity) return {infinity, 0};
    next = {next.period + 1, 0};
    if (goes_on(motion, next)) ++next.leg;
    if (next.leg == motion.legs.size()) return {infinity, 0};
  }
  return start_of(motion, next);
}

Vec3 place_on(const Vec3& from, const SurfaceMotion& motion, const DoubleDouble& time) {
  if (motion.swing) {
    const auto [sine, cosine] = turned(*motion.swing, time);
    return from + (sine * motion.swing->sine + (motion.swing->middle + cosine * motion.swing->cosine));
  }

  const LegAt at = present_leg(motion, time);
  const DoubleDouble since = time - start_of(motion, at);
  Vec3 x;
  for (int axis = 0; axis < 3; ++axis) {
    DoubleDouble way = along(motion.legs[at.leg], since, axis);
    if (at.period > 0) way = way + DoubleDouble{at.period, 0} * DoubleDouble{motion.gain[axis], motion.gain_low[axis]};
    x[axis] = (DoubleDouble{from[axis], 0} + way).value();
  }
  return x;
}

Vec3 velocity_on(const SurfaceMotion& motion, const DoubleDouble& time) {
  if (!motion.swing) return motion.legs[present_leg(motion, time).leg].velocity;
  const auto [sine, cosine] = turned(*motion.swing, time);
  return turning_rate(*motion.swing) * (cosine * motion.swing->sine - sine * motion.swing->cosine);
}

Vec3 acceleration_on(const SurfaceMotion& motion, const DoubleDouble& time) {
  if (!motion.swing) return Vec3::Zero();
  const auto [sine, cosine] = turned(*motion.swing, time);
  const double rate = turning_rate(*motion.swing);
  return -(rate * rate) * (sine * motion.swing->sine + cosine * motion.swing->cosine);
}

/// Through velocity, acceleration and jerk at the start and the end, and the first two in the middle. A body that
/// leaves the thing at the start may be slow, so that the velocity is exact there.
PolynomialPath::Terms displacement_on(const Swing& swing, const DoubleDouble& time, double length) {
  const double rate = turning_rate(swing);
  const auto at = [&](double since) {
    const auto [sine, cosine] = turned(swing, time + DoubleDouble{since, 0});
    const Vec3 velocity = rate * (cosine * swing.sine - sine * swing.cosine);
    const Vec3 acceleration = -(rate * rate) * (sine * swing.sine + cosine * swing.cosine);
    return PolynomialPath::Point{velocity, acceleration, -(rate * rate) * velocity};
  };
  return PolynomialPath::through(length, at(0), at(0.5 * length), at(length)).displacement;
}

double turning_rate(const Swing& swing) {
  return full_turn.hi / swing.period;
}

double smooth_time(const Swing& swing) {
  return swing.period / pieces;
}

double width_along(const Swing& swing, const Vec3& direction) {
  const double s = swing.sine.dot(direction);
  const double c = swing.cosine.dot(direction);
  return sqrt(s * s + c * c);
}

double greatest_acceleration(const Swing& swing) {
  return turning_rate(swing) * greatest_speed(swing);
}

double greatest_speed(const Swing& swing) {
  return turning_rate(swing) * width_of(swing);
}

double swept_along(const SurfaceMotion& motion, const Vec3& direction) {
  if (motion.swing) return motion.swing->middle.dot(direction) + (1 + 0x1p-50) * width_along(*motion.swing, direction);
  if (!motion.moves()) return 0;

  // Nobody knows how far a window goes that waits for an event.
  const auto waits = [&](const MotionWindow& w) {
    return (w.from == not_yet || w.until == not_yet) && w.velocity.dot(direction) > 0;
  };
  if (any_of(motion.windows, waits)) return infinity;

  // The last leg has no end, or each period goes on from where the one before has arrived.
  const Vec3& on = motion.every < infinity ? motion.gain : motion.legs.back().velocity;
  if (on.dot(direction) > 0) return infinity;
  double farthest = 0;
  for (const MotionLeg& leg : motion.legs) farthest = max(farthest, leg.start.dot(direction));
  return farthest;
}

vector<double> key_times(const SurfaceMotion& motion, double from, double until) {
  vector<double> times{from};
  if (motion.swing) {
    add_samples(*motion.swing, from, until, times);
  } else {
    const bool repeats = motion.every < infinity;
    const double first = repeats ? max(0.0, std::floor(from / motion.every) - 1) : 0;
    add_starts(motion, first, repeats ? std::floor(until / motion.every) + 1 : 0, from, until, times);
  }
  if (until > times.back()) times.push_back(until);
  return times;
}

vector<double> farthest_times(const SurfaceMotion& motion, double from, double until) {
  if (motion.swing) return key_times(motion, from, min(until, from + motion.swing->period));
  if (motion.every == infinity) return key_times(motion, from, until);
  const double once = 2 * motion.every;
  if (!(until - from > 2 * once)) return key_times(motion, from, until);
  vector<double> times = key_times(motion, from, from + once);
  for (const double time : key_times(motion, until - once, until)) times.push_back(time);
  return times;
}

}  // namespace carom
