#pragma once
// A body's path since its last change: x + v t + a t^2/2 from its start on, or the same under linear drag.
// Under other varying forces it is a step of a method, as a polynomial.

#include "numerics/large_pages.h"
#include "numerics/lazy_array.h"
#include "numerics/polynomial_path.h"
#include "numerics/vec3.h"
#include "physics/entity.h"
#include "physics/fading_path.h"
#include "simulate/path/instant.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

struct Flight {
  Instant start;
  Vec3 x;                                 // m, at start
  Vec3 v;                                 // m/s, at start
  Vec3 a;                                 // m/s^2, at start
  double fade = 0;                        // 1/s: a decays as exp(-fade t); `curved`: it does not
  const PolynomialPath* curve = nullptr;  // the path in that case, until the step's end

  // NaN: it equals no other value, not even itself.
  static constexpr double curved = numeric_limits<double>::quiet_NaN();

  // Straight except for a constant acceleration.
  bool is_straight() const { return fade == 0; }
  bool is_parabola() const { return is_straight() || (curve != nullptr && curve->is_parabola); }
  FadingPath path() const { return {x, v, a, fade}; }
  // t: s since start.
  [[gnu::always_inline]] Vec3 position(double t) const {
    if (!is_straight()) return bent_position(t);
    const double half = 0.5 * t;
    return {x.x() + t * (v.x() + half * a.x()), x.y() + t * (v.y() + half * a.y()), x.z() + t * (v.z() + half * a.z())};
  }
  /// The displacement since start (m).
  Vec3 displacement(double t) const {
    return curve != nullptr ? curve->displacement_at(t) : Vec3(t * (v + displaced(fade, t) * a));
  }
  [[gnu::always_inline]] Vec3 velocity(double t) const {
    return is_straight() ? Vec3(v.x() + t * a.x(), v.y() + t * a.y(), v.z() + t * a.z()) : bent_velocity(t);
  }
  Vec3 acceleration(double t) const {
    return is_straight() ? a : curve == nullptr ? path().acceleration(t) : curve->acceleration(t);
  }
  /// An upper bound of the acceleration from start on (m/s^2).
  double greatest_acceleration() const { return curve == nullptr ? a.norm() : curve->greatest_acceleration(); }
  /// The displacement from t on, for `length` (s), as a polynomial (m). Under drag the length is at most span_of_fade()
  /// (s).
  PolynomialPath::Terms displacement_from(double t, double length) const;

  /// The time (s) from t on for which displacement_from() is accurate. After the acceleration has decayed, a path is
  /// straight.
  double span_of_fade(double t) const { return curve != nullptr || is_straight() ? infinity : path().span(t); }

 private:
  Vec3 bent_position(double t) const;
  Vec3 bent_velocity(double t) const;
};

/// The velocity that a body has by its method, less that of its flight, by powers of the time since the flight's start.
struct VelocityBeyond {
  array<Vec3, 3> terms{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  // m/s, m/s^2, m/s^3

  bool is_zero() const { return terms[0].isZero(0) && terms[1].isZero(0) && terms[2].isZero(0); }
  // t: s since the flight's start.
  Vec3 at(double t) const { return terms[0] + t * (terms[1] + t * terms[2]); }
  Vec3 slope(double t) const { return terms[1] + 2 * t * terms[2]; }
};

/// What separates the drift of a crowd from the velocity of an instant: the effect of forces until the step's middle.
struct Kick {
  Instant until;
  Vec3 a = Vec3::Zero();  // m/s^2: the average of these forces

  /// Its part from `at` on (m/s).
  Vec3 rest(const Instant& at) const { return (until - at) * a; }

  void keep(auto& archive) { archive(until, a); }
};

/// The flights of all bodies. The data of pair tests take one cache line for each body.
/// Accelerations are stored only after bodies differ in them.
class Flights {
 public:
  struct alignas(64) Core {
    Vec3 x, v;
    Instant start;

    void keep(auto& archive) { archive(x, v, start); }
  };
  static_assert(sizeof(Core) == 8 * sizeof(double));

  /// `common`: the acceleration of all bodies (m/s^2) until `set` or `accelerate` changes it.
  Flights(Entity bodies, const Vec3& common) : core_(bodies), common_(common), fade_(bodies), curves_(bodies) {}

  [[gnu::always_inline]] Flight operator[](Entity i) const {
    return {core_[i].start, core_[i].x, core_[i].v, acceleration(i), fade(i), curve(i)};
  }
  double fade(Entity i) const { return fade_[i]; }  // 1/s
  const PolynomialPath* curve(Entity i) const { return fade_.empty() ? nullptr : curve_of(i); }
  const Vec3& acceleration(Entity i) const { return acceleration_.empty() ? common_ : acceleration_[i]; }  // at start
  const Core* cores() const { return core_.data(); }
  /// Whether all bodies have the same acceleration.
  bool alike() const { return acceleration_.empty(); }
  /// Whether a force has ever bent a path.
  bool any_fades() const { return !fade_.empty(); }

  [[gnu::always_inline]] void set(Entity i, const Flight& flight) {
    core_[i] = {flight.x, flight.v, flight.start};
    accelerate(i, flight.a, flight.fade);
  }
  /// Sets another acceleration from the flight's start on.
  [[gnu::always_inline]] void accelerate(Entity i, const Vec3& a, double new_fade = 0) {
    if (new_fade != 0 || any_fades()) [[unlikely]]
      set_fade(i, new_fade);
    if (acceleration_.empty()) {
      if (a == common_) return;
      acceleration_.assign(core_.size(), common_);
    }
    acceleration_[i] = a;
  }
  /// Sets a flight through a step with the path `curve`. Copies of the flight before stay valid until the next call.
  void set(Entity i, const Flight& flight, const PolynomialPath& curve);

  void keep(auto& archive) {
    archive.sized(core_);
    archive(acceleration_, fade_, curves_);
    archive.check(acceleration_.empty() || acceleration_.size() == core_.size());
  }

 private:
  /// The curves of a body: the present one, and the one before.
  struct Curves {
    PolynomialPath of[2];
    uint8_t present = 0;

    void keep(auto& archive) {
      archive(present);
      archive.check(present < 2);
      archive(of[present]);
    }
  };

  const PolynomialPath* curve_of(Entity i) const {
    const double fade = fade_[i];
    return fade == fade ? nullptr : &curves_[i].of[curves_[i].present];
  }
  [[gnu::noinline]] void set_fade(Entity i, double fade) { fade_.write(i) = fade; }

  LargeVector<Core> core_;
  Vec3 common_;
  LargeVector<Vec3> acceleration_;  // empty: all have the common one
  LazyArray<double> fade_;          // 1/s
  SparseArray<Curves> curves_;
};

}  // namespace carom
