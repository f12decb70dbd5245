#pragma once
// Roots of the polynomials of paths: parabolas give a degree of 4 at most, steps of a method 8.
// The method is the derivative cascade. The roots of f' divide the line into pieces on which f is monotone.
// Each piece has one root or none, so that no root can be missed.

#include "std.h"

namespace carom {

/// c[0] + c[1] t + ... + c[degree] t^degree.
struct Polynomial {
  static constexpr int max_degree = 8;
  array<double, max_degree + 1> c{};
  int degree = 0;

  double operator()(double t) const;
  Polynomial derivative() const;
};

/// Real roots in ascending order. A root at which the sign does not change may be missing.
struct Roots {
  array<double, Polynomial::max_degree> at{};
  int count = 0;
};

/// The roots of f in (low, high), both finite.
Roots roots_between(const Polynomial& f, double low, double high);

inline constexpr double never = infinity;

/// The pieces of [0, horizon] on which f is at most zero and falls, in order.
/// At the start of a piece f crosses zero downwards. Or f was at most zero before, and begins to fall there.
/// A descent that only touches zero does not count.
class Descents {
 public:
  Descents(const Polynomial& f, double horizon);
  struct Piece {
    // At `to` f rises again, or the horizon is reached.
    double from, to;
  };
  bool next(Piece& piece);

 private:
  Polynomial f_, slope_;
  double horizon_;
  Roots turning_;
  int piece_ = 0;
  // Where the next piece begins, and f there.
  double left_ = 0, at_left_ = 0;
  bool ended_ = true;
};

/// The start of the first such piece; `never` if there is none.
double first_descent(const Polynomial& f, double horizon);

}  // namespace carom
