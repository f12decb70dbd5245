// Isolates roots by halving. An interval of 2^-52 with a change of sign counts as a root.
#include "numerics/bernstein.h"

#include "std.h"

namespace carom {
namespace {

constexpr int most_halvings = 52;

void isolate(Bernstein& f, double from, double length, int halvings, vector<double>& roots) {
  if (f.changes() == 0) return;
  if (halvings == most_halvings) {
    roots.push_back(from);
    return;
  }
  Bernstein right = f.split();
  isolate(f, from, 0.5 * length, halvings + 1, roots);
  if (right.b[0] == 0) roots.push_back(from + 0.5 * length);
  isolate(right, from + 0.5 * length, 0.5 * length, halvings + 1, roots);
}

}  // namespace

Bernstein Bernstein::of_powers(const array<double, most_degree + 1>& a, size_t degree) {
  Bernstein to;
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

int Bernstein::changes() const {
  int count = 0;
  double last = 0;
  for (size_t i = 0; i <= degree; ++i) {
    if (b[i] == 0) continue;
    count += last != 0 && (last < 0) != (b[i] < 0);
    last = b[i];
  }
  return count;
}

Bernstein Bernstein::split() {
  Bernstein right;
  right.degree = degree;
  Bernstein work = *this;
  for (size_t level = 0; level <= degree; ++level) {
    b[level] = work.b[0];
    right.b[degree - level] = work.b[degree - level];
    for (size_t i = 0; i + level < degree; ++i) work.b[i] = 0.5 * (work.b[i] + work.b[i + 1]);
  }
  return right;
}

vector<double> roots_in_unit(span<const double> coefficients) {
  vector<double> roots;
  if (coefficients.size() < 2) return roots;
  array<double, Bernstein::most_degree + 1> powers{};
  ranges::copy(coefficients, powers.begin());
  Bernstein f = Bernstein::of_powers(powers, coefficients.size() - 1);
  isolate(f, 0, 1, 0, roots);
  std::erase_if(roots, [](double s) { return !(s > 0 && s < 1); });
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  return roots;
}

}  // namespace carom
