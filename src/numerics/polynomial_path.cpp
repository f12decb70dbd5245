// Paths through a step as polynomials, by Hermite interpolation of the values at its ends and middle.
// The degree 7 polynomial interpolates the velocity and is integrated. Position and velocity then belong to one motion.
#include "numerics/polynomial_path.h"

#include <initializer_list>

#include "std.h"

namespace carom {

namespace {

PolynomialPath path_of(double length, std::initializer_list<Vec3> first) {
  PolynomialPath path;
  path.length = length;
  path.displacement.fill(Vec3::Zero());
  ranges::copy(first, path.displacement.begin());
  return path;
}

}  // namespace

PolynomialPath PolynomialPath::parabola(double length, const Vec3& v, const Vec3& a) {
  PolynomialPath path = path_of(length, {length * v, (0.5 * length * length) * a});
  path.is_parabola = true;
  return path;
}

PolynomialPath PolynomialPath::through(double length, const Vec3& v, const Vec3& a, const Vec3& bend,
                                       const Vec3& change, const Vec3& end_a) {
  const Vec3 a0 = length * length * a, a1 = length * length * end_a, turn = length * change;
  return path_of(length, {length * v, 0.5 * a0, 10 * bend - 4 * turn - 1.5 * a0 + 0.5 * a1,
                          7 * turn - 15 * bend + 1.5 * a0 - a1, 6 * bend - 3 * turn - 0.5 * a0 + 0.5 * a1});
}

PolynomialPath PolynomialPath::through(double length, const Point& start, const Point& middle, const Point& end) {
  // The change of velocity is the polynomial of degree 5 through both ends plus a correction for the middle.
  // The correction is (s (1 - s))^3 times a line.
  const Vec3 change = end.velocity - start.velocity;
  const Terms of = through(length, start.acceleration, start.jerk, change - length * start.acceleration,
                           end.acceleration - start.acceleration, end.jerk)
                       .displacement;

  const Vec3 place = 64 * ((middle.velocity - start.velocity) - value(of, 0.5));
  const Vec3 line = 64 * (length * middle.acceleration - slope(of, 0.5));
  // The line's value at s = 0.
  const Vec3 level = place - 0.5 * line;

  constexpr double cube[4] = {1, -3, 3, -1};
  Terms velocity = of;
  for (size_t k = 0; k < 4; ++k) {
    velocity[2 + k] += cube[k] * level;
    velocity[3 + k] += cube[k] * line;
  }

  PolynomialPath path = path_of(length, {length * start.velocity});
  for (size_t k = 0; k + 1 < terms; ++k) path.displacement[k + 1] = length / double(k + 2) * velocity[k];
  return path;
}

Vec3 PolynomialPath::value(const Terms& of, double s) {
  Vec3 sum = of[terms - 1];
  for (size_t k = terms - 1; k-- > 0;) sum = sum * s + of[k];
  return sum * s;
}

Vec3 PolynomialPath::slope_change(const Terms& of, double s) {
  Vec3 sum = double(terms) * of[terms - 1];
  for (size_t k = terms - 1; k-- > 1;) sum = sum * s + double(k + 1) * of[k];
  return sum * s;
}

Vec3 PolynomialPath::bend(const Terms& of, double s) {
  Vec3 sum = double(terms * (terms - 1)) * of[terms - 1];
  for (size_t k = terms - 1; k-- > 1;) sum = sum * s + double((k + 1) * k) * of[k];
  return sum;
}

double PolynomialPath::greatest_acceleration() const {
  double sum = 0;
  for (size_t k = 1; k < terms; ++k) sum += double((k + 1) * k) * displacement[k].norm();
  return sum / (length * length);
}

PolynomialPath::Terms PolynomialPath::shifted(const Terms& of, double from, double length) {
  Terms to = of;
  // Repeated Horner's scheme. Each round leaves the next Taylor coefficient about `from`. The first round leaves the
  // position.
  if (from != 0)
    for (size_t round = 0; round < terms; ++round)
      for (size_t k = terms - 1, last = round == 0 ? 0 : round - 1; k-- > last;) to[k] += from * to[k + 1];
  double power = 1;
  for (Vec3& term : to) term *= power *= length;
  return to;
}

}  // namespace carom
