#pragma once
// J^T = Q1 R for a growing and shrinking set of rows J of unit length. All of the orthogonal matrix Q = [Q1 Q2] is
// stored. A row is appended by one Householder reflection and removed by Givens rotations. Both keep Q orthogonal to
// rounding, however often they are applied (Golub & Van Loan, Matrix Computations, 4th ed., section 6.5).

#include "std.h"

namespace carom {

class OrthogonalFactors {
 public:
  /// Starts without rows. A row will have `n` columns, and Q = 1.
  void reset(size_t n);

  size_t columns() const { return n_; }
  size_t rank() const { return rank_; }

  /// Q^T j of a row j with `count` blocks of three entries from the columns `at` on. These have the given values, and
  /// all others are zero.
  void transform(const size_t* at, const double* values, size_t count, double* d);
  /// Q^T v and Q d of full vectors.
  void to_q(const double* v, double* d) const;
  void from_q(const double* d, double* v) const;
  /// |Q2^T j|, from d = Q^T j: the distance of a row from the span of the rows in the set.
  double tail(const double* d) const;
  /// Q2 times the tail of d.
  void tail_direction(const double* d, double* v) const;
  /// The least entry on R's diagonal in magnitude, at most 1. It is small where rows nearly depend on each other.
  double least_diagonal() const;
  /// Solves R r = d and R^T r = d in place.
  void solve(double* d) const;
  void solve_transposed(double* d) const;

  /// Appends the row j with d = Q^T j. The tail of d must not be zero. Changes d to Q^T j with the new Q.
  void append(double* d);
  /// Removes the row at `place` in the set. Changes d = Q^T j of any row j to its value with the new Q.
  void remove(size_t place, double* d);

 private:
  size_t n_ = 0, stride_ = 0, rank_ = 0;
  vector<double> q_;                 // row by row, stride_ each
  vector<double> r_;                 // column by column, stride_ each
  vector<double> reflector_, sine_;  // scratch
};

}  // namespace carom
