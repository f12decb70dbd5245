#include "physics/polynomial_path.h"

namespace carom {

Vec3 PolynomialPath::value(const Terms& of, double s) {
  Vec3 sum = of[terms - 1];
  for (std::size_t k = terms - 1; k-- > 0;) sum = sum * s + of[k];
  return sum * s;
}

Vec3 PolynomialPath::slope_change(const Terms& of, double s) {
  Vec3 sum = static_cast<double>(terms) * of[terms - 1];
  for (std::size_t k = terms - 1; k-- > 1;) sum = sum * s + static_cast<double>(k + 1) * of[k];
  return sum * s;
}

Vec3 PolynomialPath::bend(const Terms& of, double s) {
  Vec3 sum = static_cast<double>(terms * (terms - 1)) * of[terms - 1];
  for (std::size_t k = terms - 1; k-- > 1;) sum = sum * s + static_cast<double>((k + 1) * k) * of[k];
  return sum;
}

double PolynomialPath::greatest_acceleration() const {
  double sum = 0;
  for (std::size_t k = 1; k < terms; ++k) sum += static_cast<double>((k + 1) * k) * displacement[k].norm();
  return sum / (length * length);
}

PolynomialPath::Terms PolynomialPath::shifted(const Terms& of, double from, double length) {
  Terms to = of;
  // By Horner's scheme, again and again: each round leaves the next term from there on. The first leaves the place.
  if (from != 0)
    for (std::size_t round = 0; round < terms; ++round)
      for (std::size_t k = terms - 1, last = round == 0 ? 0 : round - 1; k-- > last;) to[k] += from * to[k + 1];
  double power = 1;
  for (Vec3& term : to) term *= power *= length;
  return to;
}

}  // namespace carom
