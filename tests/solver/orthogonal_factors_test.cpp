// Rows added and removed: Q stays orthogonal, and Q R stays equal to the rows.
#include "numerics/orthogonal_factors.h"

#include <gtest/gtest.h>

#include "solver/contact_cases.h"
#include "std.h"

namespace carom {
namespace {

TEST(OrthogonalFactors, StayOrthogonalThroughAThousandChanges) {
  constexpr size_t n = 24;
  contact_cases::Draw draw(5);
  OrthogonalFactors factors;
  factors.reset(n);
  vector<vector<double>> rows;
  vector<double> d(n), v(n), column(n);

  for (int change = 0; change < 1000; ++change) {
    const bool more = rows.empty() || (rows.size() < n - 1 && draw(0, 1) < 0.5);
    if (more) {
      const size_t at[2] = {3 * static_cast<size_t>(draw(0, 4)), 12 + 3 * static_cast<size_t>(draw(0, 4))};
      vector<double> values(6), row(n, 0.0);
      for (size_t k = 0; k < 6; ++k) row[at[k / 3] + k % 3] = values[k] = draw(-1, 1);
      factors.transform(at, values.data(), 2, d.data());
      if (factors.tail(d.data()) < 1e-6) continue;
      factors.append(d.data());
      rows.push_back(row);

    } else {
      const auto place = static_cast<size_t>(draw(0, static_cast<double>(rows.size())));
      factors.remove(place, d.data());
      rows.erase(rows.begin() + static_cast<ptrdiff_t>(place));
    }

    ASSERT_EQ(factors.rank(), rows.size());
  }

  // Q Q^T v = v; and an added row leaves nothing in the tail.
  for (size_t k = 0; k < n; ++k) v[k] = draw(-1, 1);
  factors.to_q(v.data(), d.data());
  factors.from_q(d.data(), column.data());
  for (size_t k = 0; k < n; ++k) EXPECT_NEAR(column[k], v[k], 1e-13);  // measured: 2e-14
  for (const vector<double>& row : rows) {
    factors.to_q(row.data(), d.data());
    EXPECT_LT(factors.tail(d.data()), 1e-13);
  }

  // J (Q1 R^-T d) = d.
  vector<double> rhs(n, 0.0);
  for (size_t k = 0; k < rows.size(); ++k) rhs[k] = d[k] = draw(-1, 1);
  for (size_t k = rows.size(); k < n; ++k) d[k] = 0;
  factors.solve_transposed(d.data());
  factors.from_q(d.data(), v.data());
  for (size_t k = 0; k < rows.size(); ++k) {
    double sum = 0;
    for (size_t i = 0; i < n; ++i) sum += rows[k][i] * v[i];
    EXPECT_NEAR(sum, rhs[k], 1e-11);
  }
}

}  // namespace
}  // namespace carom
