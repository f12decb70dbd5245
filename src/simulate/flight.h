#pragma once
// A body's path since its last change: x + v t + a t^2/2 from its start on, or what linear drag makes of that; under
// other forces that vary a step of a method, as a polynomial.
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "numerics/polynomial_path.h"
#include "numerics/vec3.h"
#include "physics/entity.h"
#include "physics/fading_path.h"
#include "simulate/instant.h"
#include "simulate/large_pages.h"
#include "simulate/lazy_array.h"
#include "simulate/tolerances.h"

namespace carom {

struct Flight {
  Instant start;
  Vec3 x;                                 // m, at start
  Vec3 v;                                 // m/s, at start
  Vec3 a;                                 // m/s^2, at start
  double fade = 0;                        // 1/s: a dies away as exp(-fade t); `curved`: it is not so
  const PolynomialPath* curve = nullptr;  // then this is its way, until the step's end

  static constexpr double curved = std::numeric_limits<double>::quiet_NaN();  // no two fade alike

  bool is_straight() const { return fade == 0; }  // but for a constant acceleration
  bool is_parabola() const { return is_straight() || (curve != nullptr && curve->is_parabola); }
  FadingPath path() const { return {x, v, a, fade}; }
  Vec3 position(double t) const {  // t: s since start
    return is_straight() ? Vec3(x + t * (v + (0.5 * t) * a)) : bent_position(t);
  }
  /// m, since start.
  Vec3 displacement(double t) const {
    return curve != nullptr ? curve->displacement_at(t) : Vec3(t * (v + displaced(fade, t) * a));
  }
  Vec3 velocity(double t) const { return is_straight() ? Vec3(v + t * a) : bent_velocity(t); }
  Vec3 acceleration(double t) const {
    return is_straight() ? a : curve == nullptr ? path().acceleration(t) : curve->acceleration(t);
  }
  /// m/s^2, from start on; at least that.
  double greatest_acceleration() const { return curve == nullptr ? a.norm() : curve->greatest_acceleration(); }
  /// m, since start: from t on, for `length` (s), of a path that fades at most span_of_fade() (s).
  PolynomialPath::Terms displacement_from(double t, double length) const;

  /// s, from t on, for which displacement_from() is right: once it has died away, a path is straight.
  double span_of_fade(double t) const {
    using namespace exact_tolerance;
    const bool straight = is_straight() || fade * t >= faded;
    return curve != nullptr || straight ? std::numeric_limits<double>::infinity() : told_fade / fade;
  }

 private:
  Vec3 bent_position(double t) const;
  Vec3 bent_velocity(double t) const;
};

/// m/s: a velocity v that has been kicked by what forces do until `until`, `kick` (m/s^2) on average, without what they
/// do from `at` on.
inline Vec3 without_kick(const Vec3& v, const Instant& at, const Instant& until, const Vec3& kick) {
  return v - (until - at) * kick;
}

/// The flights of all bodies. What pairs are tested by is a cache line a body; accelerations are kept only once bodies
/// differ in them.
class Flights {
 public:
  struct alignas(64) Core {
    Vec3 x, v;
    Instant start;
  };
  static_assert(sizeof(Core) == 8 * sizeof(double));

  /// `common`: m/s^2, the acceleration of all until `set` or `accelerate` gives another.
  Flights(Entity bodies, const Vec3& common) : core_(bodies), common_(common), fade_(bodies) {}

  Flight operator[](Entity i) const {
    return {core_[i].start, core_[i].x, core_[i].v, acceleration(i), fade(i), curve(i)};
  }
  double fade(Entity i) const { return fade_[i]; }  // 1/s
  const PolynomialPath* curve(Entity i) const { return curves_.empty() ? nullptr : curve_of(i); }
  const Vec3& acceleration(Entity i) const { return acceleration_.empty() ? common_ : acceleration_[i]; }  // at start
  const Core* cores() const { return core_.data(); }
  /// Whether all have the same acceleration.
  bool alike() const { return acceleration_.empty(); }
  /// Whether a force has bent the path of any.
  bool any_fades() const { return !fade_.empty(); }

  [[gnu::always_inline]] void set(Entity i, const Flight& flight) {
    core_[i] = {flight.x, flight.v, flight.start};
    accelerate(i, flight.a, flight.fade);
  }
  /// Another acceleration, from its start on.
  void accelerate(Entity i, const Vec3& a, double new_fade = 0) {
    if (new_fade != 0 || any_fades()) [[unlikely]]
      set_fade(i, new_fade);
    if (acceleration_.empty()) {
      if (a == common_) return;
      acceleration_.assign(core_.size(), common_);
    }
    acceleration_[i] = a;
  }
  /// A flight through a step, whose way is `curve`. Copies of the flight before stay good until the next.
  void set(Entity i, const Flight& flight, const PolynomialPath& curve);

 private:
  /// Of a body: the present one, and the one before.
  struct Curves {
    PolynomialPath of[2];
    std::uint8_t present = 0;
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
  std::vector<Curves> curves_;      // empty: no path is curved
};

}  // namespace carom
