#pragma once
// Impacts of touching bodies at one instant, as one problem in rounds.
//
// A row is a pair that touches: two bodies, a body and a fixed thing, or a string that has reached its length. All rows
// that approach act in a round, with the velocities at its start. Rounds repeat until none approaches.
//
// - Rows that push a shared body to one side act together. Their compression is Moreau's projection on the motions that
//   no row forbids (Moreau, "Unilateral contact and dry friction in finite freedom dynamics", 1988, eq. 6.5). The
//   expansion adds e times each row's impulse of compression (Poisson). It makes no energy for e <= 1.
// - Of rows that push a body from opposite sides the faster goes first, and the others wait for the next round. At
//   equal speeds the one of smaller e does; with equal e both act together. A chain is then a sequence of impacts of
//   two, and the outcome is continuous in the velocities wherever opposed approaches differ.
// - Rows with e = 0 stay closed to the end, and their impulses open to revision: all with e = 0 is one projection.
// - Rods and taut strings are links. They act as parts of the bodies that they connect.
//
// Rounds may be endless. With e < 1 their limit is the projection of any late velocities on all touching rows, which
// then no longer changes from round to round. With e = 1 they end, if all rows can open at once (Vouga, Smith, Kaufman,
// Tamstorf & Grinspun, "All's well that ends well", ACM Trans. Graph. 36, 2017); else the same projection ends them.
//
// Rows are taken in an order of places, so that no number of a body or a row has an effect.

#include "numerics/compensated.h"
#include "numerics/vec3.h"
#include "simulate/tolerances.h"
#include "solver/contact_problem.h"
#include "std.h"

namespace carom {

class ImpactSet {
 public:
  static constexpr uint32_t fixed = ContactConstraint::fixed;

  enum class Kind : uint8_t {
    touching,  // it can be struck
    taut,      // a string that holds: a link until it slackens
    rod        // a link
  };
  struct Row {
    uint32_t a = 0;          // a body of the set
    uint32_t b = fixed;      // another one, or a fixed thing
    Vec3 normal;             // unit, from a to b; the two approach along it
    Vec3 place;              // m, rows are taken in the order of their places
    double surface = 0;      // m/s, of a fixed thing that moves, along the normal
    double restitution = 0;  // of the next round
    Kind kind = Kind::touching;
  };
  /// What a round does to a row.
  struct Impact {
    uint32_t row;
    double approach;    // m/s, before the round
    double separation;  // m/s, after it
    double impulse;     // N s, against the approach; of a row with e = 0 a later round may take some of it back
    double lost;        // J
  };

  /// `one_by_one`: rows with e > 0 that share a body act one after the other, the fastest first. That is another law.
  explicit ImpactSet(bool one_by_one = false) : one_by_one_(one_by_one) {}

  /// Adds a body and returns its number. mass: kg; v: m/s.
  uint32_t add_body(double mass, const Vec3& v);
  /// Adds a row and returns its number.
  uint32_t add_row(const Row& row);
  uint32_t bodies() const { return uint32_t(bodies_.size()); }
  uint32_t rows() const { return uint32_t(rows_.size()); }
  const Row& row(uint32_t c) const { return rows_[c]; }
  span<const uint32_t> rows_of(uint32_t body) const { return bodies_[body].rows; }
  void set_restitution(uint32_t c, double e) { rows_[c].restitution = e; }

  /// The impulse (N s) that a link has passed on so far; of a rod that was pushed, below 0.
  double pull(uint32_t c) const { return rows_[c].pull; }

  /// m/s.
  const Vec3& velocity(uint32_t body) const { return bodies_[body].v; }
  void set_velocity(uint32_t body, const Vec3& v);
  /// The speed at which a row closes (m/s).
  double approach(uint32_t c) const;
  /// Whether that is more than rounding of speeds, and the row is no link that holds.
  bool approaches(uint32_t c) const;

  /// One round of these rows, which approach. Returns the impacts of this round, by place.
  const vector<Impact>& strike(span<const uint32_t> approaching);
  /// The bodies with velocities that the last round has changed; some of them more than once.
  const vector<uint32_t>& changed() const { return changed_; }

  /// Whether some motion opens all rows at once. It keeps the lengths of rods, and lengthens no taut string.
  bool has_room() const;
  /// Whether it is time to look for the end of endless rounds. The caller adds all that touches before.
  bool may_be_endless() const { return endless_.most_struck >= endless_.next_check; }
  /// Ends the rounds, of which these rows would be the next, by their limit, if that is known. Returns the rows with an
  /// impulse; none: the rounds go on.
  const vector<Impact>& end_endless(span<const uint32_t> approaching);
  /// After the last round of many: removes what rounding has left of approaches.
  const vector<Impact>& finish();

  uint32_t rounds() const { return rounds_; }
  /// Whether rods, or strings that have been taut in this instant, take part.
  bool linked() const { return linked_; }
  /// Whether the rounds have been ended because some row cannot open.
  bool without_room() const { return endless_.without_room; }
  /// A body that two impacts of a round share, not both with e = 0. Rigid bodies alone leave the outcome open.
  struct OpenOutcome {
    uint32_t body;
    uint32_t row;
    uint32_t other;  // the second row
  };
  /// The first such body; none: the outcome is not open.
  const optional<OpenOutcome>& open_outcome() const { return open_outcome_; }
  /// Whether two of them pushed it from opposite sides at equal speeds.
  bool tied() const { return tied_; }
  /// That of all projections (contact_problem.h).
  const Certificate& certificate() const { return certificate_; }

 private:
  using Rows = vector<uint32_t>;
  struct Body {
    double mass;  // kg
    Vec3 v;       // m/s
    double top;   // m/s, its greatest speed in this instant
    double near;  // m/s, the greatest of what was solved together with it in this instant: the scale of its rounding
    Rows rows;
    uint32_t struck = 0;  // strikes in this instant
    double lost = 0;      // the sum of 1 - e of these
  };
  struct RowState : Row {
    bool holds = false;   // a link that does
    bool struck = false;  // since the last look for the end of endless rounds
    double open = 0;      // N s, the impulse of a row with e = 0 that stays closed
    double pull = 0;      // N s, what it has passed on as a link
  };
  /// Rows that act together, and the open rows and links connected with them.
  struct Together {
    Rows rows;
    Rows open;
    Rows links;
  };
  /// The nearest velocities (m/s), by body of the problem, and the impulses (N s), by row of it.
  struct Projection {
    Rows bodies;
    vector<Vec3> v;
    vector<double> impulse;
    Certificate certificate;
    size_t place_of(uint32_t body) const;
  };
  /// A sum of velocities in twice as many digits, by axis.
  using Sum3 = array<DoubleDouble, 3>;
  struct Endless {
    double sum = 0;           // of 1 - e over all impacts
    double sum_at_limit = 0;  // when the limit was first found
    vector<Vec3> limit;       // m/s, the last one
    uint32_t most_struck = 0;
    uint32_t next_check = exact_tolerance::many_strikes;
    bool ended = false;
    bool without_room = false;
  };

  /// The limit of endless rounds.
  struct Limit {
    Rows touching;
    Rows links;
    Projection reached;   // on these
    vector<Vec3> v;       // m/s, by body
    double away = 0;      // J, twice the energy of the change to it
    double greatest = 0;  // J, twice the energy of the greatest speeds of this instant
  };

  bool before(uint32_t c, uint32_t d) const;
  void sort(Rows& rows) const;
  double separation(uint32_t c) const;
  double speeds_near(uint32_t c) const;
  void share_rounding(const Projection& solved);
  Rows links_at(span<const uint32_t> rows) const;
  Projection project(Rows rows, span<const uint32_t> links, const vector<Vec3>& v, bool relative = false,
                     double target = 0) const;
  vector<Vec3> velocities() const;
  double cosine(uint32_t c, uint32_t d, const Projection* response) const;
  Projection response(uint32_t c, span<const uint32_t> links) const;
  Rows select(span<const uint32_t> approaching);
  bool waits(uint32_t c, const vector<uint8_t>& approaches);
  vector<Together> connect(span<const uint32_t> acting, bool through_open) const;
  void strike_together(const Together& set);
  void strike_one(uint32_t c);
  void strike_inelastic(const Together& set);
  vector<Sum3> expansion(const Rows& rows, const Projection& compressed) const;
  void slacken(const Rows& links, const Projection& compressed);
  double allowed_share(const Projection& compressed, const vector<Vec3>& dv) const;
  vector<Vec3> expand_alike(const Projection& compressed, double e) const;
  vector<Vec3> expand_each(const Together& set, const Projection& compressed, double& share);
  void strike_elastic(const Together& set);
  void change(uint32_t body, const Vec3& v);
  void note(uint32_t c, double impulse, double approach, double separation);
  void share_losses(const Rows& bodies, size_t first);
  void count();
  pair<Rows, Rows> touching_and_links() const;
  bool has_room(const Rows& rows, const Rows& links) const;
  double distance(const vector<Vec3>& from, const vector<Vec3>& to) const;
  Limit find_limit();
  void end_by(const Limit& limit);
  void close_parted();

  vector<Body> bodies_;
  vector<RowState> rows_;
  vector<Impact> impacts_;  // of the last round
  Rows changed_;            // in the last round
  vector<Vec3> next_;       // m/s, by body, after this round
  Endless endless_;
  uint32_t rounds_ = 0;
  bool linked_ = false;  // it has links
  const bool one_by_one_;
  optional<OpenOutcome> open_outcome_;
  bool tied_ = false;
  Certificate certificate_;
};

}  // namespace carom
