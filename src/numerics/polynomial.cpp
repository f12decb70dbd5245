// Roots of polynomials by the derivative cascade: the roots of f' are computed first, by recursion. Between two of them
// f is monotone, so that a change of sign brackets its only root. Newton's method with bisection refines it. No root
// can be missed. Degree 2 has the closed form, with its discriminant in double-double arithmetic.
#include "numerics/polynomial.h"

#include "numerics/bracketed_root.h"

#include "numerics/compensated.h"
#include "std.h"

namespace carom {

double Polynomial::operator()(double t) const {
  double value = c[size_t(degree)];
  for (int k = degree - 1; k >= 0; --k) value = value * t + c[size_t(k)];
  return value;
}

Polynomial Polynomial::derivative() const {
  Polynomial d;
  for (int k = 1; k <= degree; ++k) d.c[size_t(k - 1)] = k * c[size_t(k)];
  d.degree = degree > 0 ? degree - 1 : 0;
  return d;
}

namespace {

/// The root of f between l and r, where f is monotone, and f(l) and f(r) differ in sign.
double refine(const Polynomial& f, const Polynomial& df, double l, double r, bool falling) {
  return bracketed_root(f, df, l, r, falling);
}

/// Roots in closed form, with a discriminant free of cancellation. False: products would underflow or overflow.
bool add_quadratic_roots(const Polynomial& f, double low, double high, Roots& roots) {
  const double a = f.c[2], b = f.c[1], c = f.c[0];
  const double size = b * b + std::abs(4 * a * c);
  if (!(size > 0x1p-900 && size < 0x1p900)) return false;
  const double disc = difference_of_products(b, b, 4 * a, c).value();
  if (disc <= 0) return true;
  const double q = -0.5 * (b + std::copysign(sqrt(disc), b));
  const double one = q / a, other = c / q;
  for (const double t : {min(one, other), max(one, other)})
    if (t > low && t < high) roots.at[size_t(roots.count++)] = t;
  return true;
}

int true_degree(const Polynomial& f) {
  int degree = f.degree;
  while (degree > 0 && f.c[size_t(degree)] == 0) --degree;
  return degree;
}

}  // namespace

Roots roots_between(const Polynomial& polynomial, double low, double high) {
  Polynomial f = polynomial;
  f.degree = true_degree(f);
  Roots roots;

  // Degrees up to 2 have closed forms.
  if (f.degree == 0) return roots;
  if (f.degree == 1) {
    const double t = -f.c[0] / f.c[1];
    if (t > low && t < high) roots.at[size_t(roots.count++)] = t;
    return roots;
  }
  if (f.degree == 2 && add_quadratic_roots(f, low, high, roots)) return roots;

  // Between two turning points there is one root at most.
  const Polynomial df = f.derivative();
  const Roots turning = roots_between(df, low, high);
  double l = low;
  double f_l = f(l);

  for (int k = 0; k <= turning.count; ++k) {
    const double r = k < turning.count ? turning.at[size_t(k)] : high;
    const double f_r = f(r);
    if (f_r == 0 && r < high) {
      roots.at[size_t(roots.count++)] = r;
    } else if ((f_l > 0 && f_r < 0) || (f_l < 0 && f_r > 0)) {
      roots.at[size_t(roots.count++)] = refine(f, df, l, r, f_l > 0);
    }
    l = r;
    f_l = f_r;
  }

  return roots;
}

Descents::Descents(const Polynomial& polynomial, double horizon) : f_(polynomial), horizon_(horizon) {
  f_.degree = true_degree(f_);
  if (f_.degree == 0 || !(horizon >= 0)) return;
  slope_ = f_.derivative();
  turning_ = roots_between(slope_, 0, horizon);
  at_left_ = f_(0);
  ended_ = false;
}

bool Descents::next(Piece& piece) {
  while (!ended_) {
    const bool last = piece_ == turning_.count;
    const double l = left_, r = last ? horizon_ : turning_.at[size_t(piece_)];
    const double f_l = at_left_, f_r = f_(r);
    left_ = r;
    at_left_ = f_r;
    ++piece_;
    ended_ = last;

    // This piece rises.
    if (!(f_r < f_l)) continue;
    if (f_l <= 0) {
      piece = {l, r};
    } else if (f_r < 0) {
      piece = {refine(f_, slope_, l, r, true), r};
    } else if (f_r == 0 && last) {
      piece = {r, r};
    } else {
      continue;
    }
    return true;
  }
  return false;
}

double first_descent(const Polynomial& f, double horizon) {
  Descents descents(f, horizon);
  Descents::Piece piece;
  return descents.next(piece) ? piece.from : never;
}

}  // namespace carom
