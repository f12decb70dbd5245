#pragma once
// Flights under forces that bend them in no closed form: steps of a method of order 8 (dormand_prince.h), each body's
// own, as long as their error allows; or of the method and the length that are asked for (integrator.h).
#include "simulate/exact_bodies.h"

namespace carom {

class CurvedFlights {
 public:
  explicit CurvedFlights(const ExactBodies& bodies) : bodies_(bodies), next_(bodies.body.size()) {}

  /// The next step of body i, from x (m) and v (m/s) on, now, by dop853. Throws SimulationError where forces change
  /// faster than the clock can tell.
  PolynomialPath step_of_its_own(Entity i, const Vec3& x, const Vec3& v);
  /// By the method that is asked for; but for dop853's it ends at the next multiple of options.step. `next`: it begins
  /// where the last one ends, or at the run's start; then Euler's method changes v. Throws SimulationError where the
  /// clock can tell no such steps.
  PolynomialPath step(Entity i, const Vec3& x, Vec3& v, bool next);

  /// m^2/s^2: what forces without a potential do to a unit of body i's mass in `length` (s) of its flight from x (m)
  /// and v (m/s) on.
  double work(Entity i, const Flight& flight, double length) const;

 private:
  double step_length() const;
  double first_length(Entity i, const Vec3& x, const Vec3& v) const;

  const ExactBodies& bodies_;
  LazyArray<double> next_;  // s, by body: a good length of the next step; 0: not known
};

}  // namespace carom
