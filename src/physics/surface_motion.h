#pragma once
// How fixed things move: at constant velocities in windows of time, which may repeat, or on a sine or a circle. Outside
// the windows a thing stands where it has arrived. On a plane only the motion along its normal has an effect, because
// there is no friction.
//
// Windows are a list of legs, and each leg starts from an exact sum of those before it. Legs that repeat are those of
// one period, and a multiple of what it gains: a long run makes no longer list. Sines and circles are closed forms of
// the time. Positions therefore have no error that grows.

#include "numerics/compensated.h"
#include "numerics/polynomial_path.h"
#include "numerics/vec3.h"
#include "std.h"

namespace carom {

/// A window of time in which a fixed thing moves.
struct MotionWindow {
  double from = 0;                // s
  double until = infinity;        // s
  Vec3 velocity = Vec3(0, 0, 0);  // m/s
};

/// A time from which on a fixed thing has a constant velocity, which may be zero. It lasts until the next leg starts.
struct MotionLeg {
  double from;     // s
  Vec3 velocity;   // m/s
  Vec3 start;      // m, the displacement since time 0 at `from`
  Vec3 start_low;  // m, the digits of it that `start` lacks
};

/// A motion about a middle: middle + sine sin(360 t / period) + cosine cos(360 t / period), in degrees.
struct Swing {
  double period = 0;           // s, > 0
  Vec3 middle = Vec3::Zero();  // m, displacement from the place at time 0
  Vec3 sine = Vec3::Zero();    // m
  Vec3 cosine = Vec3::Zero();  // m

  friend bool operator==(const Swing&, const Swing&) = default;
};

/// The motion of a fixed thing, as displacements from its place at time 0. By default it never moves.
struct SurfaceMotion {
  vector<MotionLeg> legs;        // in order; of one period, where they repeat
  double every = infinity;       // s, their period
  Vec3 gain = Vec3::Zero();      // m, the displacement in a period
  Vec3 gain_low = Vec3::Zero();  // m, the digits of it that `gain` lacks
  optional<Swing> swing;         // in place of legs
  // Where events (trigger.h) set some ends of windows: those of the legs. They may overlap.
  vector<MotionWindow> windows{};

  /// Makes the legs of the windows as they are now.
  void follow_windows();
  bool moves() const { return swing.has_value() || !legs.empty(); }
};

/// The motion by windows in order that do not overlap, and that repeat after `every` (s). They lie within [0, every].
SurfaceMotion motion_in_windows(span<const MotionWindow> windows, double every = infinity);
/// The same where events set some of their ends. Where windows overlap, their velocities add up.
SurfaceMotion motion_by_events(vector<MotionWindow> windows);
/// amplitude sin(360 t / period + phase), in m, s and degrees, less its value at time 0.
SurfaceMotion motion_on_sine(const Vec3& amplitude, double period, double phase);
/// Round an axis through `center` (m), from a place (m) on. Seen against the axis it turns to the left.
SurfaceMotion motion_on_circle(const Vec3& place, const Vec3& center, const Vec3& axis, double period);

/// The instant (s) from which on a thing has its velocity of `time` (s), and the next such instant after `time`. A
/// swing has none: 0 and infinity.
DoubleDouble leg_start(const SurfaceMotion& motion, const DoubleDouble& time);
DoubleDouble next_leg_start(const SurfaceMotion& motion, const DoubleDouble& time);

/// The place (m) at a time (s) of a thing that is at `from` (m) at time 0. On legs it is rounded once.
Vec3 place_on(const Vec3& from, const SurfaceMotion& motion, const DoubleDouble& time);
Vec3 velocity_on(const SurfaceMotion& motion, const DoubleDouble& time);      // m/s
Vec3 acceleration_on(const SurfaceMotion& motion, const DoubleDouble& time);  // m/s^2, within a leg

/// The displacement from `time` (s) on as a polynomial in t / length (m). It is off by 1e-15 of the amplitude where
/// the length is at most smooth_time().
PolynomialPath::Terms displacement_on(const Swing& swing, const DoubleDouble& time, double length);
double smooth_time(const Swing& swing);  // s
/// The distance (m) of a swing from its middle along a unit direction, at most.
double width_along(const Swing& swing, const Vec3& direction);
/// The rate at which its angle grows (rad/s), and its greatest acceleration (m/s^2) and speed (m/s).
double turning_rate(const Swing& swing);
double greatest_acceleration(const Swing& swing);
double greatest_speed(const Swing& swing);

/// The greatest displacement (m) along a unit direction. Infinity: it goes on.
double swept_along(const SurfaceMotion& motion, const Vec3& direction);

/// Instants (s) within a span of time, ends included, between which a path is straight, or a swing is off a straight
/// line by less than a thousandth of its width.
vector<double> key_times(const SurfaceMotion& motion, double from, double until);
/// The same, but of legs that repeat only those of the first and the last period, which go farthest.
vector<double> farthest_times(const SurfaceMotion& motion, double from, double until);

}  // namespace carom
