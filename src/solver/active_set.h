#pragma once
// Contact by a dual active set (Goldfarb & Idnani, Math. Programming 27 (1983) 1). Violated rows are appended one by
// one, rows that would have to pull are removed, and the solution's energy only grows. The factors are orthogonal, in
// coordinates in which the solution is the nearest motion, so that bodies of any masses keep their digits. Residuals in
// twice as many digits then refine the solution (contact_island.h). The factors are kept for the next island.

#include "numerics/orthogonal_factors.h"
#include "solver/contact_island.h"
#include "std.h"

namespace carom {

class DualActiveSet {
 public:
  /// The quality of an island's solution.
  struct Result {
    Judgement judgement;
    // Some row is violated by every motion that satisfies the rows appended before it.
    bool infeasible = false;
  };

  /// Starts from the rows with a guess, the greatest forces first.
  Result solve(const ContactIsland& island, ContactSolution& solution);

  /// Starts from the rows that pressed in the last island. Its row c is row now[c] of this island, or gone(). The
  /// masses must be the same.
  Result solve_again(const ContactIsland& island, span<const uint32_t> now, ContactSolution& solution);
  static constexpr uint32_t gone() { return none; }

  /// Whether it holds the factors of a last island.
  bool has_factors() const { return factors_.columns() > 0; }
  /// Discards the factors, when their island is not the last one.
  void clear() { factors_.reset(0); }

 private:
  static constexpr uint32_t none = ~uint32_t{0};

  void prepare(const ContactIsland& island);
  Result finish(const ContactIsland& island, ContactSolution& solution);
  void rebuild(const ContactIsland& island, const vector<uint32_t>& rows);
  bool append(const ContactIsland& island, uint32_t c);
  void drop(size_t place);
  void balance(const ContactIsland& island);
  void settle(const ContactIsland& island);
  bool drop_one_that_pulls(double tolerance);
  void run(const ContactIsland& island, ContactSolution& solution);
  void take_in_violated(const ContactIsland& island);
  bool activate(const ContactIsland& island, uint32_t c, double shortfall);
  double blocking(size_t& first) const;
  void refine(const ContactIsland& island, ContactSolution& solution);
  uint32_t worst_after_refining(const ContactIsland& island, const ContactSolution& solution, double& shortfall) const;
  void transform(const ContactIsland& island, uint32_t c);
  uint64_t signature() const;

  OrthogonalFactors factors_;
  vector<uint32_t> active_;                  // rows, in the order of the factors
  vector<double> force_;                     // by active row, for a row of unit length
  vector<uint8_t> fixed_;                    // by active row: bilateral, it stays
  vector<uint32_t> place_;                   // by row: its index in active_, or none
  vector<double> y_, free_;                  // 3 for each body
  vector<uint8_t> aside_;                    // by row: number of times that no motion satisfied it
  vector<double> row_, step_, work_, load_;  // scratch: a row in the factors' coordinates, and others
  ContactSolution attempt_;                  // scratch
  double dependent_ = 0;                     // a row with a smaller tail depends on the others
  bool infeasible_ = false;
};

}  // namespace carom
