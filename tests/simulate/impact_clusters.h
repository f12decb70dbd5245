#pragma once
// Clusters of touching balls for tests of impacts at one instant: closed forms, and random ones.
#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "simulate/impact/impact_set.h"
#include "std.h"

namespace carom::impact_clusters {

inline constexpr uint32_t fixed = ImpactSet::fixed;

/// Bodies and rows. The restitution of a row stays the same in all rounds.
struct Cluster {
  vector<double> mass;  // kg
  vector<Vec3> v;       // m/s
  vector<ImpactSet::Row> rows;

  double energy(const vector<Vec3>& at) const {  // J
    double sum = 0;
    for (size_t i = 0; i < mass.size(); ++i) sum += 0.5 * mass[i] * at[i].squaredNorm();
    return sum;
  }
};

struct Resolved {
  vector<Vec3> v;                      // m/s
  vector<ImpactSet::Impact> impacts;   // of all rounds
  vector<ImpactSet::Impact> absorbed;  // of the end of endless rounds
  uint32_t rounds = 0;
  bool finished = true;
  bool without_room = false;
  bool leaves_open = false;
  bool tied = false;
  double change = 0;    // the worst certificate
  double greatest = 0;  // m/s, of all before and after, and of walls
  double approach = 0;  // the greatest that is left, as a share of it
  bool solved = true;
};

inline Resolved resolve(const Cluster& cluster, uint32_t most_rounds = 1'000'000) {
  ImpactSet set;
  for (size_t i = 0; i < cluster.mass.size(); ++i) set.add_body(cluster.mass[i], cluster.v[i]);
  for (const ImpactSet::Row& row : cluster.rows) set.add_row(row);

  Resolved outcome;
  double& greatest = outcome.greatest;
  for (const Vec3& v : cluster.v) greatest = std::max(greatest, v.norm());
  for (const ImpactSet::Row& row : cluster.rows) greatest = std::max(greatest, std::abs(row.surface));

  int idle = 0;
  for (;;) {
    vector<uint32_t> approaching;
    for (uint32_t c = 0; c < set.rows(); ++c)
      if (set.approaches(c)) approaching.push_back(c);
    if (approaching.empty()) break;
    if (set.rounds() > most_rounds || idle > 1) {
      outcome.finished = false;
      break;
    }

    if (set.may_be_endless()) {
      outcome.absorbed = set.end_endless(approaching);
      if (!outcome.absorbed.empty()) break;
    }

    // A round without an impulse has found that what is left of the approaches is rounding.
    const auto& impacts = set.strike(approaching);
    idle = impacts.empty() ? idle + 1 : 0;
    outcome.impacts.insert(outcome.impacts.end(), impacts.begin(), impacts.end());
  }

  const auto& rest = set.finish();
  outcome.absorbed.insert(outcome.absorbed.end(), rest.begin(), rest.end());
  for (uint32_t i = 0; i < set.bodies(); ++i) {
    outcome.v.push_back(set.velocity(i));
    greatest = std::max(greatest, outcome.v.back().norm());
  }

  for (uint32_t c = 0; c < set.rows(); ++c)
    outcome.approach = std::max(outcome.approach, set.approach(c) / std::max(greatest, 1e-300));

  outcome.rounds = set.rounds();
  outcome.without_room = set.without_room();
  outcome.leaves_open = set.open_outcome().has_value();
  outcome.tied = set.tied();
  outcome.change = set.certificate().change;
  outcome.solved = set.certificate().solved();
  return outcome;
}

/// A row of touching balls along x, with these speeds (m/s).
inline Cluster row(const vector<double>& mass, const vector<double>& speed, const vector<double>& e) {
  Cluster cluster{mass, {}, {}};
  for (const double v : speed) cluster.v.emplace_back(v, 0, 0);
  for (uint32_t i = 0; i + 1 < mass.size(); ++i)
    cluster.rows.push_back({i, i + 1, Vec3::UnitX(), Vec3(2.0 * i + 1, 0, 0), 0, e[i % e.size()]});
  return cluster;
}

/// Bodies at places with given normals: a row for each pair (a, b, normal, e).
inline void join(Cluster& cluster, uint32_t a, uint32_t b, const Vec3& normal, double e, double surface = 0) {
  const auto n = static_cast<double>(cluster.rows.size());
  cluster.rows.push_back({a, b, normal, Vec3(n, 0, 0), surface, e});
}

/// Equal balls of radius 1 m at these places, with a row for each pair that touches.
inline Cluster balls(const vector<Vec3>& x, double e) {
  Cluster cluster;
  cluster.mass.assign(x.size(), 1);
  cluster.v.assign(x.size(), Vec3::Zero());
  for (uint32_t i = 0; i < x.size(); ++i)
    for (uint32_t j = i + 1; j < x.size(); ++j) {
      const Vec3 d = x[j] - x[i];
      if (d.norm() < 2 + 1e-9) cluster.rows.push_back({i, j, d / d.norm(), x[i] + x[j], 0, e});
    }
  return cluster;
}

/// The random numbers of clusters, the same on every machine.
class Draw {
 public:
  explicit Draw(uint64_t seed) : generator_(seed) {}
  uint64_t below(uint64_t n) { return generator_() % n; }
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_() >> 11) * 0x1p-53;
  }
  Vec3 direction(bool planar) {
    for (;;) {
      Vec3 u;
      for (int k = 0; k < 3; ++k) u[k] = between(-1, 1);
      if (planar) u.z() = 0;
      if (const double length = u.norm(); length > 0.1 && length < 1) return u / length;
    }
  }

 private:
  std::mt19937_64 generator_;
};

/// How the restitutions of a random cluster are drawn.
enum class Restitutions : uint8_t { zero, one, any, some_zero_and_one, half, nine_tenths, small, all_kinds };

inline double draw_restitution(Draw& draw, Restitutions kind) {
  switch (kind) {
    case Restitutions::zero:
      return 0;
    case Restitutions::one:
      return 1;

    case Restitutions::some_zero_and_one: {
      const uint64_t which = draw.below(3);
      return which == 0 ? 0 : which == 1 ? 1 : draw.between(0, 1);
    }

    case Restitutions::half:
      return 0.5;
    case Restitutions::nine_tenths:
      return 0.9;
    case Restitutions::small:
      return draw.between(0, 0.2);
    default:
      return draw.between(0, 1);
  }
}

/// Whether the walls of a random cluster move: towards it and away; where strings or rods hold it, only away. Opposite
/// walls do not close.
enum class Walls : uint8_t { still, moving };

/// Up to `most` balls, in the plane or in space, on a lattice or a tree of random touches, with up to two walls, masses
/// over up to six decades, and in a third of the cases strings and rods.
class RandomCluster {
 public:
  RandomCluster(uint64_t seed, uint64_t most, Restitutions kind, Walls motion_of_walls)
      : draw_(seed),
        motion_draw_(seed + 0x9e3779b97f4a7c15),
        motion_of_walls_(motion_of_walls),
        most_(2 + draw_.below(most - 1)),
        planar_(draw_.below(2) == 0),
        on_lattice_(draw_.below(2) == 0),
        kind_(kind == Restitutions::all_kinds ? static_cast<Restitutions>(draw_.below(7)) : kind),
        walls_(draw_.below(3)),
        motion_(draw_.below(3)),
        decades_(3 * static_cast<double>(draw_.below(3))),
        tied_(draw_.below(3) == 0) {}

  Cluster make() {
    place();
    join_touching();
    for (uint64_t k = 0; k < walls_; ++k) add_wall(k == 1);
    set_off();
    if (tied_) tie();
    return cluster_;
  }

 private:
  /// Each ball touches one that is there, and no other by more than rounding.
  void place() {
    const double h = sqrt(3.0);
    const double q = sqrt(2.0);
    const vector<Vec3> flat{{2, 0, 0}, {-2, 0, 0}, {1, h, 0}, {-1, h, 0}, {1, -h, 0}, {-1, -h, 0}};
    const vector<Vec3> deep{{q, q, 0},  {q, -q, 0},  {-q, q, 0}, {-q, -q, 0}, {q, 0, q},  {q, 0, -q},
                            {-q, 0, q}, {-q, 0, -q}, {0, q, q},  {0, q, -q},  {0, -q, q}, {0, -q, -q}};
    const vector<Vec3>& steps = planar_ ? flat : deep;

    for (int tries = 0; x_.size() < most_ && tries < 20'000; ++tries) {
      const size_t i = draw_.below(x_.size());
      const double r = on_lattice_ ? 1 : pow(10, draw_.between(-0.3, 0.3));
      const Vec3 at = on_lattice_ ? Vec3(x_[i] + steps[draw_.below(steps.size())])
                                  : Vec3(x_[i] + (radius_[i] + r) * draw_.direction(planar_));
      bool clear = true;
      for (size_t k = 0; k < x_.size(); ++k) clear = clear && (at - x_[k]).norm() >= radius_[k] + r - 1e-9;
      if (!clear) continue;
      x_.push_back(at);
      radius_.push_back(r);
    }
  }

  void join_touching() {
    for (uint32_t i = 0; i < x_.size(); ++i)
      for (uint32_t j = i + 1; j < x_.size(); ++j) {
        const Vec3 d = x_[j] - x_[i];
        if (d.norm() < radius_[i] + radius_[j] + 1e-9)
          cluster_.rows.push_back({i, j, d / d.norm(), x_[i] + x_[j], 0, draw_restitution(draw_, kind_)});
      }
  }

  /// A wall that the outermost balls touch; the second one may be opposite to the last row.
  void add_wall(bool second) {
    Vec3 normal = draw_.direction(planar_);
    const bool opposite = second && draw_.below(2) == 0;
    if (opposite) normal = -cluster_.rows.back().normal;
    double outermost = -1e9;
    for (size_t i = 0; i < x_.size(); ++i) outermost = std::max(outermost, x_[i].dot(normal) + radius_[i]);

    double surface = motion_of_walls_ == Walls::still ? 0 : motion_draw_.between(tied_ ? 0 : -1, 1);
    if (opposite) surface = std::max(surface, -cluster_.rows.back().surface);
    for (uint32_t i = 0; i < x_.size(); ++i)
      if (x_[i].dot(normal) + radius_[i] > outermost - 1e-9)
        cluster_.rows.push_back({i, fixed, normal, x_[i] + x_[i], surface, draw_restitution(draw_, kind_)});
  }

  /// Masses and velocities: random ones, one ball alone, or all towards the middle.
  void set_off() {
    Vec3 middle = Vec3::Zero();
    for (const Vec3& at : x_) middle += at / static_cast<double>(x_.size());

    for (const Vec3& at : x_) {
      cluster_.mass.push_back(pow(10, draw_.between(-decades_ / 2, decades_ / 2)));
      Vec3 v = Vec3::Zero();
      if (motion_ == 0) v = draw_.between(0, 1) * draw_.direction(planar_);
      if (motion_ == 2) v = 0.1 * (middle - at);
      cluster_.v.push_back(v);
    }
    if (motion_ == 1) cluster_.v[draw_.below(x_.size())] = draw_.direction(planar_);
  }

  /// Strings and rods to points and between balls. The velocities keep their lengths.
  void tie() {
    vector<ContactConstraint> links;
    for (uint64_t k = 1 + draw_.below(3); k > 0; --k) {
      const auto a = static_cast<uint32_t>(draw_.below(x_.size()));
      const auto b = static_cast<uint32_t>(draw_.below(x_.size()));
      ImpactSet::Row link{a, fixed, draw_.direction(planar_), x_[a] + x_[a]};
      link.kind = draw_.below(2) == 0 ? ImpactSet::Kind::taut : ImpactSet::Kind::rod;
      if (a != b && draw_.below(2) == 0) {
        link.b = b;
        link.normal = (x_[a] - x_[b]).normalized();
        link.place = x_[a] + x_[b];
      }

      cluster_.rows.push_back(link);
      links.push_back({link.a, link.b, link.normal});
      links.back().bilateral = true;
      links.back().slack = 1e-12;
    }

    vector<double> inverse_mass;
    for (const double mass : cluster_.mass) inverse_mass.push_back(1 / mass);
    solve({inverse_mass, cluster_.v, links});
  }

  // In the order in which they are drawn.
  Draw draw_, motion_draw_;
  Walls motion_of_walls_;
  uint64_t most_;
  bool planar_, on_lattice_;
  Restitutions kind_;
  uint64_t walls_, motion_;
  double decades_;
  bool tied_;

  vector<Vec3> x_{Vec3::Zero()};  // m
  vector<double> radius_{1};      // m
  Cluster cluster_;
};

inline Cluster random_cluster(uint64_t seed, uint64_t most, Restitutions kind = Restitutions::all_kinds,
                              Walls motion_of_walls = Walls::still) {
  return RandomCluster(seed, most, kind, motion_of_walls).make();
}

/// The same cluster under other numbers of bodies and rows. `number`: by body, its new one.
inline Cluster renamed(const Cluster& given, uint64_t seed, vector<uint32_t>& number) {
  Draw draw(seed);
  const auto shuffle = [&](auto& list) {
    for (size_t k = list.size(); k > 1; --k) std::swap(list[k - 1], list[draw.below(k)]);
  };

  number.resize(given.mass.size());
  std::iota(number.begin(), number.end(), 0u);
  shuffle(number);

  Cluster other = given;
  for (size_t i = 0; i < number.size(); ++i) {
    other.mass[number[i]] = given.mass[i];
    other.v[number[i]] = given.v[i];
  }

  // A touching row leads from the lower number to the higher.
  for (ImpactSet::Row& r : other.rows) {
    r.a = number[r.a];
    if (r.b == fixed) continue;
    r.b = number[r.b];
    if (r.b > r.a || r.kind != ImpactSet::Kind::touching) continue;
    std::swap(r.a, r.b);
    r.normal = -r.normal;
  }
  shuffle(other.rows);
  return other;
}

/// The same cluster in a mirror: x becomes -x.
inline Cluster mirrored(const Cluster& given) {
  Cluster other = given;
  for (Vec3& v : other.v) v.x() = -v.x();
  for (ImpactSet::Row& r : other.rows) {
    r.normal.x() = -r.normal.x();
    r.place.x() = -r.place.x();
  }
  return other;
}

/// What is wrong with the outcomes of many random clusters. The energy of a cluster is the greatest of that before,
/// that after, and the work of walls.
struct Findings {
  uint64_t clusters = 0;
  double gain = 0;           // share of the energy, the most that is made
  double books = 0;          // share of the energy, the most that rows do not add up to
  double momentum = 0;       // share of the sum of m v
  double approach = 0;       // share of the greatest speed
  double pull = 0;           // share of the sum of m v: the greatest sum of impulses that pulls
  double least_loss = 0;     // share of the energy, of a row with e > 0
  double projection = 0;     // e = 0: share of the speeds, from one projection
  double distance = 0;       // the same with strings and rods, of the distance from the start
  double mirror = 0;         // share of the greatest speed, in the mirror
  uint64_t other_bits = 0;   // under other names
  uint64_t mirror_bits = 0;  // in the mirror
  uint64_t mirror_far = 0;   // in the mirror, by more than 1e-15 of the greatest speed
  uint64_t unfinished = 0;
  uint64_t unsolved = 0;
  uint64_t ended = 0;         // by their limit
  uint64_t without_room = 0;  // of these
  uint32_t rounds = 0;
};

/// The energy, the books and the impulses of an outcome.
inline void examine_books(const Cluster& cluster, const Resolved& outcome, Findings& all) {
  double lost = 0;

  double work = 0;  // of walls
  double of_walls = 0;
  vector<double> impulse(cluster.rows.size(), 0.0);

  for (const auto* const list : {&outcome.impacts, &outcome.absorbed})
    for (const ImpactSet::Impact& impact : *list) {
      lost += impact.lost;
      impulse[impact.row] += impact.impulse;
      work -= impact.impulse * cluster.rows[impact.row].surface;
      of_walls += std::abs(impact.impulse * cluster.rows[impact.row].surface);
    }

  const double before = cluster.energy(cluster.v);
  const double after = cluster.energy(outcome.v);
  const double energy = std::max({before, after, of_walls});
  if (energy == 0) return;
  all.gain = std::max(all.gain, (after - before - work) / energy);
  all.books = std::max(all.books, std::abs(before + work - after - lost) / energy);
  for (const ImpactSet::Impact& impact : outcome.impacts)
    if (cluster.rows[impact.row].restitution > 0) all.least_loss = std::min(all.least_loss, impact.lost / energy);

  // Momentum, which links to points take too. A row of e = 0 has the sum of its impulses, which does not pull.
  double momentum = 0;
  Vec3 change = Vec3::Zero();
  bool tied = false;
  for (size_t i = 0; i < cluster.mass.size(); ++i) {
    momentum += cluster.mass[i] * std::max(cluster.v[i].norm(), outcome.v[i].norm());
    change += cluster.mass[i] * (outcome.v[i] - cluster.v[i]);
  }

  for (size_t c = 0; c < cluster.rows.size(); ++c) {
    const ImpactSet::Row& r = cluster.rows[c];
    if (r.b == fixed) change += impulse[c] * r.normal;
    tied = tied || r.kind != ImpactSet::Kind::touching;
  }
  for (const double j : impulse) all.pull = std::max(all.pull, -j / momentum);
  if (!tied) all.momentum = std::max(all.momentum, change.norm() / momentum);
}

/// With e = 0 throughout, the outcome is one projection.
inline void examine_projection(const Cluster& cluster, const Resolved& outcome, Findings& all) {
  if (!all_of(cluster.rows, [](const ImpactSet::Row& r) { return r.restitution == 0; })) return;
  vector<double> inverse_mass;
  vector<ContactConstraint> rows;
  for (const double mass : cluster.mass) inverse_mass.push_back(1 / mass);
  for (const ImpactSet::Row& r : cluster.rows) {
    rows.push_back({r.a, r.b, r.normal});
    rows.back().surface = r.surface;
    rows.back().bilateral = r.kind == ImpactSet::Kind::rod;
    rows.back().slack = 1e-12;
  }
  vector<Vec3> v = cluster.v;
  solve({inverse_mass, v, rows});

  // Strings and rods may hold a cluster so that its motion is the smallest remainder. Its distance from the start is
  // well-conditioned even then.
  double off = 0;
  double one = 0;
  double other = 0;
  bool tied = false;
  for (const ImpactSet::Row& r : cluster.rows) tied = tied || r.kind != ImpactSet::Kind::touching;
  for (size_t i = 0; i < v.size(); ++i) {
    off += cluster.mass[i] * (v[i] - outcome.v[i]).squaredNorm();
    one += cluster.mass[i] * (v[i] - cluster.v[i]).squaredNorm();
    other += cluster.mass[i] * (outcome.v[i] - cluster.v[i]).squaredNorm();
  }

  const double energy = std::max(cluster.energy(cluster.v), cluster.energy(v));
  if (energy == 0) return;
  const double apart = tied ? std::abs(sqrt(one) - sqrt(other)) : sqrt(off);
  double& greatest = tied ? all.distance : all.projection;
  greatest = std::max(greatest, apart / sqrt(2 * energy));
}

inline void examine(uint64_t seed, uint64_t most, Findings& all, Walls walls = Walls::still) {
  const Cluster cluster = random_cluster(seed, most, Restitutions::all_kinds, walls);
  const Resolved outcome = resolve(cluster);
  ++all.clusters;
  all.unfinished += !outcome.finished;
  all.unsolved += !outcome.solved;
  all.ended += !outcome.absorbed.empty();
  all.without_room += outcome.without_room;
  all.rounds = std::max(all.rounds, outcome.rounds);
  all.approach = std::max(all.approach, outcome.approach);
  examine_books(cluster, outcome, all);
  examine_projection(cluster, outcome, all);

  // Other names.
  vector<uint32_t> number;
  const Resolved other = resolve(renamed(cluster, seed, number));
  bool same = true;
  for (size_t i = 0; i < number.size(); ++i) same = same && other.v[number[i]] == outcome.v[i];
  all.other_bits += !same;

  // The mirror.
  const Resolved image = resolve(mirrored(cluster));
  double off = 0;
  for (size_t i = 0; i < image.v.size(); ++i) {
    const Vec3& v = image.v[i];
    off = std::max(off, (Vec3(-v.x(), v.y(), v.z()) - outcome.v[i]).norm() / std::max(outcome.greatest, 1e-300));
  }
  all.mirror = std::max(all.mirror, off);
  all.mirror_bits += off > 0;
  all.mirror_far += off > 1e-15;
}

/// What every cluster keeps: energy, books, momentum, no approach and no pull at the end, e = 0 as one projection, and
/// the same outcome under other names and in the mirror.
inline void expect_guarantees(const Findings& all) {
  EXPECT_LT(all.gain, 1e-12);
  EXPECT_LT(all.books, 1e-12);
  EXPECT_LT(all.momentum, 1e-12);
  EXPECT_LT(all.approach, 1e-13);
  EXPECT_LT(all.pull, 1e-15);
  EXPECT_GT(all.least_loss, -1e-15);
  EXPECT_LT(all.projection, 1e-12);
  EXPECT_LT(all.distance, 1e-12);
  EXPECT_EQ(all.other_bits, 0u);
  // Where opposed approaches are equal but for rounding, the law is not continuous.
  EXPECT_LT(100 * all.mirror_far, all.clusters);
  EXPECT_EQ(all.unfinished, 0u);
  EXPECT_EQ(all.unsolved, 0u);
}

}  // namespace carom::impact_clusters
