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
      : u_(u), pairs_(pairs), root_(inverse_masses.begin(), inverse_masses.end()), scale_(pairs.size()) {
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
        if (hopeless[c] || std::find(active_.begin(), active_.end(), c) != active_.end()) continue;
        const double excess = lacking(c) - std::max(pairs_[c].slack, noise(c));
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
    for (std::size_t k = 0; k < active_.size(); ++k)
      pairs_[active_[k]].force = force_[k] * scale_[active_[k]] / unit_;
    return changes > 0;
  }

 private:
  static constexpr std::size_t none = ~std::size_t{0};
  using Direction = std::vector<Vec3>;

  bool fixed(std::size_t c) const { return pairs_[c].b == PressedPair::none; }
  /// How far pair c is short of its target.
  double lacking(std::size_t c) const {
    const PressedPair& p = pairs_[c];
    return p.target - (fixed(c) ? -p.normal.dot(u_[p.a]) : p.normal.dot(u_[p.b] - u_[p.a]));
  }
  double noise(std::size_t c) const {
    return rounding * (u_[pairs_[c].a].norm() + (fixed(c) ? 0 : u_[pairs_[c].b].norm()));
  }
  static double dot(const Direction& p, const Direction& q) {
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += p[i].dot(q[i]);
    return sum;
  }

  /// What is left of pair c's direction beside those of the active pairs, and its shares in theirs.
  Direction beside(std::size_t c, std::vector<double>& shares) const {
    const PressedPair& p = pairs_[c];
    Direction z(u_.size(), Vec3::Zero());
    z[p.a] = -scale_[c] * root_[p.a] * p.normal;
    if (!fixed(c)) z[p.b] = scale_[c] * root_[p.b] * p.normal;
    shares.assign(basis_.size(), 0.0);
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t k = 0; k < basis_.size(); ++k) {
        const double h = dot(basis_[k], z);
        shares[k] += h;
        for (std::size_t i = 0; i < z.size(); ++i) z[i] -= h * basis_[k][i];
      }
    return z;
  }

  void move(double step, const Direction& z) {
    for (std::size_t i = 0; i < z.size(); ++i) u_[i] += (step * root_[i]) * z[i];
  }

  void append(std::size_t c, double force, Direction z, std::vector<double> shares, double length) {
    for (Vec3& v : z) v /= length;
    shares.push_back(length);
    active_.push_back(c);
    force_.push_back(force);
    basis_.push_back(std::move(z));
    shares_.push_back(std::move(shares));
  }

  void drop(std::size_t k) {
    std::vector<std::size_t> left = active_;
    std::vector<double> force = force_;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
    force.erase(force.begin() + static_cast<std::ptrdiff_t>(k));
    active_.resize(k);
    force_.resize(k);
    basis_.resize(k);
    shares_.resize(k);
    for (std::size_t j = k; j < left.size(); ++j) {
      std::vector<double> shares;
      Direction z = beside(left[j], shares);
      const double length = std::sqrt(dot(z, z));
      append(left[j], force[j], std::move(z), std::move(shares), length);
    }
  }

  /// Lets pair c press until it reaches its target. False: it cannot.
  bool take_in(std::size_t c, std::size_t& changes) {
    double force = 0;
    while (changes > 0) {
      --changes;
      std::vector<double> shares;
      Direction z = beside(c, shares);
      // How the active pairs' forces change for each unit of this one's.
      std::vector<double> r = shares;
      for (std::size_t k = r.size(); k-- > 0;) {
        for (std::size_t j = k + 1; j < r.size(); ++j) r[k] -= shares_[j][k] * r[j];
        r[k] /= shares_[k][k];
      }
      double most = never;
      std::size_t first = none;
      for (std::size_t k = 0; k < r.size(); ++k)
        if (r[k] > 0 && force_[k] / r[k] < most) {
          most = force_[k] / r[k];
          first = k;
        }
      const double length = std::sqrt(dot(z, z));
      const bool free = length > dependent;
      const double enough = free ? std::max(lacking(c) * scale_[c], 0.0) / (length * length) : never;
      if (!free && first == none) return false;
      const double step = std::min(most, enough);
      if (free) move(step, z);
      for (std::size_t k = 0; k < r.size(); ++k) force_[k] = std::max(force_[k] - step * r[k], 0.0);
      force += step;
      if (enough <= most) {
        append(c, force, std::move(z), std::move(shares), length);
        return true;
      }
      drop(first);
    }
    return false;
  }

  /// Takes what rounding has left off the active pairs' targets.
  void settle() {
    std::vector<double> step(active_.size());
    for (std::size_t k = 0; k < active_.size(); ++k) {
      double rest = lacking(active_[k]) * scale_[active_[k]];
      for (std::size_t j = 0; j < k; ++j) rest -= shares_[k][j] * step[j];
      step[k] = rest / shares_[k][k];
    }
    for (std::size_t k = 0; k < active_.size(); ++k) move(step[k], basis_[k]);
  }

  static constexpr double never = std::numeric_limits<double>::infinity();

  std::span<Vec3> u_;
  std::span<PressedPair> pairs_;
  std::vector<double> root_;   // by body: 1 / sqrt(mass)
  std::vector<double> scale_;  // by pair: makes its direction a unit one
  double unit_;                // 1/kg
  std::vector<std::size_t> active_;
  std::vector<double> force_;                // by active pair
  std::vector<Direction> basis_;             // the same
  std::vector<std::vector<double>> shares_;  // its direction in the basis up to itself
};

/// Bodies and pairs that have to do with one another, numbered anew.
struct Part {
  std::vector<std::uint32_t> bodies;  // by their old numbers
  std::vector<std::size_t> which;     // the same of pairs
  std::vector<PressedPair> pairs;
};

std::vector<Part> parts_of(std::size_t bodies, std::span<const PressedPair> pairs) {
  std::vector<std::uint32_t> part(bodies), place(bodies, PressedPair::none);
  std::iota(part.begin(), part.end(), 0u);
  const auto root = [&](std::uint32_t k) {
    while (part[k] != k) k = part[k] = part[part[k]];
    return k;
  };
  for (const PressedPair& p : pairs)
    if (p.b != PressedPair::none) part[root(p.a)] = root(p.b);
  std::vector<Part> parts;
  std::vector<std::size_t> number(bodies, pairs.size());
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    std::size_t& k = number[root(pairs[c].a)];
    if (k == pairs.size()) {
      k = parts.size();
      parts.emplace_back();
    }
    PressedPair pair = pairs[c];
    for (std::uint32_t* i : {&pair.a, &pair.b}) {
      if (*i == PressedPair::none) continue;
      if (place[*i] == PressedPair::none) {
        place[*i] = static_cast<std::uint32_t>(parts[k].bodies.size());
        parts[k].bodies.push_back(*i);
      }
      *i = place[*i];
    }
    parts[k].which.push_back(c);
    parts[k].pairs.push_back(pair);
  }
  return parts;
}

}  // namespace

bool press_few_apart(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<PressedPair> pairs) {
  bool done = true;
  for (Part& part : parts_of(u.size(), pairs)) {
    std::vector<Vec3> motion;
    std::vector<double> inverse;
    for (const std::uint32_t i : part.bodies) {
      motion.push_back(u[i]);
      inverse.push_back(inverse_mass[i]);
    }
    done = ActiveSet(inverse, motion, part.pairs).solve() && done;
    for (std::size_t k = 0; k < motion.size(); ++k) u[part.bodies[k]] = motion[k];
    for (std::size_t k = 0; k < part.which.size(); ++k) pairs[part.which[k]].force = part.pairs[k].force;
  }
  return done;
}

}  // namespace carom
