#pragma once
// Flights that forces bend: in steps, each body's own, in which polynomials tell the path. Where there is a closed form
// (closed_motion.h) each step's polynomial is made of it anew, so that no error adds up. Else a method of order 8 takes
// steps as long as their error allows (dormand_prince.h), or an implicit one where forces are stiff (implicit_step.h).
// Or it is the method and the length that are asked for (integrator.h).
#include <vector>

#include "physics/closed_motion.h"
#include "physics/force_jacobian.h"
#include "simulate/exact_bodies.h"

namespace carom {

class CurvedFlights {
 public:
  explicit CurvedFlights(ExactBodies& bodies)
      : bodies_(bodies), next_(bodies.body.size()), method_(bodies.body.size()) {}

  /// The next step of body i, from x (m) and v (m/s) on, now. Throws SimulationError where forces change faster than
  /// the clock can tell.
  PolynomialPath step_of_its_own(Entity i, const Vec3& x, const Vec3& v);
  /// By the method that is asked for; but for dop853's it ends at the next multiple of options.step. `next`: it begins
  /// where the last one ends, or at the run's start; then Euler's method changes v. Throws SimulationError where the
  /// clock can tell no such steps.
  PolynomialPath step(Entity i, const Vec3& x, Vec3& v, bool next);

  /// Books what forces without a potential do to body i in `length` (s) of its flight, and gives all of it (J).
  double book_work(Entity i, const Flight& flight, double length);

  /// Where a motion in closed form has led.
  struct Reached {
    Vec3 x, v;  // m, m/s
  };
  /// Where body i is, if a step of its motion in closed form ends now; null: none does.
  const Reached* reached(Entity i) const {
    return closed_.empty() || closed_[i].next != bodies_.now ? nullptr : &closed_[i].end;
  }
  /// Whether body i's present flight is a step of a motion in closed form, which may have ended.
  bool follows_closed_form(Entity i) const {
    if (closed_.empty()) [[likely]]
      return false;
    const PolynomialPath* const curve = bodies_.flights.curve(i);
    return curve != nullptr && bodies_.flights[i].start + curve->length == closed_[i].next;
  }
  /// Where such a motion has led by then.
  Reached closed_place(Entity i, const Instant& at) const;

 private:
  /// A body's motion in closed form.
  struct Closed {
    ClosedForces forces;
    ClosedMotion motion;
    Instant start, next{-1, 0};  // of the motion; when its last step ends
    Reached end;                 // then
  };
  PolynomialPath closed_step(Entity i, const ClosedForces& forces, const Vec3& x, const Vec3& v);
  PolynomialPath numerical_step(Entity i, const Vec3& x, const Vec3& v);
  double longest_step(double reach, const Vec3& v, const Vec3& a) const;
  bool is_implicit(Entity i, double length, double damping) const;
  void note_method(Entity i, bool implicit);
  void check_clock(Entity i, double length) const;
  double step_length() const;
  double first_length(Entity i, const Vec3& x, const Vec3& v) const;

  ExactBodies& bodies_;
  LazyArray<double> next_;          // s, by body: a good length of the next step; 0: not known
  LazyArray<std::uint8_t> method_;  // by body: steps of dop853 since the last of the implicit method, up to many
  std::vector<Closed> closed_;      // by body; empty: no motion has a closed form
};

}  // namespace carom
