// Flights that are not plain parabolas: evaluation of drag and of polynomial steps.
// The polynomial of a path under drag is its Taylor series. Its terms fall fast within span_of_fade().
#include "simulate/path/flight.h"

#include "std.h"

namespace carom {

Vec3 Flight::bent_position(double t) const {
  return curve == nullptr ? path().position(t) : Vec3(x + curve->displacement_at(t));
}

Vec3 Flight::bent_velocity(double t) const {
  return curve == nullptr ? path().velocity(t) : Vec3(v + curve->change_at(t));
}

PolynomialPath::Terms Flight::displacement_from(double t, double length) const {
  if (curve != nullptr) return PolynomialPath::shifted(curve->displacement, t / curve->length, length / curve->length);
  PolynomialPath::Terms terms;
  terms.fill(Vec3::Zero());
  terms[0] = length * velocity(t);
  terms[1] = (0.5 * length * length) * acceleration(t);
  // In the second case the acceleration has decayed.
  if (is_straight() || !(fade * length < 1)) return terms;
  for (size_t k = 2; k < terms.size(); ++k) terms[k] = (-fade * length / double(k + 1)) * terms[k - 1];
  return terms;
}

void Flights::set(Entity i, const Flight& flight, const PolynomialPath& curve) {
  Curves& of = curves_.write(i);
  of.present ^= 1u;
  of.of[of.present] = curve;
  set(i, {flight.start, flight.x, flight.v, flight.a, Flight::curved});
}

}  // namespace carom
