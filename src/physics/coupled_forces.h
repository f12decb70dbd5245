#pragma once
// Forces between bodies that fly as one system: springs between two, and gravitation among many. Bodies have numbers of
// the system. All sums follow one order. Springs cost their number, gravitation the number of its pairs.
#include "physics/body_spring.h"
#include "physics/gravitation.h"
#include "physics/state.h"
#include "std.h"

namespace carom {

struct World;

class CoupledForces {
 public:
  using Bodies = span<const Vec3>;

  /// Adds a spring between two bodies of the system.
  void add(const BodySpring& spring, uint32_t a, uint32_t b);
  /// Adds gravitation among some, which attract by these masses (kg).
  void add(const Gravitation& law, vector<uint32_t> of, vector<double> masses);
  bool any() const { return !springs_.empty() || !gravities_.empty(); }

  /// Calls link(a, b) for pairs that connect all that these forces connect.
  template <typename Link>
  void for_each_link(Link link) const {
    for (const Ends& of : springs_) link(of.a, of.b);
    for (const Gravity& of : gravities_)
      for (size_t k = 1; k < of.bodies.size(); ++k) link(of.bodies[0], of.bodies[k]);
  }
  /// The same for springs alone.
  template <typename Link>
  void for_each_spring(Link link) const {
    for (const Ends& of : springs_) link(of.a, of.b);
  }

  // x: m, v: m/s, inverse_mass: 1/kg, by body.
  /// Adds the accelerations to a (m/s^2).
  void accelerate(span<const double> inverse_mass, Bodies x, Bodies v, vector<Vec3>& a) const;
  /// What springs and gravitation have of a quantity.
  struct Shares {
    double springs = 0;
    double gravitation = 0;

    double sum() const { return springs + gravitation; }
  };
  /// The potential energy (J) of the forces that act for ever.
  Shares potential(Bodies x) const;
  /// Whether some have a part without potential, and the power (W) of that part.
  bool works() const;
  Shares power(Bodies x, Bodies v) const;

  /// What the steps of a method must follow at one body.
  struct Scale {
    double reach = infinity;  // m, within which its forces are smooth
    double rate = 0;          // 1/s, at which the fastest of them swings it
    double left = 1;          // of the kinetic energy that it has with another one: what is left of it far apart
    double rounded = 0;       // m/s: speed that the rounding of places makes
    double strongest = 0;     // m/s^2, by one of the forces
  };
  /// roundings: m, of places, by body.
  vector<Scale> scales(span<const double> inverse_mass, Bodies x, Bodies v, span<const double> roundings) const;
  /// The longest step (s) in which no two come to more than half of their way to each other.
  double longest_step(Bodies x, Bodies v, Bodies a) const;

  void keep(auto& archive) { archive(springs_, gravities_); }

 private:
  struct Ends {
    uint32_t a = 0;
    uint32_t b = 0;
    BodySpring law;

    void keep(auto& archive) { archive(a, b, law.stiffness, law.rest_length, law.damping, law.from, law.until); }
  };
  struct Gravity {
    Gravitation law;
    vector<uint32_t> bodies;
    vector<double> masses;  // kg

    void keep(auto& archive) { archive(law.constant, law.softening, law.from, law.until, bodies, masses); }
  };

  static vector<double> fields(const Gravity& of, Bodies x);

  vector<Ends> springs_;
  vector<Gravity> gravities_;
};

/// The forces between bodies at the state's time. Numbers are those of bodies. Parts of merged bodies are no ends: the
/// body that represents them is.
CoupledForces coupled_forces(const World& world, const State& state);
/// The accelerations by these (m/s^2), by body.
vector<Vec3> coupled_accelerations(const World& world, const State& state);
/// Whether there are such forces at some time.
bool has_couplings(const World& world);

}  // namespace carom
