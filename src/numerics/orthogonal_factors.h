#pragma once
// J^T = Q1 R for a growing and shrinking set of rows J of unit length, with all of the orthogonal matrix Q = [Q1 Q2]:
// rows are taken in by one Householder reflection each and let go by Givens rotations, both of which keep Q orthogonal
// to rounding however often (Golub & Van Loan, Matrix Computations, 4th ed., section 6.5).
#include <cstddef>
#include <vector>

namespace carom {

class OrthogonalFactors {
 public:
  /// No rows, of `n` columns each: Q = 1.
  void reset(std::size_t n);

  std::size_t columns() const { return n_; }
  std::size_t rank() const { return rank_; }

  /// Q^T j of a row j that is zero but for `count` blocks of three from columns `at` on, with these values.
  void transform(const std::size_t* at, const double* values, std::size_t count, double* d);
  /// Q^T v and Q d of whole vectors.
  void to_q(const double* v, double* d) const;
  void from_q(const double* d, double* v) const;
  /// |Q2^T j|, of d = Q^T j: how far a row is from being spanned by those taken in.
  double tail(const double* d) const;
  /// Q2 times the tail of d.
  void tail_direction(const double* d, double* v) const;
  /// The least of R's diagonal: rows that nearly depend on others make it small.
  double least_diagonal() const;
  /// Solves R r = d and R^T r = d in place.
  void solve(double* d) const;
  void solve_transposed(double* d) const;

  /// Takes in the row of which d = Q^T j; its tail must not be zero. Changes d to what it is with the new Q.
  void append(double* d);
  /// Lets go of the row at `place` among those taken in. Changes d = Q^T j of a row to what it is with the new Q.
  void remove(std::size_t place, double* d);

 private:
  std::size_t n_ = 0, stride_ = 0, rank_ = 0;
  std::vector<double> q_;                 // row by row, stride_ each
  std::vector<double> r_;                 // column by column, stride_ each
  std::vector<double> reflector_, sine_;  // scratch
};

}  // namespace carom
