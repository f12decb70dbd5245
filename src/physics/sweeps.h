#pragma once
// The problem of contact_problem.h, roughly and at once: pair after pair, there and back again, is given the force that
// it alone needs (projected Gauss-Seidel), and between two sweeps all go on along the direction in which they went, as
// in conjugate gradients (Silcowitz, Niebe & Erleben, Visual Computer 26 (2010) 893). From the forces of a moment ago a
// few sweeps are enough for bodies in motion; solve gets nearer to the answer.
#include <span>
#include <vector>

#include "physics/contact_problem.h"

namespace carom {

class Sweeps {
 public:
  /// Moves u towards the motion that solve finds, in at most `sweeps` of all pairs; fewer once two of them
  /// have found no pair off by more than its slack. Whether that was so. The forces given are a guess; one that is
  /// still bad after all sweeps is forgotten, so that where no pair has a target kinetic energy never grows.
  bool solve(std::span<const double> inverse_mass, std::span<Vec3> u, std::span<ContactConstraint> pairs, int sweeps);

 private:
  static constexpr std::size_t width = 4;
  static constexpr std::size_t aligned = width * sizeof(double);  // bytes
  using Four = double __attribute__((vector_size(aligned)));

  struct alignas(aligned) Motion {
    Four u;  // x, y, z, 0
  };

  /// Pairs that share no body, for which it does not matter which comes first: their forces are found side by side.
  struct alignas(aligned) Batch {
    Four normal[3];
    Four per_rate;    // kg: the force that makes a difference of 1 in the rate
    Four of_a, of_b;  // 1/kg,
    Four of_all;      // and their sum
    Four target;      // as ContactConstraint's,
    Four slack;       // kg times the unit of u: what a force may change by yet
    Four force;
    std::uint32_t a[width], b[width];
  };

  /// By batch, from one sweep to the next.
  struct alignas(aligned) Trend {
    Four before;  // the forces
    Four along;   // the direction in which they went
  };

  void arrange(std::span<const double> inverse_mass, std::span<const ContactConstraint> pairs);
  void start(std::span<const Vec3> u, std::span<const ContactConstraint> pairs, bool guess);
  double potential(std::span<const Vec3> u, std::span<const ContactConstraint> pairs) const;
  static void push(const Batch& row, const Four& change, Motion* motions);
  static double sweep(Batch* batches, std::size_t count, Motion* motions, bool back);
  static double measure(const Batch* batches, std::size_t count, const Trend* trends);
  static void go_on(Batch* batches, std::size_t count, Trend* trends, Motion* motions, double turn);

  std::vector<Batch> batches_;
  std::vector<Trend> trends_;
  std::vector<std::uint32_t> place_;  // by pair: width times its batch, and its lane
  std::vector<std::uint64_t> in_;     // by body: the open batches that it is in, a bit each
  std::vector<std::uint8_t> filled_;  // by batch: lanes in use
  std::vector<Motion> motions_;       // by body; and one more, which nothing moves
};

}  // namespace carom
