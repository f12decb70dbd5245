// Updates of a full QR factorisation (Golub & Van Loan, Matrix Computations, 4th ed., section 6.5).
// A row enters by one Householder reflection and leaves by Givens rotations, so that Q stays orthogonal to rounding.
// All of Q is stored, because projections on both of its parts are needed. Sums have a fixed order, so that every
// processor gives the same bits.
#include "numerics/orthogonal_factors.h"

#include "std.h"

namespace carom {

namespace {

// Sums run in four lanes on every processor, so that the bits are the same everywhere.
constexpr size_t width = 4;

double dot(const double* a, const double* b, size_t count) {
  double lane[width] = {};
  size_t k = 0;
  for (; k + width <= count; k += width)
    for (size_t l = 0; l < width; ++l) lane[l] += a[k + l] * b[k + l];
  double sum = (lane[0] + lane[2]) + (lane[1] + lane[3]);
  for (; k < count; ++k) sum += a[k] * b[k];
  return sum;
}

void add(double* a, double t, const double* b, size_t count) {
  for (size_t k = 0; k < count; ++k) a[k] += t * b[k];
}

/// Replaces a by c a + s b, and b by c b - s a.
void rotate(double c, double s, double& a, double& b) {
  const double p = c * a + s * b;
  b = c * b - s * a;
  a = p;
}

}  // namespace

void OrthogonalFactors::reset(size_t n) {
  n_ = stride_ = n;
  rank_ = 0;
  q_.assign(n * n, 0.0);
  for (size_t i = 0; i < n; ++i) q_[i * stride_ + i] = 1;
  if (r_.size() < n * n) r_.resize(n * n);
  reflector_.resize(n);
}

void OrthogonalFactors::transform(const size_t* at, const double* values, size_t count, double* d) {
  std::fill(d, d + n_, 0.0);
  for (size_t block = 0; block < count; ++block)
    for (size_t k = 0; k < 3; ++k) add(d, values[3 * block + k], &q_[(at[block] + k) * stride_], n_);
}

void OrthogonalFactors::to_q(const double* v, double* d) const {
  std::fill(d, d + n_, 0.0);
  for (size_t i = 0; i < n_; ++i) add(d, v[i], &q_[i * stride_], n_);
}

void OrthogonalFactors::from_q(const double* d, double* v) const {
  for (size_t i = 0; i < n_; ++i) v[i] = dot(&q_[i * stride_], d, n_);
}

double OrthogonalFactors::tail(const double* d) const {
  return sqrt(dot(d + rank_, d + rank_, n_ - rank_));
}

void OrthogonalFactors::tail_direction(const double* d, double* v) const {
  for (size_t i = 0; i < n_; ++i) v[i] = dot(&q_[i * stride_ + rank_], d + rank_, n_ - rank_);
}

double OrthogonalFactors::least_diagonal() const {
  double least = 1;
  for (size_t j = 0; j < rank_; ++j) least = min(least, std::abs(r_[j * stride_ + j]));
  return least;
}

void OrthogonalFactors::solve(double* d) const {
  for (size_t j = rank_; j-- > 0;) {
    const double* column = &r_[j * stride_];
    d[j] /= column[j];
    add(d, -d[j], column, j);
  }
}

void OrthogonalFactors::solve_transposed(double* d) const {
  for (size_t j = 0; j < rank_; ++j) {
    const double* column = &r_[j * stride_];
    d[j] = (d[j] - dot(column, d, j)) / column[j];
  }
}

void OrthogonalFactors::append(double* d) {
  const size_t rest = n_ - rank_;
  double* h = reflector_.data();
  std::copy(d + rank_, d + n_, h);

  // If the first component is 0, it gives the reflection no sign, and a mirrored scene would need the opposite one.
  // Exchange it with the largest component: the sign of that turns with the mirror.
  if (h[0] == 0 && rest > 1) {
    size_t k = 1;
    for (size_t j = 2; j < rest; ++j)
      if (std::abs(h[j]) > std::abs(h[k])) k = j;
    std::swap(h[0], h[k]);
    for (size_t i = 0; i < n_; ++i) std::swap(q_[i * stride_ + rank_], q_[i * stride_ + rank_ + k]);
  }

  const double length = sqrt(dot(h, h, rest)), head = h[0] > 0 ? -length : length;
  // The two have opposite signs, so nothing cancels.
  h[0] -= head;

  // 1 - 2 h h^T / |h|^2 maps the tail of d to (head, 0, ...).
  const double square = dot(h, h, rest);
  if (rest > 1 && square > 0) {
    const double factor = -2 / square;
    for (size_t i = 0; i < n_; ++i) {
      double* row = &q_[i * stride_ + rank_];
      add(row, factor * dot(row, h, rest), h, rest);
    }
    std::fill(d + rank_ + 1, d + n_, 0.0);
    d[rank_] = head;
  }

  std::copy(d, d + rank_ + 1, &r_[rank_ * stride_]);
  ++rank_;
}

void OrthogonalFactors::remove(size_t place, double* d) {
  for (size_t j = place + 1; j < rank_; ++j)
    std::copy(&r_[j * stride_], &r_[j * stride_] + j + 1, &r_[(j - 1) * stride_]);
  --rank_;

  // Without the row, each later column has one entry below the diagonal. One rotation for each column removes it.
  vector<double>& cosine = reflector_;
  vector<double>& sine = sine_;
  sine.resize(n_);

  for (size_t j = place; j < rank_; ++j) {
    double* column = &r_[j * stride_];
    const double p = column[j], q = column[j + 1], length = sqrt(p * p + q * q);
    const double c = length == 0 ? 1 : p / length, s = length == 0 ? 0 : q / length;
    cosine[j - place] = c;
    sine[j - place] = s;
    column[j] = length;
    for (size_t k = j + 1; k < rank_; ++k) rotate(c, s, r_[k * stride_ + j], r_[k * stride_ + j + 1]);
    rotate(c, s, d[j], d[j + 1]);
  }

  // The columns of Q take the same rotations.
  for (size_t i = 0; i < n_; ++i) {
    double* row = &q_[i * stride_ + place];
    for (size_t j = 0; j + place < rank_; ++j) rotate(cosine[j], sine[j], row[j], row[j + 1]);
  }
}

}  // namespace carom
