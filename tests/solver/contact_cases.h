#pragma once
// Problems of contact: rows, stacks, lattices and random packings of balls, wedges and near copies; with masses over
// any number of decades; under gravity, pushed, or struck. For tests and for ./dev bench contacts.

#include "solver/contact_problem.h"
#include "std.h"

namespace carom::contact_cases {

inline constexpr uint32_t fixed = ContactConstraint::fixed;

/// The cases' own random numbers: the same on every machine.
class Draw {
 public:
  explicit Draw(uint64_t seed) : state_(seed * 7919 + 13) {}
  double operator()(double low, double high) {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return low + (high - low) * static_cast<double>(state_ >> 11) * 0x1p-53;
  }
  Vec3 direction() {
    for (;;) {
      const double x = (*this)(-1, 1), y = (*this)(-1, 1), z = (*this)(-1, 1);
      const Vec3 v(x, y, z);
      if (v.norm() < 1 && v.norm() > 0.1) return v / v.norm();
    }
  }

 private:
  uint64_t state_;
};

struct Case {
  string name;
  vector<double> inverse_mass;  // 1/kg
  vector<Vec3> motion;          // free
  vector<ContactConstraint> contacts;
};

/// Balls of diameter 1 m in a box; those that are no farther apart than `near` (m) are in contact.
struct Balls {
  vector<Vec3> center;  // m
  Vec3 low, high;       // m, corners of the box
  double near = 1e-9;
};

inline constexpr double far_away = 1e6;  // m

inline Balls row(int n) {
  Balls balls;
  for (int i = 0; i < n; ++i) balls.center.push_back(Vec3(i, 0, 0));
  balls.low = Vec3(-far_away, -far_away, -0.5);
  balls.high = Vec3(n - 0.5, far_away, far_away);
  return balls;
}

inline Balls stack(int n) {
  Balls balls;
  for (int i = 0; i < n; ++i) balls.center.push_back(Vec3(0, 0, i));
  balls.low = Vec3(-far_away, -far_away, -0.5);
  balls.high = Vec3::Constant(far_away);
  return balls;
}

/// 4 cells^3 balls, face-centred cubic, as tight as can be.
inline Balls lattice(int cells) {
  Balls balls;
  const double edge = sqrt(2.0);
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      for (int k = 0; k < cells; ++k)
        for (const Vec3& at : {Vec3(0, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0.5, 0, 0.5), Vec3(0, 0.5, 0.5)})
          balls.center.push_back(edge * (Vec3(i, j, k) + at));
  balls.low = Vec3::Constant(-0.5);
  balls.high = Vec3::Constant(edge * (cells - 0.5) + 0.5);
  return balls;
}

inline vector<ContactConstraint> contacts_of(const Balls& balls) {
  using Cell = array<int64_t, 3>;
  const double reach = 1 + balls.near;

  const auto cell_of = [&](const Vec3& x) {
    return Cell{static_cast<int64_t>(floor(x.x() / reach)), static_cast<int64_t>(floor(x.y() / reach)),
                static_cast<int64_t>(floor(x.z() / reach))};
  };

  vector<pair<Cell, uint32_t>> cells;
  for (uint32_t i = 0; i < balls.center.size(); ++i) cells.emplace_back(cell_of(balls.center[i]), i);
  ranges::sort(cells);

  vector<ContactConstraint> contacts;
  for (uint32_t i = 0; i < balls.center.size(); ++i) {
    const Vec3& x = balls.center[i];
    for (int axis = 0; axis < 3; ++axis) {
      if (x[axis] - balls.low[axis] <= 0.5 + balls.near)
        contacts.push_back({i, ContactConstraint::fixed, -Vec3::Unit(axis)});
      if (balls.high[axis] - x[axis] <= 0.5 + balls.near)
        contacts.push_back({i, ContactConstraint::fixed, Vec3::Unit(axis)});
    }

    const Cell here = cell_of(x);
    for (int step = 0; step < 27; ++step) {
      const Cell there{here[0] + step / 9 - 1, here[1] + step / 3 % 3 - 1, here[2] + step % 3 - 1};
      auto it = std::lower_bound(cells.begin(), cells.end(), pair(there, i + 1));
      for (; it != cells.end() && it->first == there; ++it) {
        const Vec3 d = balls.center[it->second] - x;
        if (d.norm() <= reach) contacts.push_back({i, it->second, d.normalized()});
      }
    }
  }

  return contacts;
}

/// Soft balls at random places that push each other apart: about 4 contacts a ball.
inline Balls packing(int n, uint64_t seed) {
  Balls balls;
  Draw draw(seed);

  const double edge = std::cbrt(n * 3.14159265358979 / 6 / 0.66);

  balls.low = Vec3::Zero();
  balls.high = Vec3::Constant(edge);
  for (int i = 0; i < n; ++i) {
    const double x = draw(0.5, edge - 0.5), y = draw(0.5, edge - 0.5), z = draw(0.5, edge - 0.5);
    balls.center.push_back(Vec3(x, y, z));
  }

  balls.near = 0;
  for (int pass = 0; pass < 400; ++pass) {
    vector<Vec3> push(balls.center.size(), Vec3::Zero());

    for (const ContactConstraint& c : contacts_of(balls)) {
      const Vec3& x = balls.center[c.a];
      if (c.b == ContactConstraint::fixed) {
        const double wall = c.normal.dot(c.normal.sum() > 0 ? balls.high : balls.low);
        push[c.a] += 0.5 * (wall - c.normal.dot(x) - 0.5) * c.normal;
      } else {
        const double gap = (balls.center[c.b] - x).norm() - 1;
        push[c.a] += 0.25 * gap * c.normal;
        push[c.b] -= 0.25 * gap * c.normal;
      }
    }

    for (size_t i = 0; i < push.size(); ++i) balls.center[i] += push[i];
  }

  balls.near = 0.01;
  return balls;
}

enum class Load { gravity, push, impact };
inline constexpr array loads{Load::gravity, Load::push, Load::impact};

/// Masses are 1 kg over up to so many decades. A push: a fifth of the balls are pushed at random; an impact: all move
/// at random.
inline Case loaded(const string& name, const Balls& balls, Load load, double decades, uint64_t seed = 1) {
  constexpr array words{"gravity", "push", "impact"};
  Case c{name + ", " + words[static_cast<size_t>(load)] + ", masses 1e" + to_string(static_cast<int>(decades)),
         {},
         {},
         contacts_of(balls)};

  Draw draw(seed);

  for (size_t i = 0; i < balls.center.size(); ++i) {
    c.inverse_mass.push_back(pow(10.0, draw(0, decades)));

    Vec3 u(0, 0, load == Load::impact ? 0 : -9.81);
    const double chance = draw(0, 1), size = draw(0, 1);
    const Vec3 way = draw.direction();
    if (load == Load::push && (chance < 0.2 || i == 0)) u += 100 * size * way;
    if (load == Load::impact) u = 1.7 * size * way;
    c.motion.push_back(u);
  }

  return c;
}

/// A ball between two walls that open upwards by this angle (rad) on either side, and a ball on it. It is pressed down;
/// or (squeezed) the walls close in and throw it out.
inline Case wedge(double angle, bool squeezed) {
  const double c = std::cos(angle), s = std::sin(angle);
  Case it{"wedge of 1e" + to_string(static_cast<int>(std::lround(std::log10(angle)))) + (squeezed ? ", squeezed" : ""),
          {1, 0.5},
          {Vec3(0.1, 0, -9.81), Vec3(0.02, 0.01, -9.81)},
          {{0, ContactConstraint::fixed, Vec3(c, 0, -s)},
           {0, ContactConstraint::fixed, Vec3(-c, 0, -s)},
           {0, 1, Vec3(std::sin(0.3), 0, std::cos(0.3))}}};
  if (squeezed) it.contacts[0].target = it.contacts[1].target = 1;
  return it;
}

/// Each contact twice, the second turned by this angle (rad).
inline Case with_copies(Case c, double angle, uint64_t seed = 1) {
  Draw draw(seed);
  c.name += ", copies 1e" + to_string(static_cast<int>(std::lround(std::log10(angle))));
  const size_t n = c.contacts.size();
  for (size_t k = 0; k < n; ++k) {
    ContactConstraint copy = c.contacts[k];
    copy.normal = (copy.normal + angle * draw.direction()).normalized();
    c.contacts.push_back(copy);
  }
  return c;
}

}  // namespace carom::contact_cases
