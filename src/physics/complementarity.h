#pragma once
// Frictionless contact among many bodies: of all motions that keep every pair apart, the one nearest to the free one
// (Gauss's principle of least constraint). With the forces p_c >= 0 along the normals n_c as unknowns this is the
// complementarity problem 0 <= p, N^T u' - target >= 0, p (N^T u' - target) = 0, u' = u + M^-1 N p. The motion u' is
// unique, the forces need not be.
#include <cstdint>
#include <limits>
#include <span>

#include "physics/vec3.h"

namespace carom {

/// Two bodies that may press on each other, by their place in the arrays; `b` none: something fixed.
struct PressedPair {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t a, b;
  Vec3 normal;        // unit, from a to b
  double target = 0;  // normal . (u_b - u_a) must not be less; in the unit of u
  double slack = 0;   // but for this much
  double force = 0;   // in: a guess; out: mass times the unit of u, along the normal, >= 0
};

/// Moves u (velocities or accelerations; in: free, out: allowed) of bodies with these inverse masses (1/kg) until no
/// pair falls short of its target by more than its slack. Conjugate gradients on the pairs that press, which are found
/// on the way: MPRGP (Dostal & Schoeberl, Comput. Optim. Appl. 30 (2005) 23). At most `iterations` of them; whether
/// that was enough.
bool press_apart(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<PressedPair> pairs, int iterations);

/// The same by factorising a matrix a dozen times: slower where the other is quick, but it gets there where bodies
/// press on one another nearly as often as they can move, as in a pile.
bool press_apart_directly(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<PressedPair> pairs);

/// A power of two: above the greatest of them, at most twice it.
double power_of_two_near(std::span<const double> values);

}  // namespace carom
