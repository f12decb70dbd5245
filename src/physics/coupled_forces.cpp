// Sums over springs and over pairs that attract each other. Pair sums run over contiguous coordinates, one attracting
// body after the other, so that the compiler can take several attracted ones at a time without changing the order of
// any sum.
#include "physics/coupled_forces.h"

#include <numeric>

#include "numerics/compensated.h"
#include "physics/body_now.h"
#include "physics/closed_motion.h"
#include "physics/world.h"

namespace carom {

void CoupledForces::add(const BodySpring& spring, uint32_t a, uint32_t b) {
  springs_.push_back({a, b, spring});
}

void CoupledForces::add(const Gravitation& law, vector<uint32_t> of, vector<double> masses) {
  if (of.size() < 2) return;
  gravities_.push_back({law, std::move(of), std::move(masses)});
  gravities_.back().law.on.clear();
}

namespace {

/// Adds the attraction by a body at (m) of this strength (m^3/s^2) to the bodies `from` to `to` - 1 of n. `places`: m,
/// all x, then all y and all z; `fields`: m/s^2, the same.
void attract(const vector<double>& places, vector<double>& fields, size_t from, size_t to, const Vec3& at,
             double strength, double soft) {
  const size_t n = places.size() / 3;
  const double* __restrict x = &places[0];
  const double* __restrict y = &places[n];
  const double* __restrict z = &places[2 * n];
  double* __restrict ax = &fields[0];
  double* __restrict ay = &fields[n];
  double* __restrict az = &fields[2 * n];
  const double x0 = at.x();
  const double y0 = at.y();
  const double z0 = at.z();

  for (size_t i = from; i < to; ++i) {
    const double dx = x0 - x[i];
    const double dy = y0 - y[i];
    const double dz = z0 - z[i];
    const double square = dx * dx + dy * dy + dz * dz + soft;
    const double factor = strength / (square * sqrt(square));
    ax[i] += factor * dx;
    ay[i] += factor * dy;
    az[i] += factor * dz;
  }
}

/// Adds the accelerations by springs. Roots and quotients of several are computed at a time: one by one they would take
/// most of a step. The numbers are those of BodySpring::force.
template <typename Springs>
void accelerate_by_springs(const Springs& springs, span<const double> inverse_mass, span<const Vec3> x,
                           span<const Vec3> v, vector<Vec3>& a) {
  constexpr size_t block = 64;
  array<double, block> squared, moving, stiffness, rest, damping, factor;
  array<Vec3, block> d;

  for (size_t first = 0; first < springs.size(); first += block) {
    const size_t count = min(block, springs.size() - first);
    for (size_t k = 0; k < count; ++k) {
      const auto& [i, j, law] = springs[first + k];
      d[k] = x[j] - x[i];
      squared[k] = d[k].squaredNorm();
      moving[k] = law.damping == 0 ? 0 : d[k].dot(v[j] - v[i]);
      stiffness[k] = law.stiffness;
      rest[k] = law.rest_length;
      damping[k] = law.damping;
    }

    for (size_t k = 0; k < count; ++k) {
      const double length = sqrt(squared[k]);
      factor[k] = (stiffness[k] * (rest[k] - length) - damping[k] / length * moving[k]) / length;
    }

    for (size_t k = 0; k < count; ++k) {
      const auto& [i, j, law] = springs[first + k];
      const bool plain = !law.is_smooth() && squared[k] > 0;
      const Vec3 force = plain ? Vec3(factor[k] * d[k]) : law.force(d[k], v[j] - v[i]);
      a[i] -= inverse_mass[i] * force;
      a[j] += inverse_mass[j] * force;
    }
  }
}

}  // namespace

/// The accelerations (m/s^2) of the bodies as if each weighed as much as it attracts: all x, then all y and all z.
vector<double> CoupledForces::fields(const Gravity& of, Bodies x) {
  const size_t n = of.bodies.size();
  vector<double> places(3 * n);
  vector<double> fields(3 * n, 0);
  for (size_t k = 0; k < n; ++k)
    for (size_t axis = 0; axis < 3; ++axis) places[axis * n + k] = x[of.bodies[k]][Eigen::Index(axis)];

  const double soft = of.law.softening * of.law.softening;
  for (size_t k = 0; k < n; ++k) {
    const double strength = of.law.constant * of.masses[k];
    if (strength == 0) continue;
    attract(places, fields, 0, k, x[of.bodies[k]], strength, soft);
    attract(places, fields, k + 1, n, x[of.bodies[k]], strength, soft);
  }
  return fields;
}

void CoupledForces::accelerate(span<const double> inverse_mass, Bodies x, Bodies v, vector<Vec3>& a) const {
  accelerate_by_springs(springs_, inverse_mass, x, v, a);

  for (const Gravity& of : gravities_) {
    const size_t n = of.bodies.size();
    const vector<double> field = fields(of, x);
    for (size_t k = 0; k < n; ++k) {
      const double share = of.masses[k] * inverse_mass[of.bodies[k]];
      a[of.bodies[k]] += share * Vec3(field[k], field[n + k], field[2 * n + k]);
    }
  }
}

CoupledForces::Shares CoupledForces::potential(Bodies x) const {
  Sum springs;
  for (const auto& [i, j, law] : springs_) springs.add(law.potential(x[j] - x[i]));

  Sum gravitation;
  for (const Gravity& of : gravities_) {
    if (!of.law.acts_for_ever()) continue;
    for (size_t k = 0; k < of.bodies.size(); ++k)
      for (size_t m = 0; m < k; ++m)
        gravitation.add(of.law.potential(of.masses[k] * of.masses[m], x[of.bodies[k]] - x[of.bodies[m]]));
  }
  return {springs.value(), gravitation.value()};
}

bool CoupledForces::works() const {
  const auto drains = [](const Ends& of) { return of.law.damping != 0 || !of.law.acts_for_ever(); };
  const auto is_passing = [](const Gravity& of) { return !of.law.acts_for_ever(); };
  return any_of(springs_, drains) || any_of(gravities_, is_passing);
}

CoupledForces::Shares CoupledForces::power(Bodies x, Bodies v) const {
  Shares power;
  for (const auto& [i, j, law] : springs_) {
    const Vec3 w = v[j] - v[i];
    power.springs += law.drain(x[j] - x[i], w).dot(w);
  }

  for (const Gravity& of : gravities_) {
    if (of.law.acts_for_ever()) continue;
    const size_t n = of.bodies.size();
    const vector<double> field = fields(of, x);
    for (size_t k = 0; k < n; ++k)
      power.gravitation += of.masses[k] * v[of.bodies[k]].dot(Vec3(field[k], field[n + k], field[2 * n + k]));
  }
  return power;
}

namespace {

/// Takes a pair's force, which changes by `slope` (N/m) over `reach` (m).
struct TakeScales {
  span<const double> inverse_mass;
  span<const double> roundings;
  vector<CoupledForces::Scale>& scales;

  void operator()(uint32_t i, uint32_t j, double force, double slope, double damping, double reach) const {
    const double inverse = inverse_mass[i] + inverse_mass[j];
    const double swing = sqrt(slope * inverse);  // 1/s
    const double rate = swing + damping * inverse;
    const double rounding = roundings[i] + roundings[j];
    for (const uint32_t k : {i, j}) {
      CoupledForces::Scale& of = scales[k];
      of.reach = min(of.reach, reach);
      of.rate = max(of.rate, rate);
      if (swing > 0) of.rounded = max(of.rounded, slope * inverse_mass[k] * rounding / swing);
      of.strongest = max(of.strongest, force * inverse_mass[k]);
    }
  }
};

}  // namespace

vector<CoupledForces::Scale> CoupledForces::scales(span<const double> inverse_mass, Bodies x, Bodies v,
                                                   span<const double> roundings) const {
  vector<Scale> scales(x.size());
  const TakeScales take{inverse_mass, roundings, scales};

  for (const auto& [i, j, law] : springs_) {
    const Vec3 d = x[j] - x[i];
    const double length = d.norm();
    // Across the spring its force turns.
    const double turns = length > 0 ? std::abs(law.rest_length - length) / length : 1;
    take(i, j, law.force(d, v[j] - v[i]).norm(), law.stiffness * max(1.0, min(turns, 16.0)), law.damping,
         law.is_smooth() ? infinity : length);
  }

  for (const Gravity& of : gravities_) {
    const double soft = of.law.softening * of.law.softening;
    for (size_t k = 0; k < of.bodies.size(); ++k)
      for (size_t m = 0; m < k; ++m) {
        const uint32_t i = of.bodies[m];
        const uint32_t j = of.bodies[k];
        const double square = (x[j] - x[i]).squaredNorm() + soft;
        const double distance = sqrt(square);
        const double strength = of.law.constant * of.masses[k] * of.masses[m];  // N m^2
        const double force = std::abs(strength) / square;
        take(i, j, force, 2 * force / distance, 0, distance);

        // An error of a speed here is a larger share of the speed far away.
        const double kinetic = 0.5 * (v[j] - v[i]).squaredNorm() / (inverse_mass[i] + inverse_mass[j]);
        if (!(strength > 0 && kinetic > 0)) continue;
        const double left = min(std::abs(kinetic - strength / distance) / kinetic, 1.0);
        scales[i].left = min(scales[i].left, left);
        scales[j].left = min(scales[j].left, left);
      }
  }
  return scales;
}

double CoupledForces::longest_step(Bodies x, Bodies v, Bodies a) const {
  double longest = infinity;
  const auto take = [&](uint32_t i, uint32_t j, double reach) {
    const double time = step_within(reach, (v[j] - v[i]).norm(), (a[j] - a[i]).norm());
    if (time > 0) longest = min(longest, time);
  };

  for (const auto& [i, j, law] : springs_)
    if (!law.is_smooth()) take(i, j, (x[j] - x[i]).norm());
  for (const Gravity& of : gravities_) {
    const double soft = of.law.softening * of.law.softening;
    for (size_t k = 0; k < of.bodies.size(); ++k)
      for (size_t m = 0; m < k; ++m)
        take(of.bodies[m], of.bodies[k], sqrt((x[of.bodies[k]] - x[of.bodies[m]]).squaredNorm() + soft));
  }
  return longest;
}

bool has_couplings(const World& world) {
  return !world.springs.empty() || !world.gravitations.empty();
}

CoupledForces coupled_forces(const World& world, const State& state) {
  CoupledForces forces;
  const auto body_of = [&](Entity i) { return state.part_of.empty() ? i : state.part_of[i]; };

  for (const BodySpring& spring : world.springs) {
    const Entity a = body_of(spring.a);
    const Entity b = body_of(spring.b);
    if (spring.acts(state.time) && a != b && a != no_entity && b != no_entity) forces.add(spring, a, b);
  }

  for (const Gravitation& law : world.gravitations) {
    if (!law.acts(state.time)) continue;
    vector<double> masses(world.body_count(), 0);
    vector<Entity> on = law.on;
    if (on.empty()) {
      on.resize(world.body_count());
      std::iota(on.begin(), on.end(), Entity{0});
    }
    for (const Entity i : on)
      if (const Entity whole = body_of(i); whole != no_entity) masses[whole] += world.mass[i];

    vector<uint32_t> of;
    vector<double> of_these;
    for (Entity i = 0; i < world.body_count(); ++i) {
      if (masses[i] == 0) continue;
      of.push_back(i);
      of_these.push_back(masses[i]);
    }
    forces.add(law, std::move(of), std::move(of_these));
  }
  return forces;
}

vector<Vec3> coupled_accelerations(const World& world, const State& state) {
  vector<Vec3> a(world.body_count(), Vec3::Zero());
  if (!has_couplings(world)) return a;
  vector<double> inverse_mass(world.body_count());
  for (Entity i = 0; i < world.body_count(); ++i) {
    const double mass = mass_now(world, state, i);
    inverse_mass[i] = mass > 0 ? 1 / mass : 0;
  }
  coupled_forces(world, state).accelerate(inverse_mass, state.position, state.velocity, a);
  return a;
}

}  // namespace carom
