#pragma once
// Balls in lasting contact without friction, and on strings and rods, by an independent method. Lagrange multipliers of
// the pressing contacts, dense, in 64-bit mantissas, give the accelerations. Extrapolated midpoint steps of order 16
// follow them (Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, 1993, II.9). A contact opens where
// its multiplier vanishes. The motion ends before one closes.

#include "numerics/vec3.h"
#include "std.h"

namespace carom {

class ConstrainedReference {
 public:
  using Real = long double;
  using Vec = Eigen::Matrix<Real, 3, 1>;
  static constexpr int floor = -1;  // y >= 0; -2 - k: fixed globe k
  static constexpr int none = -1;

  struct Globe {
    Vec3 center;    // m
    double radius;  // m
  };
  struct Flat {
    Vec3 point, normal;  // m, unit: to the free side
  };
  /// A string at its full length, or a rod.
  struct Tie {
    size_t body;
    int other = none;            // the other body, or the anchor
    Vec3 anchor = Vec3::Zero();  // m
    bool rod = false;
  };
  vector<double> mass, radius;  // kg, m
  vector<Vec3> start, force;    // m; m/s^2, what acts on each, gravity included
  vector<Vec3> velocity{};      // m/s, at the start, along all contacts and ties; empty: at rest
  vector<Globe> globes;
  vector<Flat> flats{};
  vector<Tie> ties{};
  bool has_floor = true;
  Vec3 origin = Vec3::Zero();  // m: a place near all others, from which they are computed

  struct Motion {
    vector<Vec3> x, v;    // m, m/s, at `time`
    double time = 0;      // s
    size_t openings = 0;  // until then
  };

  /// From the start on for `duration` (s), or until shortly before a contact closes or a string goes slack, in steps of
  /// `step` (s).
  Motion follow(double duration, double step) {
    const size_t n = mass.size();

    x_.clear();
    for (const Vec3& at : start) x_.push_back(from_origin(at));
    v_.assign(n, Vec::Zero());
    for (size_t k = 0; k < velocity.size(); ++k) v_[k] = velocity[k].cast<Real>();
    near_ = std::max<Real>(1e-12L, 0x1p-47L * origin.cwiseAbs().sum());
    find_rows();
    press();

    Motion motion;
    Real time = 0;
    while (time < duration) {
      const auto [x, v] = pair(x_, v_);
      Real h = std::min<Real>(step, duration - time);
      advance(h);
      if (const auto worst = pull(); worst < -tiny) {
        h = find_opening(x, v, h);
        motion.openings += open();
      }

      if (closes() || slackens()) {
        x_ = x;
        v_ = v;
        break;
      }
      time += h;
    }

    motion.time = static_cast<double>(time);
    for (size_t k = 0; k < n; ++k) {
      motion.x.push_back((x_[k] + origin.cast<Real>()).cast<double>());
      motion.v.push_back(v_[k].cast<double>());
    }
    return motion;
  }

 private:
  static constexpr Real tiny = 1e-13L;  // of the greatest force
  struct Row {
    size_t a;
    int b;
    bool presses = false;
    int flat = none, tie = none;
  };
  struct Bend {
    Vec n;           // from a to b
    Real gap, bend;  // m; m/s^2, of the gap
  };

  Vec from_origin(const Vec3& place) const { return place.cast<Real>() - origin.cast<Real>(); }
  static Bend bend_along(const Vec& d, const Vec& w, Real sum) {
    const Real size = d.norm(), along = d.dot(w) / size;
    return {d / size, size - sum, (w.squaredNorm() - along * along) / size};
  }

  Bend bend_of(const Row& row, const vector<Vec>& x, const vector<Vec>& v) const {
    if (row.tie != none) {
      const Tie& tie = ties[static_cast<size_t>(row.tie)];
      const bool anchored = tie.other == none;
      const auto other = static_cast<size_t>(tie.other);
      const Vec d = (anchored ? from_origin(tie.anchor) : x[other]) - x[row.a];
      const Bend at = bend_along(d, anchored ? Vec(-v[row.a]) : Vec(v[other] - v[row.a]), 0);
      return {-at.n, 0, -at.bend};
    }

    if (row.flat != none) {
      const Flat& flat = flats[static_cast<size_t>(row.flat)];
      const Vec n = flat.normal.cast<Real>();
      return {-n, n.dot(x[row.a] - from_origin(flat.point)) - radius[row.a], 0};
    }

    if (row.b == floor) return {Vec(0, -1, 0), x[row.a].y() - radius[row.a], 0};

    const bool body = row.b >= 0;
    const auto b = static_cast<size_t>(body ? row.b : -2 - row.b);
    const Vec d = (body ? x[b] : from_origin(globes[b].center)) - x[row.a];
    const Vec w = body ? Vec(v[b] - v[row.a]) : Vec(-v[row.a]);
    return bend_along(d, w, static_cast<Real>(radius[row.a]) + (body ? radius[b] : globes[b].radius));
  }

  void find_rows() {
    rows_.clear();
    const auto n = static_cast<int>(mass.size());
    for (int a = 0; a < n; ++a) {
      const auto i = static_cast<size_t>(a);
      for (int b = a + 1; b < n; ++b) rows_.push_back({i, b});
      if (has_floor) rows_.push_back({i, floor});
      for (int k = 0; k < static_cast<int>(globes.size()); ++k) rows_.push_back({i, -2 - k});
      for (int k = 0; k < static_cast<int>(flats.size()); ++k) rows_.push_back({i, none, false, k});
    }

    for (int k = 0; k < static_cast<int>(ties.size()); ++k) {
      const Tie& tie = ties[static_cast<size_t>(k)];
      rows_.push_back({tie.body, tie.other, true, none, k});
    }
  }

  /// The multipliers (N) with which the rates of these rows' gaps stay unchanged, by Cholesky's factors.
  vector<Real> multipliers(const vector<size_t>& set, const vector<Vec>& x, const vector<Vec>& v) const {
    const size_t n = set.size();

    vector<Bend> at;
    for (const size_t c : set) at.push_back(bend_of(rows_[c], x, v));

    vector<vector<Real>> m(n, vector<Real>(n));
    vector<Real> y(n);

    // Of each row: its gap's acceleration without it, and what a unit force along it or another does to that.
    for (size_t c = 0; c < n; ++c) {
      const Row& p = rows_[set[c]];
      Vec f = -force[p.a].cast<Real>();
      if (p.b >= 0) f += force[static_cast<size_t>(p.b)].cast<Real>();
      y[c] = -(at[c].n.dot(f) + at[c].bend);

      for (size_t d = 0; d <= c; ++d) {
        const Row& q = rows_[set[d]];
        const Real cosine = at[c].n.dot(at[d].n);
        Real sum = 0;
        if (p.a == q.a) sum += cosine / mass[p.a];
        if (p.b >= 0 && p.b == q.b) sum += cosine / mass[static_cast<size_t>(p.b)];
        if (p.b >= 0 && p.b == static_cast<int>(q.a)) sum -= cosine / mass[q.a];
        if (q.b >= 0 && q.b == static_cast<int>(p.a)) sum -= cosine / mass[p.a];
        m[c][d] = sum;
      }
    }

    // Factors, and the substitution forwards.
    for (size_t c = 0; c < n; ++c) {
      for (size_t d = 0; d <= c; ++d) {
        for (size_t k = 0; k < d; ++k) m[c][d] -= m[c][k] * m[d][k];
        m[c][d] = c == d ? sqrt(m[c][c]) : m[c][d] / m[d][d];
      }
      for (size_t k = 0; k < c; ++k) y[c] -= m[c][k] * y[k];
      y[c] /= m[c][c];
    }

    // Backwards.
    for (size_t c = n; c-- > 0;) {
      for (size_t k = c + 1; k < n; ++k) y[c] -= m[k][c] * y[k];
      y[c] /= m[c][c];
    }
    return y;
  }

  vector<size_t> pressing() const {
    vector<size_t> set;
    for (size_t c = 0; c < rows_.size(); ++c)
      if (rows_[c].presses) set.push_back(c);
    return set;
  }

  vector<Vec> accelerate(const vector<Vec>& x, const vector<Vec>& v) const {
    vector<Vec> a;
    for (const Vec3& f : force) a.push_back(f.cast<Real>());
    const vector<size_t> set = pressing();
    const vector<Real> y = multipliers(set, x, v);
    for (size_t c = 0; c < set.size(); ++c) {
      const Row& row = rows_[set[c]];
      const Vec n = bend_of(row, x, v).n;
      a[row.a] -= y[c] / mass[row.a] * n;
      if (row.b >= 0) a[static_cast<size_t>(row.b)] += y[c] / mass[static_cast<size_t>(row.b)] * n;
    }
    return a;
  }

  /// m/s^2: of a row's gap.
  Real parting(const Row& row, const vector<Vec>& a) const {
    const Bend at = bend_of(row, x_, v_);
    const Vec w = row.b >= 0 ? Vec(a[static_cast<size_t>(row.b)] - a[row.a]) : Vec(-a[row.a]);
    return at.n.dot(w) + at.bend;
  }

  /// The contacts that press now: Lawson & Hanson's active set (Solving Least Squares Problems, 1974, ch. 23).
  void press() {
    vector<size_t> closed;
    for (size_t c = 0; c < rows_.size(); ++c)
      if (rows_[c].tie == none && std::abs(bend_of(rows_[c], x_, v_).gap) < near_) closed.push_back(c);
    vector<Real> y(rows_.size(), 0);

    for (;;) {
      const vector<Vec> a = accelerate(x_, v_);
      // The contact that closes fastest joins the set.
      size_t next = rows_.size();
      Real least = -1e-12L;
      for (const size_t c : closed)
        if (!rows_[c].presses && parting(rows_[c], a) < least) {
          least = parting(rows_[c], a);
          next = c;
        }

      if (next == rows_.size()) return;
      rows_[next].presses = true;

      for (;;) {
        // As far towards the new forces as none of them pulls; one that comes to nothing leaves.
        const vector<size_t> set = pressing();
        const vector<Real> z = multipliers(set, x_, v_);
        Real share = 1;
        for (size_t k = 0; k < set.size(); ++k)
          if (z[k] <= 0 && rows_[set[k]].tie == none) share = std::min(share, y[set[k]] / (y[set[k]] - z[k]));
        for (size_t k = 0; k < set.size(); ++k) {
          y[set[k]] += share * (z[k] - y[set[k]]);
          if (share < 1 && y[set[k]] <= 1e-18L && rows_[set[k]].tie == none) {
            rows_[set[k]].presses = false;
            y[set[k]] = 0;
          }
        }

        if (share == 1) break;
      }
    }
  }

  /// One step of h (s): the midpoint rule with 2, 4 .. 16 parts, extrapolated to none.
  void advance(Real h) {
    constexpr int columns = 8;
    const size_t n = x_.size();
    vector<vector<Vec>> xs, vs;

    for (int j = 0; j < columns; ++j) {
      const int parts = 2 * (j + 1);
      const Real s = h / parts;
      vector<Vec> x0 = x_, v0 = v_, a = accelerate(x_, v_), x1 = x0, v1 = v0;

      for (size_t k = 0; k < n; ++k) {
        x1[k] += s * v0[k];
        v1[k] += s * a[k];
      }

      for (int part = 1; part < parts; ++part) {
        a = accelerate(x1, v1);
        for (size_t k = 0; k < n; ++k) {
          const Vec x2 = x0[k] + 2 * s * v1[k], v2 = v0[k] + 2 * s * a[k];
          x0[k] = exchange(x1[k], x2);
          v0[k] = exchange(v1[k], v2);
        }
      }

      xs.push_back(x1);
      vs.push_back(v1);
    }

    // Each order takes away the next even power of the error.
    for (int order = 1; order < columns; ++order)
      for (int j = columns - 1; j >= order; --j) {
        const Real ratio = static_cast<Real>(j + 1) / (j + 1 - order);
        const Real f = 1 / (ratio * ratio - 1);
        const auto to = static_cast<size_t>(j);
        for (size_t k = 0; k < n; ++k) {
          xs[to][k] += f * (xs[to][k] - xs[to - 1][k]);
          vs[to][k] += f * (vs[to][k] - vs[to - 1][k]);
        }
      }

    x_ = xs.back();
    v_ = vs.back();
  }

  /// The least multiplier of a contact, relative to the greatest one. Below 0 it pulls.
  Real pull() const {
    const vector<size_t> set = pressing();
    const vector<Real> y = multipliers(set, x_, v_);
    Real least = 0, greatest = 0;
    for (size_t k = 0; k < set.size(); ++k) {
      if (rows_[set[k]].tie == none) least = std::min(least, y[k]);
      greatest = std::max(greatest, std::abs(y[k]));
    }
    return greatest > 0 ? least / greatest : 0;
  }

  /// s: the step from there after which the first contact begins to pull.
  Real find_opening(const vector<Vec>& x, const vector<Vec>& v, Real h) {
    Real low = 0, high = h;
    for (int pass = 0; pass < 60; ++pass) {
      const Real middle = (low + high) / 2;
      x_ = x;
      v_ = v;
      advance(middle);
      (pull() < -tiny ? high : low) = middle;
    }

    x_ = x;
    v_ = v;
    advance(high);
    return high;
  }

  size_t open() {
    const vector<size_t> set = pressing();
    const vector<Real> y = multipliers(set, x_, v_);
    const Real greatest = std::abs(*ranges::max_element(y, [](Real p, Real q) { return std::abs(p) < std::abs(q); }));
    size_t opened = 0;
    for (size_t c = 0; c < set.size(); ++c)
      if (y[c] < 0.5L * tiny * greatest && rows_[set[c]].tie == none) {
        rows_[set[c]].presses = false;
        ++opened;
      }
    return opened;
  }

  /// Whether an overlap has formed without a pressing contact.
  bool closes() const {
    return any_of(rows_, [&](const Row& row) { return !row.presses && bend_of(row, x_, v_).gap < -0.1L * near_; });
  }

  bool slackens() const {
    const vector<size_t> set = pressing();
    const vector<Real> y = multipliers(set, x_, v_);
    for (size_t k = 0; k < set.size(); ++k)
      if (const int tie = rows_[set[k]].tie; tie != none && !ties[static_cast<size_t>(tie)].rod && y[k] < 0)
        return true;
    return false;
  }

  vector<Vec> x_, v_;
  vector<Row> rows_;
  Real near_ = 0;  // m: a gap that counts as contact at the start
};

}  // namespace carom
