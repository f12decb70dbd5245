#pragma once
// Contact to within the rows' slack: conjugate gradients on the rows that press, which are found on the way (MPRGP:
// Dostal & Schoeberl, Comput. Optim. Appl. 30 (2005) 23). The unknowns are the forces of rows of unit length, so that
// the matrix has a unit diagonal and bodies of any masses weigh alike. It is never formed: its product with forces is
// what they do to the rows' motion. The potential x A x / 2 + c x only falls. Sweeps from row to row (projected
// Gauss-Seidel) are the way not taken: in what is nearly at rest they get nowhere.
#include <cstdint>
#include <vector>

#include "solver/contact_island.h"

namespace carom {

class ContactProjectedGradients {
 public:
  /// From the rows' guesses, all times one factor; no row is bilateral. The island must outlive this.
  void start(const ContactIsland& island);

  /// Goes on until the answer is as near as `accuracy` asks, or has cost about `most_cost` ns since start(). Whether it
  /// is.
  bool run(ContactAccuracy accuracy, double most_cost);

  /// Leaves the answer, once it is near enough: bodies move as the forces make them, to rounding. By how much targets
  /// differ of which it is the exact solution, as in Judgement.
  double finish(ContactAnswer& answer) const;

  /// Gives the rows of the island as a guess the forces found so far.
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
  /// The unknowns of four rows, and what goes with them.
  struct alignas(aligned) Forces {
    Four x, g;       // of a row of unit length, >= 0; and the gradient: how far the row is from its target
    Four direction;  // along which x is to fall,
    Four image;      // and A times it
    Four constant;   // g without forces
    Four slack;      // of a row of unit length
  };
  /// Forces to go to, and their gradient.
  struct alignas(aligned) Next {
    Four x, g;
  };
  /// What a pass over all rows adds up.
  struct Sums {
    double square = 0;                // of the direction
    double gp = 0, pap = 0;           // direction times gradient and times image
    double turn = 0;                  // where rows press, the next gradient times image
    bool feasible = true;             // no next force is negative
    double reduced = 0, chopped = 0;  // squares of the gradient: where rows press, as far as bounds let it; elsewhere
    double potential = 0;             // twice
    bool within_slack = true;
  };

  struct Place {
    std::size_t four, lane;
  };
  /// Where row c stands: side by side are rows from far apart, which mostly share no body.
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

  /// The same, in four parts.
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
  std::vector<double> inverse_mass_;      // by body; and one more, which nothing moves
  std::vector<Motion> moved_;             // by body: what the last forces whose gradient was found do to it,
  std::vector<Motion> turned_;            // and what the direction does
  double step_ = 0;                       // along the projected gradient
  double least_ = 0;                      // less is nothing
  double slack_energy_ = 0;               // twice that of rows off by the least slack
  std::vector<double> potential_;         // twice, by iteration
  std::size_t products_ = 0, reach_ = 0;  // with the matrix; the island's, 0: not looked for yet
  Sums sums_;
  bool fresh_ = false;  // the gradient and moved_ are those of x but for rounding, and the gradient does no work
};

}  // namespace carom
