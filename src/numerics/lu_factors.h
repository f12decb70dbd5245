#pragma once
// P M = L U of a small dense matrix, by rows with partial pivoting (Golub & Van Loan, Matrix Computations, 4th ed.
// 2013, 3.4). Sums have one order. A library that fits its blocks to a machine's caches does not give that.

#include "std.h"

namespace carom {

template <size_t size>
class LuFactors {
 public:
  using Row = array<double, size>;

  /// An entry of the matrix. After factor() it is an entry of the factors.
  double& at(size_t row, size_t column) { return row_[row][column]; }

  /// Factors the matrix in place. False: the matrix is singular or not finite.
  bool factor() {
    for (size_t k = 0; k < size; ++k) {
      size_t pivot = k;
      for (size_t i = k + 1; i < size; ++i)
        if (std::abs(row_[i][k]) > std::abs(row_[pivot][k])) pivot = i;
      from_[k] = pivot;
      if (pivot != k) std::swap(row_[k], row_[pivot]);
      inverse_[k] = 1 / row_[k][k];
      if (!isfinite(inverse_[k])) return false;
      for (size_t i = k + 1; i < size; ++i) eliminate(i, k);
    }
    return true;
  }

  /// Replaces b by M^-1 b.
  void solve(Row& b) const {
    for (size_t k = 0; k < size; ++k) {
      std::swap(b[k], b[from_[k]]);
      for (size_t j = 0; j < k; ++j) b[k] -= row_[k][j] * b[j];
    }
    for (size_t k = size; k-- > 0;) {
      for (size_t j = k + 1; j < size; ++j) b[k] -= row_[k][j] * b[j];
      b[k] *= inverse_[k];
    }
  }

 private:
  void eliminate(size_t i, size_t k) {
    if (row_[i][k] == 0) return;
    const double factor = row_[i][k] *= inverse_[k];
    for (size_t j = k + 1; j < size; ++j) row_[i][j] -= factor * row_[k][j];
  }

  array<Row, size> row_;
  Row inverse_;               // of U's diagonal
  array<size_t, size> from_;  // the row that each row was exchanged with
};

}  // namespace carom
