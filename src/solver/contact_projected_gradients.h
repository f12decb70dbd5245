#pragma once
// Contact to within the rows' slack: conjugate gradients on the rows that press, which are found on the way (MPRGP:
// Dostal & Schoeberl, Comput. Optim. Appl. 30 (2005) 23). The unknowns are the forces of rows of unit length. The
// matrix then has a unit diagonal, and bodies of any masses have equal weight. It is never formed: its product with
// forces is their effect on the rows' motion. The potential x A x / 2 + c x only falls. Sweeps from row to row
// (projected Gauss-Seidel) were not chosen, because they make no progress where bodies are nearly at rest.
#include <cstdint>
#include <vector>

#include "solver/contact_island.h"

namespace carom {

class ContactProjectedGradients {
 public:
  /// Starts from the rows' guesses, all times one factor. No row may be bilateral. The island must outlive this object.
  void start(const ContactIsland& island);

  /// Continues until the solution has the required accuracy, or has cost about `most_cost` ns since start(). Returns
  /// whether it has the accuracy.
  bool run(ContactAccuracy accuracy, double most_cost);

  /// Stores the solution, once it is accurate enough. Bodies move as the forces imply, to rounding.
  /// Returns the change of the targets for which it is the exact solution, as in Judgement.
  double finish(ContactSolution& solution) const;

  /// Gives the island's rows the present forces as a guess.
  void guess(ContactIsland& island) const;

 private:
  static constexpr std::size_t width = 4;
  static constexpr std::size_t aligned = width * sizeof(double);  // bytes
  using Four = double __attribute__((vector_size(aligned)));

  struct alignas(aligned) Motion {
    Four u;  // x, y, z, 0
  };
  /// Four rows side by side. Lanes beyond the last row move nothing.
  struct alignas(aligned) Rows {
    Four normal[3];  // times the scale of rows (ContactIsland::Row)
    std::uint32_t a[width], b[width];
  };
  /// The unknowns of four rows, and related values.
  struct alignas(aligned) Forces {
    // The force of a row of unit length, >= 0, and the gradient: the row's distance from its target.
    Four x, g;
    Four direction;  // x falls along it
    Four image;      // A times the direction
    Four constant;   // g without forces
    Four slack;      // of a row of unit length
  };
  /// The next forces, and their gradient.
  struct alignas(aligned) Next {
    Four x, g;
  };
  /// Sums of a pass over all rows.
  struct Sums {
    double square = 0;       // of the direction
    double gp = 0, pap = 0;  // direction times gradient, and direction times image
    double turn = 0;         // over rows that press, the next gradient times image
    bool feasible = true;    // no next force is negative
    // Squares of the gradient: over rows that press, as far as bounds allow, and over the other rows.
    double reduced = 0, chopped = 0;
    double potential = 0;  // twice its value
    bool within_slack = true;
  };

  struct Place {
    std::size_t four, lane;
  };
  /// The place of row c. Rows side by side are far apart in number, so that they mostly share no body.
  Place place(std::size_t c) const { return {c % rows_.size(), c / rows_.size()}; }
  void take_rows();
  double norm();
  double find_next_gradient();
  bool moves_bodies(double xax, double xx) const;
  void scale_next(double else_by);
  void begin();
  bool iterate();
  void go_on_at_bounds(double step);
  void renew();
  bool gains_little();
  double cost() const;

  /// The same sums, in four parts.
  struct Parts;

  static void push(const Rows& rows, const Four& x, Motion* moved);
  static void find_rate(const Rows& rows, const Motion* moved, Four& rate);
  static void move_next(const Rows* rows, const Next* next, std::size_t count, const double* inverse_mass,
                        Motion* moved, std::size_t bodies);
  static void chop(const Rows* rows, Forces* forces, std::size_t count, const double* inverse_mass, Motion* turned,
                   std::size_t bodies, Sums& sums);
  static void find_image(const Rows* rows, Forces* forces, std::size_t count, const Motion* turned, Sums& sums);
  static void reach(const Forces& forces, double step, double least, Next& next);
  static void try_step(const Forces* forces, std::size_t count, double step, double least, Sums& sums);
  static double project(const Forces* forces, Next* next, std::size_t count, double step, double least);
  static void bend(const Forces* forces, Next* next, std::size_t count, double first, double step);
  static void take(const Rows& rows, Forces& forces, const Next& next, double turn, double per_step, double least,
                   Motion* turned, Parts& parts);
  static void take_all(const Rows* rows, Forces* forces, const Next* next, std::size_t count, double step, double turn,
                       double per_step, double least, const double* inverse_mass, Motion* turned, std::size_t bodies,
                       Sums& sums);

  const ContactIsland* island_ = nullptr;
  std::vector<Rows> rows_;
  std::vector<Forces> forces_;
  std::vector<Next> next_;
  std::vector<double> inverse_mass_;      // by body; and a last one that is immovable
  std::vector<Motion> moved_;             // by body: its motion by the last forces with a gradient
  std::vector<Motion> turned_;            // by body: its motion along the direction
  double step_ = 0;                       // along the projected gradient
  double least_ = 0;                      // smaller values are set to zero
  double slack_energy_ = 0;               // twice the energy of rows off by the least slack
  std::vector<double> potential_;         // twice its value, by iteration
  std::size_t products_ = 0, reach_ = 0;  // products with the matrix; the island's reach, 0: not computed
  Sums sums_;
  // The gradient and moved_ are those of x up to rounding, and the gradient does no work.
  bool fresh_ = false;
};

}  // namespace carom
