#pragma once
// The motion that contacts allow, in quadruple precision, for given pressing contacts. An independent method finds it:
// Cholesky's factors of J M^-1 J^T. It holds if no contact pulls and none is violated in that precision, since the
// motion is unique.

#include "solver/contact_cases.h"
#include "solver/contact_problem.h"
#include "std.h"

namespace carom::contact_cases {

__extension__ typedef __float128 Quad;

inline Quad square_root(Quad x) {
  Quad root = sqrt(static_cast<double>(x));
  for (int k = 0; k < 3; ++k) root = root > 0 ? (root + x / root) / 2 : root;
  return root;
}

struct Reference {
  vector<Quad> motion;  // 3 a body
  bool holds = false;

  /// The greatest difference of a motion. It is relative to the body's speed before or after, or to a thousandth of the
  /// greatest speed.
  double error(const vector<Vec3>& free, const vector<Vec3>& u) const {
    double speed = 0, most = 0;
    for (const Vec3& v : free) speed = std::max(speed, v.norm());
    for (size_t i = 0; i < u.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const double off = std::abs(static_cast<double>(motion[3 * i + static_cast<size_t>(k)] - Quad(u[i][k])));
        if (off > 0) most = std::max(most, off / std::max({u[i].norm(), free[i].norm(), 1e-3 * speed}));
      }
    return most;
  }
};

/// What a unit impulse along one row changes of the rate of another.
inline Quad product(const vector<double>& inverse_mass, const ContactConstraint& p, const ContactConstraint& q) {
  Quad shared = 0, along = 0;
  if (p.a == q.a) shared += inverse_mass[p.a];
  if (p.b == q.b && p.b != fixed) shared += inverse_mass[p.b];
  if (p.b == q.a) shared -= inverse_mass[q.a];
  if (p.a == q.b) shared -= inverse_mass[p.a];
  for (int k = 0; k < 3; ++k) along += Quad(p.normal[k]) * q.normal[k];
  return shared * along;
}

/// By how much the gap of a row opens faster than it should.
inline Quad rate(const vector<Quad>& u, const ContactConstraint& c) {
  Quad sum = -Quad(c.target);
  for (size_t k = 0; k < 3; ++k)
    sum += Quad(c.normal[static_cast<int>(k)]) * ((c.b == fixed ? Quad(0) : u[3 * c.b + k]) - u[3 * c.a + k]);
  return sum;
}

/// `contacts`: with the forces of a solution; those above 0 press.
inline Reference reference(const vector<double>& inverse_mass, const vector<Vec3>& free,
                           const vector<ContactConstraint>& contacts) {
  vector<const ContactConstraint*> rows;
  for (const ContactConstraint& c : contacts)
    if (c.force > 0) rows.push_back(&c);
  const size_t m = rows.size();

  Reference result;
  for (const Vec3& u : free)
    for (int k = 0; k < 3; ++k) result.motion.push_back(u[k]);
  vector<Quad> factor(m * m, 0), scale(m), force(m, 0);
  vector<char> spanned(m, 0);  // by rows before it

  // Cholesky's factors of the scaled equations, without the rows that those before them span.
  for (size_t i = 0; i < m; ++i) scale[i] = 1 / square_root(product(inverse_mass, *rows[i], *rows[i]));
  for (size_t i = 0; i < m; ++i)
    for (size_t j = 0; j <= i; ++j) {
      if (spanned[j]) continue;
      Quad sum = scale[i] * scale[j] * product(inverse_mass, *rows[i], *rows[j]);
      for (size_t k = 0; k < j; ++k) sum -= factor[i * m + k] * factor[j * m + k];
      spanned[j] = j == i && sum < 1e-28;
      if (!spanned[j]) factor[i * m + j] = j < i ? sum / factor[j * m + j] : square_root(sum);
    }

  // Once for the value, twice for what ill-conditioned factors leave.
  for (int pass = 0; pass < 3; ++pass) {
    vector<Quad> x(m, 0);
    for (size_t i = 0; i < m; ++i) {
      if (spanned[i]) continue;
      x[i] = -rate(result.motion, *rows[i]) * scale[i];
      for (size_t k = 0; k < i; ++k) x[i] -= factor[i * m + k] * x[k];
      x[i] /= factor[i * m + i];
    }

    for (size_t i = m; i-- > 0;) {
      if (spanned[i]) continue;
      for (size_t k = i + 1; k < m; ++k) x[i] -= factor[k * m + i] * x[k];
      x[i] /= factor[i * m + i];
      force[i] += x[i];

      const ContactConstraint& c = *rows[i];
      for (size_t k = 0; k < 3; ++k) {
        const Quad push = x[i] * scale[i] * Quad(c.normal[static_cast<int>(k)]);
        result.motion[3 * c.a + k] -= inverse_mass[c.a] * push;
        if (c.b != fixed) result.motion[3 * c.b + k] += inverse_mass[c.b] * push;
      }
    }
  }

  Quad least = 0, most = 0, violated = 0, speed = 0;
  for (const Quad x : force) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
  for (const Vec3& u : free) speed = std::max(speed, Quad(u.norm()));

  for (const ContactConstraint& c : contacts) {
    speed = std::max(speed, Quad(std::abs(c.target)));
    violated = std::max(violated, -rate(result.motion, c));
  }

  result.holds = least >= -1e-13 * most && violated <= 1e-14 * speed;
  return result;
}

}  // namespace carom::contact_cases
