#pragma once
// Flights under forces that bend paths, in steps of each body's own. Polynomials give the path within a step. Where
// there is a closed form (closed_motion.h), each step's polynomial is made from it anew, so that no error adds up.
// Otherwise a method of order 8 takes steps by its error estimate (dormand_prince.h), or an implicit one where forces
// are stiff (implicit_step.h). A scene may also choose the method and the step (integrator.h).

#include "physics/closed_motion.h"
#include "physics/force_jacobian.h"
#include "simulate/path/paths.h"
#include "std.h"

namespace carom {

class CurvedFlights {
 public:
  explicit CurvedFlights(BodyPaths& bodies) : bodies_(bodies), next_(bodies.body.size()), method_(bodies.body.size()) {}

  /// The next step of body i, from x (m) and v (m/s) at the present instant.
  /// Throws SimulationError where forces change faster than the clock resolves.
  PolynomialPath step_of_its_own(Entity i, const Vec3& x, const Vec3& v);
  /// The next step by the scene's integrator. Except with dop853 it ends at the next multiple of options.step.
  /// `next`: it begins where the last step ends, or at the run's start. Euler's method then changes v.
  /// Throws SimulationError where the clock does not resolve such steps.
  PolynomialPath step(Entity i, const Vec3& x, Vec3& v, bool next);

  /// Books the work (J) of forces without a potential on body i in `length` (s) of its flight. Returns their sum.
  double book_work(Entity i, const Flight& flight, double length);
  /// The integral of the squared speed over `length` (s) of a flight on a curve (m^2/s).
  static double squared_speed(const Flight& flight, double length);

  /// The end of a step of a motion in closed form.
  struct Reached {
    Vec3 x, v;  // m, m/s

    void keep(auto& archive) { archive(x, v); }
  };
  /// The state of body i, if a step of its motion in closed form ends at this instant; null: there is none.
  const Reached* reached(Entity i) const {
    return closed_.empty() || closed_[i].next != bodies_.now ? nullptr : &closed_[i].end;
  }
  /// Whether the present flight of body i, in no island, is a step of a motion in closed form, which may have ended.
  bool follows_closed_form(Entity i) const {
    if (closed_.empty()) [[likely]]
      return false;
    const PolynomialPath* const curve = bodies_.flights.curve(i);
    return curve != nullptr && bodies_.flights[i].start + curve->length == closed_[i].next &&
           !is_member(bodies_.mode(i));
  }
  /// Whether such a motion begins with the present flight.
  bool begins_closed_form(Entity i) const {
    return follows_closed_form(i) && closed_[i].start == bodies_.flights[i].start;
  }
  /// The state of such a motion at an instant.
  Reached closed_place(Entity i, const Instant& at) const;

  void keep(auto& archive) { archive(next_, method_, closed_); }

 private:
  /// A body's motion in closed form.
  struct Closed {
    ClosedForces forces;
    ClosedMotion motion;
    // Start of the motion, and end of its last step.
    Instant start, next{-1, 0};
    Reached end;  // at the end of that step

    void keep(auto& archive) { archive(forces, motion, start, next, end); }
  };
  PolynomialPath closed_step(Entity i, const ClosedForces& forces, const Vec3& x, const Vec3& v);
  PolynomialPath numerical_step(Entity i, const Vec3& x, const Vec3& v);
  double longest_step(double reach, const Vec3& v, const Vec3& a) const;
  bool is_implicit(Entity i, double length, double damping) const;
  void note_method(Entity i, bool implicit);
  void check_clock(Entity i, double length) const;
  double step_length() const;
  double first_length(Entity i, const Vec3& x, const Vec3& v) const;

  BodyPaths& bodies_;
  LazyArray<double> next_;  // s, by body: a good length for the next step; 0: unknown
  // By body: number of steps of dop853 since the last implicit step, counted up to many.
  LazyArray<uint8_t> method_;
  vector<Closed> closed_;  // by body; empty: no motion has a closed form
};

}  // namespace carom
