#include "scene/placement.h"
#include "physics/world.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom {
namespace {

const double root3 = std::sqrt(3.0);

/// Whole steps of length `step` in `length`, rounding forgiven: 0.3 holds three of 0.1.
double steps_in(double length, double step) {
  return std::max(0.0, std::floor(length / step * (1 + 1e-12)));
}

/// Sites for balls of diameter `spacing` (at least the true one) in the box of `edge`.
struct Lattice {
  Vec3 edge;
  double spacing;
  double nx, ny, nz;  // cells along each edge; at least one, since the balls themselves are no larger than the box

  Lattice(const Vec3& e, double s)
      : edge(e),
        spacing(s),
        nx(std::max(1.0, steps_in(e.x(), s))),
        ny(std::max(1.0, steps_in(e.y(), s))),
        nz(std::max(1.0, steps_in(e.z(), s))) {}
  double capacity() const { return nx * ny * nz; }

  template <typename Visit>  // visit(Vec3 from the lower corner) -> go on?
  void each(Visit visit) const {
    for (double j = 0; j < ny; ++j) {
      for (double k = 0; k < nz; ++k) {
        for (double i = 0; i < nx; ++i) {
          if (!visit(Vec3((i + 0.5) * (edge.x() / nx), (j + 0.5) * (edge.y() / ny), (k + 0.5) * (edge.z() / nz))))
            return;
        }
      }
    }
  }
};

/// Close-packed layers upon each other along y, rows along x. Odd layers sit in the hollows of the even ones.
struct Hexagonal {
  Vec3 edge;
  double spacing;
  double layers, rows[2], columns[2];  // rows of even and odd layers; sites of unshifted and shifted rows

  Hexagonal(const Vec3& e, double s) : edge(e), spacing(s) {
    const Vec3 room(std::max(0.0, e.x() - s), std::max(0.0, e.y() - s), std::max(0.0, e.z() - s));  // of the centres
    layers = steps_in(room.y(), s * std::sqrt(2.0 / 3)) + 1;
    rows[0] = steps_in(room.z(), s * root3 / 2) + 1;
    rows[1] = room.z() * (1 + 1e-12) < s / (2 * root3) ? 0 : steps_in(room.z() - s / (2 * root3), s * root3 / 2) + 1;
    columns[0] = steps_in(room.x(), s) + 1;
    columns[1] = room.x() * (1 + 1e-12) < s / 2 ? 0 : steps_in(room.x() - s / 2, s) + 1;
  }
  /// Whether row k of layer j is shifted by half a step.
  static int shifted(std::int64_t j, std::int64_t k) { return static_cast<int>((j + k) & 1); }

  double capacity() const {
    double total = 0;
    for (int odd = 0; odd < 2; ++odd) {
      const double of_kind = odd ? std::floor(layers / 2) : std::ceil(layers / 2);
      const double unshifted = odd ? std::floor(rows[odd] / 2) : std::ceil(rows[odd] / 2);
      total += of_kind * (unshifted * columns[0] + (rows[odd] - unshifted) * columns[1]);
    }
    return total;
  }

  template <typename Visit>
  void each(Visit visit) const {
    // What the layers leave free is shared between both sides.
    const double in_x = std::max((columns[0] - 1) * spacing, columns[1] > 0 ? (columns[1] - 0.5) * spacing : 0.0);
    const double in_z =
        std::max((rows[0] - 1) * spacing * root3 / 2,
                 layers > 1 && rows[1] > 0 ? spacing / (2 * root3) + (rows[1] - 1) * spacing * root3 / 2 : 0.0);
    const double in_y = (layers - 1) * spacing * std::sqrt(2.0 / 3);
    const Vec3 start((edge.x() - in_x) / 2, (edge.y() - in_y) / 2, (edge.z() - in_z) / 2);
    for (std::int64_t j = 0; j < static_cast<std::int64_t>(layers); ++j) {
      const int odd = static_cast<int>(j & 1);
      for (std::int64_t k = 0; k < static_cast<std::int64_t>(rows[odd]); ++k) {
        const int half = shifted(j, k);
        for (std::int64_t i = 0; i < static_cast<std::int64_t>(columns[half]); ++i) {
          const Vec3 site((static_cast<double>(i) + 0.5 * half) * spacing,
                          static_cast<double>(j) * spacing * std::sqrt(2.0 / 3),
                          static_cast<double>(k) * spacing * root3 / 2 + (odd ? spacing / (2 * root3) : 0.0));
          if (!visit(Vec3(start + site))) return;
        }
      }
    }
  }
};

class Placer {
 public:
  Placer(const Placing& placing, const World& world, const BodyGrid& others, Random& random)
      : p_(placing), world_(world), others_(others), random_(random), edge_(placing.max - placing.min) {}

  Placed run() {
    if (p_.count == 0) return {};
    if ((edge_.array() < 2 * p_.radius * (1 - 1e-12)).any()) return {};
    if (p_.arrange == Arrange::lattice) return thin<Lattice>();
    if (p_.arrange == Arrange::hexagonal) return thin<Hexagonal>();
    Placed placed = one_by_one();
    return placed.centers.empty() ? jittered() : placed;
  }

 private:
  bool is_free(const Vec3& center) const {
    return touches_no_surface(world_, p_.first, center) && !others_.find_overlap({center, p_.radius, p_.first});
  }

  /// Random sequential addition. Gives up where the free volume is too small to be found by chance.
  Placed one_by_one() {
    const double volume = edge_.x() * edge_.y() * edge_.z();
    const double balls =
        static_cast<double>(p_.count) * (4.0 / 3 * 3.14159265358979324) * p_.radius * p_.radius * p_.radius;
    if (balls > 0.36 * volume && p_.count > 8) return {};  // it saturates at 0.384
    const Vec3 low = p_.min.array() + p_.radius;
    const Vec3 free = (edge_.array() - 2 * p_.radius).max(0.0);
    std::uint64_t tries = 10'000 + 40 * p_.count;
    BodyGrid grid;
    grid.reserve(p_.count);
    Placed placed;
    placed.centers.reserve(p_.count);
    const auto draw = [&](Random& random) {
      // One call a statement: the order of evaluation inside an expression is the compiler's choice.
      Vec3 center;
      for (int k = 0; k < 3; ++k) center[k] = low[k] + random.uniform() * free[k];
      return center;
    };
    // Most of the time goes by waiting for memory: a copy of the random numbers runs ahead and asks for it.
    constexpr std::uint64_t far = 16, near = 8;
    Random ahead = random_;
    std::array<Vec3, far> coming;
    for (Vec3& center : coming) center = draw(ahead);
    for (std::uint64_t next = 0; placed.centers.size() < p_.count; ++next) {
      if (tries-- == 0) return {};
      const Vec3 center = draw(random_);
      coming[next % far] = draw(ahead);
      grid.prefetch({coming[next % far], p_.radius, p_.first}, BodyGrid::Prefetch::cells);
      grid.prefetch({coming[(next + near) % far], p_.radius, p_.first}, BodyGrid::Prefetch::members);
      if (grid.find_overlap({center, p_.radius, p_.first}) || !is_free(center)) continue;
      grid.insert({center, p_.radius, p_.first});
      placed.centers.push_back(center);
    }
    return placed;
  }

  /// The free sites of the widest spacing that has `count` of them; fewer if even the tightest has not.
  template <typename Sites>
  std::vector<Vec3> free_sites(double& spacing) const {
    // The widest spacing by bisection, nothing being in the way.
    const double closest = 2 * p_.radius;
    const auto count = static_cast<double>(p_.count);
    double wide = edge_.maxCoeff() * 2;
    spacing = closest;
    if (Sites(edge_, closest).capacity() >= count) {
      for (int i = 0; i < 100 && wide - spacing > 1e-14 * wide; ++i) {
        const double middle = spacing + (wide - spacing) / 2;
        (Sites(edge_, middle).capacity() >= count ? spacing : wide) = middle;
      }
    }
    // Then narrower as long as something is.
    const double most_sites = 64 * count + 1e6;
    std::vector<Vec3> best;
    for (double s = spacing;;) {
      std::vector<Vec3> sites;
      Sites(edge_, s).each([&](const Vec3& site) {
        const Vec3 center = p_.min + site;
        if (is_free(center)) sites.push_back(center);
        return true;
      });
      if (sites.size() > best.size() || best.empty()) {
        best = std::move(sites);
        spacing = s;
      }
      if (best.size() >= p_.count || s <= closest) return best;
      // Fewer free sites than balls: narrower by about the fourth root of the ratio, so that the cube is not overshot.
      const double shrink = std::sqrt(std::sqrt(std::max<double>(1, static_cast<double>(best.size())) / count));
      s = std::max(closest, s * std::clamp(shrink, 0.5, 0.98));
      if (Sites(edge_, s).capacity() > most_sites) return best;
    }
  }

  template <typename Sites>
  Placed thin() const {
    double spacing = 0;
    const std::vector<Vec3> sites = free_sites<Sites>(spacing);
    Placed placed;
    if (sites.size() < p_.count) {
      placed.fit = sites.size();
      return placed;
    }
    // Site i of the k-th ball: i = k * sites / count, whole part, without overflow.
    const std::uint64_t whole = sites.size() / p_.count, rest = sites.size() % p_.count;
    placed.centers.reserve(p_.count);
    for (std::uint64_t k = 0; k < p_.count; ++k) placed.centers.push_back(sites[k * whole + k * rest / p_.count]);
    return placed;
  }

  /// A random choice of close-packed sites, each ball moved within the part of its site that is its own.
  Placed jittered() const {
    double spacing = 0;
    std::vector<Vec3> sites = free_sites<Hexagonal>(spacing);
    Placed placed;
    if (sites.size() < p_.count) {
      placed.fit = sites.size();
      return placed;
    }
    // A cube inside the sphere of half the gap: two neighbours that move towards one another stay apart.
    const double half = std::max(0.0, (spacing / 2 - p_.radius) / root3 * (1 - 1e-9));
    const Vec3 low = p_.min.array() + p_.radius, high = p_.max.array() - p_.radius;
    for (std::uint64_t k = 0; k < p_.count; ++k) {
      std::swap(sites[k], sites[k + random_.below(sites.size() - k)]);
      Vec3 moved = sites[k];
      for (int axis = 0; axis < 3; ++axis) {
        moved[axis] += (2 * random_.uniform() - 1) * half;
        moved[axis] = std::max(low[axis], std::min(high[axis], moved[axis]));
      }
      placed.centers.push_back(is_free(moved) ? moved : sites[k]);
    }
    return placed;
  }

  const Placing& p_;
  const World& world_;
  const BodyGrid& others_;
  Random& random_;
  Vec3 edge_;
};

}  // namespace

Placed place(const Placing& placing, const World& world, const BodyGrid& others, Random& random) {
  return Placer(placing, world, others, random).run();
}

}  // namespace carom
