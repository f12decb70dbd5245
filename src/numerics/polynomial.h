#pragma once
// Roots of the polynomials that paths make: of parabolas degree 4 at most, of steps 8. By the derivative cascade: the
// roots of f' part the line into pieces on which f is monotone, each with one root or none, so that no root can be
// missed.
#include <array>
#include <limits>

namespace carom {

/// c[0] + c[1] t + ... + c[degree] t^degree.
struct Polynomial {
  static constexpr int max_degree = 8;
  std::array<double, max_degree + 1> c{};
  int degree = 0;

  double operator()(double t) const;
  Polynomial derivative() const;
};

/// Real roots in ascending order; a root at which the sign does not change may be left out.
struct Roots {
  std::array<double, Polynomial::max_degree> at{};
  int count = 0;
};

/// The roots of f in (low, high), both finite.
Roots roots_between(const Polynomial& f, double low, double high);

inline constexpr double never = std::numeric_limits<double>::infinity();

/// Pieces of [0, horizon] on which f is at most zero and falls, in their order: f comes down through zero at the
/// beginning of one, or was not above zero and begins to fall. A descent that only touches zero is none.
class Descents {
 public:
  Descents(const Polynomial& f, double horizon);
  struct Piece {
    double from, to;  // f rises again, or the horizon is reached, at `to`
  };
  bool next(Piece& piece);

 private:
  Polynomial f_, slope_;
  double horizon_;
  Roots turning_;
  int piece_ = 0;
  double left_ = 0, at_left_ = 0;  // where the next piece begins, and f there
  bool ended_ = true;
};

/// Where the first of these begins; `never` if there is none.
double first_descent(const Polynomial& f, double horizon);

}  // namespace carom
