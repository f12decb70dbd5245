// Isolates roots by halving. An interval of 2^-52 with a change of sign counts as a root.
#include "numerics/bernstein.h"

#include "std.h"

namespace carom {
namespace {

constexpr int most_halvings = 52;

template <size_t most>
void isolate(BernsteinUpTo<most>& f, double from, double length, int halvings, vector<double>& roots) {
  if (f.changes() == 0) return;
  if (halvings == most_halvings) {
    roots.push_back(from);
    return;
  }
  BernsteinUpTo<most> right = f.split();
  isolate(f, from, 0.5 * length, halvings + 1, roots);
  if (right.b[0] == 0) roots.push_back(from + 0.5 * length);
  isolate(right, from + 0.5 * length, 0.5 * length, halvings + 1, roots);
}

template <size_t most>
void isolate_all(span<const double> coefficients, vector<double>& roots) {
  array<double, most + 1> powers{};
  ranges::copy(coefficients, powers.begin());
  auto f = BernsteinUpTo<most>::of_powers(powers, coefficients.size() - 1);
  isolate(f, 0, 1, 0, roots);
}

}  // namespace

template <size_t most>
BernsteinUpTo<most> BernsteinUpTo<most>::of_powers(const array<double, most_degree + 1>& a, size_t degree) {
  BernsteinUpTo to;
  to.degree = degree;
  for (size_t i = 0; i <= degree; ++i) {
    // C(i, k) / C(degree, k)
    double share = 1;
    for (size_t k = 0; k <= i; ++k) {
      to.b[i] += share * a[k];
      if (k < i) share *= double(i - k) / double(degree - k);
    }
  }
  return to;
}

template <size_t most>
int BernsteinUpTo<most>::changes() const {
  int count = 0;
  double last = 0;
  for (size_t i = 0; i <= degree; ++i) {
    if (b[i] == 0) continue;
    count += last != 0 && (last < 0) != (b[i] < 0);
    last = b[i];
  }
  return count;
}

template <size_t most>
BernsteinUpTo<most> BernsteinUpTo<most>::split() {
  BernsteinUpTo right;
  right.degree = degree;
  BernsteinUpTo work = *this;
  for (size_t level = 0; level <= degree; ++level) {
    b[level] = work.b[0];
    right.b[degree - level] = work.b[degree - level];
    for (size_t i = 0; i + level < degree; ++i) work.b[i] = 0.5 * (work.b[i] + work.b[i + 1]);
  }
  return right;
}

template struct BernsteinUpTo<Bernstein::most_degree>;
template struct BernsteinUpTo<32>;

vector<double> roots_in_unit(span<const double> coefficients) {
  vector<double> roots;
  if (coefficients.size() < 2) return roots;
  if (coefficients.size() <= Bernstein::most_degree + 1)
    isolate_all<Bernstein::most_degree>(coefficients, roots);
  else
    isolate_all<32>(coefficients, roots);
  std::erase_if(roots, [](double s) { return !(s > 0 && s < 1); });
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  return roots;
}

}  // namespace carom
