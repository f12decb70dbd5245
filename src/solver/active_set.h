#pragma once
// Contact by a dual active set (Goldfarb & Idnani, Math. Programming 27 (1983) 1): rows that fall short are taken in
// one by one, those that would have to pull are let go, and the answer's energy only grows on the way. On orthogonal
// factors, in coordinates in which the motion sought is the nearest one, so that bodies of any masses keep their
// digits; then refined with residuals in twice as many digits (contact_island.h). Factors are kept for the next island.
#include <cstdint>
#include <span>
#include <vector>

#include "numerics/orthogonal_factors.h"
#include "solver/contact_island.h"

namespace carom {

class DualActiveSet {
 public:
  /// What an island's answer is like.
  struct Result {
    Judgement judgement;
    bool infeasible = false;  // some row can be kept by no motion that keeps those taken in before
  };

  /// From the rows with a guess, the greatest forces first.
  Result solve(const ContactIsland& island, ContactAnswer& answer);

  /// From the rows that pressed in the last island, of which row c is now row now[c], or gone(); the masses are the
  /// same.
  Result solve_again(const ContactIsland& island, std::span<const std::uint32_t> now, ContactAnswer& answer);
  static constexpr std::uint32_t gone() { return none; }

  /// Whether it has factors of a last island.
  bool has_factors() const { return factors_.columns() > 0; }
  /// They are of an island that is no more the last.
  void forget() { factors_.reset(0); }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  void prepare(const ContactIsland& island);
  Result finish(const ContactIsland& island, ContactAnswer& answer);
  void rebuild(const ContactIsland& island, const std::vector<std::uint32_t>& rows);
  bool append(const ContactIsland& island, std::uint32_t c);
  void drop(std::size_t place);
  void balance(const ContactIsland& island);
  void settle(const ContactIsland& island);
  bool drop_one_that_pulls(double tolerance);
  void run(const ContactIsland& island, ContactAnswer& answer);
  void take_in_violated(const ContactIsland& island);
  bool take_in(const ContactIsland& island, std::uint32_t c, double shortfall);
  double blocking(std::size_t& first) const;
  void refine(const ContactIsland& island, ContactAnswer& answer);
  std::uint32_t worst_after_refining(const ContactIsland& island, const ContactAnswer& answer, double& shortfall) const;
  void transform(const ContactIsland& island, std::uint32_t c);
  std::uint64_t signature() const;

  OrthogonalFactors factors_;
  std::vector<std::uint32_t> active_;             // rows, in the order of the factors
  std::vector<double> force_;                     // by active row, of a row of unit length
  std::vector<std::uint8_t> fixed_;               // by active row: bilateral, it stays
  std::vector<std::uint32_t> place_;              // by row: where it is in active_, or none
  std::vector<double> y_, free_;                  // 3 a body
  std::vector<std::uint8_t> aside_;               // by row: how often no motion was found that keeps it
  std::vector<double> row_, step_, work_, load_;  // scratch: a row in the factors' coordinates, ...
  ContactAnswer attempt_;                         // scratch
  double dependent_ = 0;                          // a row's tail under which it is spanned by others
  bool infeasible_ = false;
};

}  // namespace carom
