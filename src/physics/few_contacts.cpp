#include "physics/few_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace carom {

namespace {

constexpr double rounding = 0x1p-50;   // of the speeds that a relative speed is the difference of
constexpr double dependent = 0x1p-40;  // what is left of a direction that others span but for rounding

/// In the coordinates y = u sqrt(mass) the motion sought is the nearest one, and every pair a unit direction, of which
/// only the parts of its two bodies are not zero. The directions of the pairs that press are kept orthonormal, by Gram
/// and Schmidt's method done twice: so bodies of any masses keep their digits.
class ActiveSet {
 public:
  ActiveSet(std::span<const double> inverse_masses, std::span<Vec3> u, std::span<PressedPair> pairs)
      : u_(u),
        pairs_(pairs),
        root_(inverse_masses.begin(), inverse_masses.end()),
        scale_(pairs.size()),
        basis_((pairs.size() + 1) * u.size()),
        shares_((pairs.size() + 1) * (pairs.size() + 1)) {
    active_.reserve(pairs.size());
    force_.reserve(pairs.size());
    // Masses in a unit of their own, a power of two: masses scaled by one give the same bits.
    int exponent;
    std::frexp(*std::max_element(root_.begin(), root_.end()), &exponent);
    unit_ = std::ldexp(1.0, exponent);
    for (double& w : root_) w /= unit_;
    for (std::size_t c = 0; c < pairs.size(); ++c)
      scale_[c] = 1 / std::sqrt(root_[pairs[c].a] + (fixed(c) ? 0 : root_[pairs[c].b]));
    for (double& w : root_) w = std::sqrt(w);
  }

  bool solve() {
    std::vector<std::uint8_t> hopeless(pairs_.size(), 0);
    std::size_t changes = 32 * pairs_.size();
    for (;;) {
      std::size_t worst = none;
      double least = 0;
      for (std::size_t c = 0; c < pairs_.size(); ++c) {
        if (hopeless[c]) continue;
        const double short_of = lacking(c);
        if (short_of - pairs_[c].slack <= least) continue;
        if (std::find(active_.begin(), active_.end(), c) != active_.end()) continue;
        const double excess = short_of - std::max(pairs_[c].slack, noise(c));
        if (excess > least) {
          least = excess;
          worst = c;
        }
      }
      if (worst == none) break;
      if (!take_in(worst, changes)) hopeless[worst] = 1;
      if (changes == 0) break;
    }
    for (int pass = 0; pass < 2; ++pass) settle();
    for (PressedPair& p : pairs_) p.force = 0;
    for (std::size_t k = 0; k < active_.size(); ++k) pairs_[active_[k]].force = force_[k] * scale_[active_[k]] / unit_;
    return changes > 0;
  }

 private:
  static constexpr std::size_t none = ~std::size_t{0};

  bool fixed(std::size_t c) const { return pairs_[c].b == PressedPair::none; }
  /// How far pair c is short of its target.
  double lacking(std::size_t c) const {
    const PressedPair& p = pairs_[c];
    return p.target - (fixed(c) ? -p.normal.dot(u_[p.a]) : p.normal.dot(u_[p.b] - u_[p.a]));
  }
  double noise(std::size_t c) const {
    return rounding * (u_[pairs_[c].a].norm() + (fixed(c) ? 0 : u_[pairs_[c].b].norm()));
  }
  /// Row k of the basis, and of the shares of the k-th active pair's direction in it. The row after the last is one to
  /// be filled.
  Vec3* direction(std::size_t k) { return &basis_[k * u_.size()]; }
  double* shares(std::size_t k) { return &shares_[k * (pairs_.size() + 1)]; }
  double dot(const Vec3* p, const Vec3* q) const {
    double sum = 0;
    for (std::size_t i = 0; i < u_.size(); ++i) sum += p[i].dot(q[i]);
    return sum;
  }

  /// What is left of pair c's direction beside those of the active pairs, and its shares in theirs: in the row after
  /// the last. Gives its length.
  double beside(std::size_t c) {
    const PressedPair& p = pairs_[c];
    const std::size_t n = u_.size(), count = active_.size();
    Vec3* z = direction(count);
    double* share = shares(count);
    std::fill(z, z + n, Vec3::Zero());
    z[p.a] = -scale_[c] * root_[p.a] * p.normal;
    if (!fixed(c)) z[p.b] = scale_[c] * root_[p.b] * p.normal;
    std::fill(share, share + count, 0.0);
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t k = 0; k < count; ++k) {
        const Vec3* q = direction(k);
        const double h = dot(q, z);
        share[k] += h;
        for (std::size_t i = 0; i < n; ++i) z[i] -= h * q[i];
      }
    return std::sqrt(dot(z, z));
  }

  void move(double step, const Vec3* z) {
    for (std::size_t i = 0; i < u_.size(); ++i) u_[i] += (step * root_[i]) * z[i];
  }

  /// Pair c, whose row is filled, presses from now on.
  void append(std::size_t c, double force, double length) {
    Vec3* z = direction(active_.size());
    for (std::size_t i = 0; i < u_.size(); ++i) z[i] /= length;
    shares(active_.size())[active_.size()] = length;
    active_.push_back(c);
    force_.push_back(force);
  }

  void drop(std::size_t k) {
    const std::vector<std::size_t> left(active_.begin() + static_cast<std::ptrdiff_t>(k) + 1, active_.end());
    const std::vector<double> force(force_.begin() + static_cast<std::ptrdiff_t>(k) + 1, force_.end());
    active_.resize(k);
    force_.resize(k);
    for (std::size_t j = 0; j < left.size(); ++j) append(left[j], force[j], beside(left[j]));
  }

  /// Lets pair c press until it reaches its target. False: it cannot.
  bool take_in(std::size_t c, std::size_t& changes) {
    double force = 0;
    while (changes > 0) {
      --changes;
      const double length = beside(c);
      const Vec3* z = direction(active_.size());
      // How the active pairs' forces change for each unit of this one's.
      change_.assign(shares(active_.size()), shares(active_.size()) + active_.size());
      std::vector<double>& r = change_;
      for (std::size_t k = r.size(); k-- > 0;) {
        for (std::size_t j = k + 1; j < r.size(); ++j) r[k] -= shares(j)[k] * r[j];
        r[k] /= shares(k)[k];
      }
      double most = never;
      std::size_t first = none;
      for (std::size_t k = 0; k < r.size(); ++k)
        if (r[k] > 0 && force_[k] / r[k] < most) {
          most = force_[k] / r[k];
          first = k;
        }
      const bool free = length > dependent;
      const double enough = free ? std::max(lacking(c) * scale_[c], 0.0) / (length * length) : never;
      if (!free && first == none) return false;
      const double step = std::min(most, enough);
      if (free) move(step, z);
      for (std::size_t k = 0; k < r.size(); ++k) force_[k] = std::max(force_[k] - step * r[k], 0.0);
      force += step;
      if (enough <= most) {
        append(c, force, length);
        return true;
      }
      drop(first);
    }
    return false;
  }

  /// Takes what rounding has left off the active pairs' targets.
  void settle() {
    std::vector<double>& step = change_;
    step.resize(active_.size());
    for (std::size_t k = 0; k < active_.size(); ++k) {
      double rest = lacking(active_[k]) * scale_[active_[k]];
      for (std::size_t j = 0; j < k; ++j) rest -= shares(k)[j] * step[j];
      step[k] = rest / shares(k)[k];
    }
    for (std::size_t k = 0; k < active_.size(); ++k) move(step[k], direction(k));
  }

  static constexpr double never = std::numeric_limits<double>::infinity();

  std::span<Vec3> u_;
  std::span<PressedPair> pairs_;
  std::vector<double> root_;   // by body: 1 / sqrt(mass)
  std::vector<double> scale_;  // by pair: makes its direction a unit one
  double unit_;                // 1/kg
  std::vector<std::size_t> active_;
  std::vector<double> force_;   // by active pair
  std::vector<Vec3> basis_;     // the same, by body: one row each
  std::vector<double> shares_;  // its direction in the basis up to itself, one row each
  std::vector<double> change_;  // scratch, by active pair
};

/// Bodies and pairs that have to do with one another, numbered anew.
struct Part {
  std::size_t bodies = 0, pairs = 0;
};

/// Parts side by side: the first's bodies and pairs, the second's, and so on.
struct Parts {
  std::vector<Part> all;
  std::vector<std::uint32_t> bodies;  // by their old numbers
  std::vector<std::size_t> which;     // the same of pairs
  std::vector<PressedPair> pairs;
};

Parts parts_of(std::size_t bodies, std::span<const PressedPair> pairs) {
  Parts parts;
  std::vector<std::uint32_t> root(bodies), place(bodies, PressedPair::none);
  std::iota(root.begin(), root.end(), 0u);
  const auto root_of = [&](std::uint32_t k) {
    while (root[k] != k) k = root[k] = root[root[k]];
    return k;
  };
  for (const PressedPair& p : pairs)
    if (p.b != PressedPair::none) root[root_of(p.a)] = root_of(p.b);
  parts.which.reserve(pairs.size());
  parts.pairs.reserve(pairs.size());
  parts.bodies.reserve(bodies);
  for (std::size_t first = 0; first < pairs.size(); ++first) {
    if (place[pairs[first].a] != PressedPair::none) continue;
    Part part;
    const std::uint32_t whose = root_of(pairs[first].a);
    for (std::size_t c = first; c < pairs.size(); ++c) {
      if (root_of(pairs[c].a) != whose) continue;
      PressedPair pair = pairs[c];
      for (std::uint32_t* i : {&pair.a, &pair.b}) {
        if (*i == PressedPair::none) continue;
        if (place[*i] == PressedPair::none) {
          place[*i] = static_cast<std::uint32_t>(part.bodies++);
          parts.bodies.push_back(*i);
        }
        *i = place[*i];
      }
      parts.which.push_back(c);
      parts.pairs.push_back(pair);
      ++part.pairs;
    }
    parts.all.push_back(part);
  }
  return parts;
}

}  // namespace

bool press_few_apart(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<PressedPair> pairs) {
  bool done = true;
  Parts parts = parts_of(u.size(), pairs);
  std::vector<Vec3> motion;
  std::vector<double> inverse;
  for (const std::uint32_t i : parts.bodies) {
    motion.push_back(u[i]);
    inverse.push_back(inverse_mass[i]);
  }
  std::size_t body = 0, pair = 0;
  for (const Part& part : parts.all) {
    done = ActiveSet(std::span(inverse).subspan(body, part.bodies), std::span(motion).subspan(body, part.bodies),
                     std::span(parts.pairs).subspan(pair, part.pairs))
               .solve() &&
           done;
    body += part.bodies;
    pair += part.pairs;
  }
  for (std::size_t k = 0; k < motion.size(); ++k) u[parts.bodies[k]] = motion[k];
  for (std::size_t k = 0; k < parts.which.size(); ++k) pairs[parts.which[k]].force = parts.pairs[k].force;
  return done;
}

}  // namespace carom
