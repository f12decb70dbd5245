// Places a group's balls on a lattice, in close packing, or by random sequential addition.
// Random sequential addition saturates at a volume fraction of 0.384, and it becomes slow before that.
// Denser random groups are therefore close-packed sites with a random displacement, and not relaxed packings.
// All random numbers come from one stream in a fixed order, so the placement is the same on every machine.
#include "scene/placement.h"

#include <numeric>

#include "physics/restitution.h"
#include "physics/world.h"
#include "std.h"

namespace carom {
namespace {

const double root3 = sqrt(3.0);

/// The number of whole steps of length `step` in `length`, tolerant of rounding: 0.3 holds three of 0.1.
double steps_in(double length, double step) {
  return max(0.0, floor(length / step * (1 + 1e-12)));
}

/// Sites for balls of diameter `spacing` in the box of edges `edge`. `spacing` is at least the balls' diameter.
struct Lattice {
  Vec3 edge;
  double spacing;
  // Cells along each edge. There is at least one, because the balls are no larger than the box.
  double nx, ny, nz;

  Lattice(const Vec3& e, double s)
      : edge(e),
        spacing(s),
        nx(max(1.0, steps_in(e.x(), s))),
        ny(max(1.0, steps_in(e.y(), s))),
        nz(max(1.0, steps_in(e.z(), s))) {}
  double capacity() const { return nx * ny * nz; }

  // visit(Vec3 from the lower corner) returns whether to continue.
  template <typename Visit>
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

/// Close-packed layers stacked along y, with rows along x. Odd layers sit in the hollows of the even ones.
struct Hexagonal {
  Vec3 edge;
  double spacing;
  // Rows of even and of odd layers; sites of unshifted and of shifted rows.
  double layers, rows[2], columns[2];

  Hexagonal(const Vec3& e, double s) : edge(e), spacing(s) {
    // The room for the centres.
    const Vec3 room(max(0.0, e.x() - s), max(0.0, e.y() - s), max(0.0, e.z() - s));
    layers = steps_in(room.y(), s * sqrt(2.0 / 3)) + 1;
    rows[0] = steps_in(room.z(), s * root3 / 2) + 1;
    rows[1] = room.z() * (1 + 1e-12) < s / (2 * root3) ? 0 : steps_in(room.z() - s / (2 * root3), s * root3 / 2) + 1;
    columns[0] = steps_in(room.x(), s) + 1;
    columns[1] = room.x() * (1 + 1e-12) < s / 2 ? 0 : steps_in(room.x() - s / 2, s) + 1;
  }
  /// 1 if row k of layer j is shifted by half a step, else 0.
  static int shifted(int64_t j, int64_t k) { return int((j + k) & 1); }

  double capacity() const {
    double total = 0;
    for (int odd = 0; odd < 2; ++odd) {
      const double of_kind = odd ? floor(layers / 2) : ceil(layers / 2);
      const double unshifted = odd ? floor(rows[odd] / 2) : ceil(rows[odd] / 2);
      total += of_kind * (unshifted * columns[0] + (rows[odd] - unshifted) * columns[1]);
    }
    return total;
  }

  template <typename Visit>
  void each(Visit visit) const {
    // The space that the layers leave free is shared equally between both sides.
    const double in_x = max((columns[0] - 1) * spacing, columns[1] > 0 ? (columns[1] - 0.5) * spacing : 0.0);
    const double in_z =
        max((rows[0] - 1) * spacing * root3 / 2,
            layers > 1 && rows[1] > 0 ? spacing / (2 * root3) + (rows[1] - 1) * spacing * root3 / 2 : 0.0);
    const double in_y = (layers - 1) * spacing * sqrt(2.0 / 3);
    const Vec3 start((edge.x() - in_x) / 2, (edge.y() - in_y) / 2, (edge.z() - in_z) / 2);

    for (int64_t j = 0; j < int64_t(layers); ++j) {
      const int odd = int(j & 1);
      for (int64_t k = 0; k < int64_t(rows[odd]); ++k) {
        const int half = shifted(j, k);

        for (int64_t i = 0; i < int64_t(columns[half]); ++i) {
          const Vec3 site((double(i) + 0.5 * half) * spacing, double(j) * spacing * sqrt(2.0 / 3),
                          double(k) * spacing * root3 / 2 + (odd ? spacing / (2 * root3) : 0.0));
          if (!visit(Vec3(start + site))) return;
        }
      }
    }
  }
};

class Placer {
 public:
  Placer(const Placing& placing, const World& world, const BodyGrid& others, Random& random)
      : p_(placing), world_(world), others_(others), random_(random), edge_(placing.max - placing.min) {
    order_.resize(p_.count);
    std::iota(order_.begin(), order_.end(), Entity{0});
    ranges::stable_sort(order_, [&](Entity a, Entity b) { return p_.radii[a] > p_.radii[b]; });
  }

  Placed run() {
    if (p_.count == 0) return {};
    if ((edge_.array() < 2 * largest() * (1 - 1e-12)).any()) return {};
    if (p_.arrange == Arrange::lattice) return thin<Lattice>();
    if (p_.arrange == Arrange::hexagonal) return thin<Hexagonal>();
    Placed placed = one_by_one();
    return placed.centers.empty() ? jittered() : placed;
  }

 private:
  double largest() const { return p_.radii[order_.front()]; }

  /// Whether the ball lies inside the round surface of the space. Its box is kept by construction.
  bool is_inside(const Vec3& center, double radius) const {
    if (p_.space.shape == Shape::box) return true;
    Vec3 d = center - p_.center;
    if (p_.space.shape == Shape::cylinder) d.y() = 0;
    return d.norm() <= (p_.space.half.x() - radius) * (1 + 1e-12);
  }

  /// Whether this ball of the group may lie there, as far as things outside the group are concerned.
  bool is_free(const Vec3& center, Entity ball) const {
    const Entity body = p_.first + ball;
    return is_inside(center, p_.radii[ball]) && touches_no_surface(world_, body, center) &&
           !others_.find_overlap({center, p_.radii[ball], body});
  }
  /// Whether the largest ball may.
  bool is_free(const Vec3& center) const { return is_free(center, order_.front()); }

  /// The volume of all balls (m^3).
  double volume_of_balls() const {
    const auto volume = [](double radius) { return (4.0 / 3 * 3.14159265358979324) * radius * radius * radius; };
    const bool alike = p_.radii[order_.back()] == largest();
    double sum = 0;
    for (size_t i = 0; i < p_.count && !alike; ++i) sum += volume(p_.radii[i]);
    return alike ? double(p_.count) * volume(largest()) : sum;
  }

  /// Random sequential addition. It gives up where the free volume is too small to be found by chance.
  Placed one_by_one() {
    const bool is_round = p_.space.shape != Shape::box;
    const double volume = is_round ? p_.space.size() : edge_.x() * edge_.y() * edge_.z();
    // Random sequential addition saturates at 0.384.
    const bool apart = may_meet(world_, p_.first, p_.first);
    if (apart && volume_of_balls() > 0.36 * volume && p_.count > 8) return {};

    // Of the places in the box around a sphere nearly half lie outside.
    uint64_t tries = (10'000 + 40 * p_.count) * (is_round ? 2 : 1);

    BodyGrid grid(apart ? nullptr : &world_);
    grid.reserve(p_.count);
    Placed placed;
    placed.centers.resize(p_.count);

    const auto draw = [](Random& random) {
      // One call a statement, because the compiler chooses the order of evaluation inside an expression.
      Vec3 share;
      for (int k = 0; k < 3; ++k) share[k] = random.uniform();
      return share;
    };
    const auto at = [&](const Vec3& share, double radius) {
      const Vec3 low = p_.min.array() + radius, free = (edge_.array() - 2 * radius).max(0.0);
      return Vec3(low.array() + share.array() * free.array());
    };
    // Most of the time is spent waiting for memory. A copy of the random stream runs ahead and prefetches.
    constexpr uint64_t far = 16, near = 8;
    Random ahead = random_;
    array<Vec3, far> coming;
    for (Vec3& share : coming) share = draw(ahead);

    size_t done = 0;
    for (uint64_t next = 0; done < p_.count; ++next) {
      if (tries-- == 0) return {};
      const Entity ball = order_[done];
      const double radius = p_.radii[ball];
      const Vec3 center = at(draw(random_), radius);
      coming[next % far] = draw(ahead);
      grid.prefetch({at(coming[next % far], radius), radius, p_.first}, BodyGrid::Prefetch::cells);
      grid.prefetch({at(coming[(next + near) % far], radius), radius, p_.first}, BodyGrid::Prefetch::members);

      if (grid.find_overlap({center, radius, p_.first}) || !is_free(center, ball)) continue;
      grid.insert({center, radius, p_.first});
      placed.centers[ball] = center;
      ++done;
    }
    return placed;
  }

  /// The free sites of the widest spacing that has `count` of them. Fewer if even the tightest spacing has not enough.
  template <typename Sites>
  vector<Vec3> free_sites(double& spacing) const {
    // Find the widest spacing by bisection, ignoring obstructions.
    const double closest = 2 * largest();
    const auto count = double(p_.count);
    double wide = edge_.maxCoeff() * 2;
    spacing = closest;
    if (Sites(edge_, closest).capacity() >= count) {
      for (int i = 0; i < 100 && wide - spacing > 1e-14 * wide; ++i) {
        const double middle = spacing + (wide - spacing) / 2;
        (Sites(edge_, middle).capacity() >= count ? spacing : wide) = middle;
      }
    }
    // Then narrow it while sites are obstructed.
    const double most_sites = 64 * count + 1e6;
    vector<Vec3> best;
    for (double s = spacing;;) {
      vector<Vec3> sites;
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
      // With fewer free sites than balls, narrow by about the fourth root of the ratio.
      // The cube root, which the number of sites suggests, could overshoot.
      const double shrink = sqrt(sqrt(max<double>(1, double(best.size())) / count));
      s = max(closest, s * clamp(shrink, 0.5, 0.98));
      if (Sites(edge_, s).capacity() > most_sites) return best;
    }
  }

  template <typename Sites>
  Placed thin() const {
    double spacing = 0;
    const vector<Vec3> sites = free_sites<Sites>(spacing);
    Placed placed;
    if (sites.size() < p_.count) {
      placed.fit = sites.size();
      return placed;
    }
    // The k-th ball takes site floor(k * sites / count), computed without overflow.
    const uint64_t whole = sites.size() / p_.count, rest = sites.size() % p_.count;
    placed.centers.reserve(p_.count);
    for (uint64_t k = 0; k < p_.count; ++k) placed.centers.push_back(sites[k * whole + k * rest / p_.count]);
    return placed;
  }

  /// A random choice of close-packed sites.
  /// Each ball is displaced within the part of its site that no neighbour reaches.
  Placed jittered() const {
    double spacing = 0;
    vector<Vec3> sites = free_sites<Hexagonal>(spacing);
    // A narrow tube holds more balls one above the other than in layers that are shifted.
    if (sites.size() < p_.count && p_.space.shape != Shape::box) {
      double of_cells = 0;
      vector<Vec3> cells = free_sites<Lattice>(of_cells);
      if (cells.size() > sites.size()) spacing = of_cells, sites = std::move(cells);
    }

    Placed placed;
    if (sites.size() < p_.count) {
      placed.fit = sites.size();
      return placed;
    }
    // The displacement lies in a cube inside the sphere of half the gap.
    // Two neighbours that move towards one another then stay apart.
    const double half = max(0.0, (spacing / 2 - largest()) / root3 * (1 - 1e-9));
    const Vec3 low = p_.min.array() + largest(), high = p_.max.array() - largest();
    for (uint64_t k = 0; k < p_.count; ++k) {
      std::swap(sites[k], sites[k + random_.below(sites.size() - k)]);
      Vec3 moved = sites[k];
      for (int axis = 0; axis < 3; ++axis) {
        moved[axis] += (2 * random_.uniform() - 1) * half;
        moved[axis] = max(low[axis], min(high[axis], moved[axis]));
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
  vector<Entity> order_;  // balls, the largest first
};

}  // namespace

Placed place(const Placing& placing, const World& world, const BodyGrid& others, Random& random) {
  return Placer(placing, world, others, random).run();
}

}  // namespace carom
