// Flights that are not plain parabolas: evaluation of drag and of polynomial steps.
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
  return path().displacement_from(t, length);
}

void Flights::set(Entity i, const Flight& flight, const PolynomialPath& curve) {
  Curves& of = curves_.write(i);
  of.present ^= 1u;
  of.of[of.present] = curve;
  set(i, {flight.start, flight.x, flight.v, flight.a, Flight::curved});
}

}  // namespace carom
