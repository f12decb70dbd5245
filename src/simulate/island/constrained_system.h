#pragma once
// Bodies that press on each other and on fixed things. While the set of closed contacts stays the same, their motion is
// smooth. Forces keep pressing pairs in contact: 0 <= force, 0 <= the gap's second derivative, and one of them is zero.
// The second derivative includes the surfaces' curvature. A method of order 8 follows the motion (dormand_prince.h).
// Contacts open when their force ends, and pass to the next feature at a rim. These instants are found on the method's
// dense output, and a step ends there. (Event-driven integration: Acary & Brogliato, Numerical Methods for Nonsmooth
// Dynamical Systems, 2008, ch. 8.) Openings are visible without the forces, which need not be unique: some gap grows
// under the accelerations that contacts allow.

#include "geometry/touch.h"
#include "numerics/dense_motion.h"
#include "numerics/dormand_prince.h"
#include "physics/coupled_forces.h"
#include "simulate/contact/contact_impulses.h"
#include "simulate/contact/contact_list.h"
#include "solver/contact_problem.h"
#include "std.h"

namespace carom {

class ConstrainedSystem {
 public:
  /// The effect of forces on a member: m/s^2, at its position; 1/s, the decay rate of its velocity by linear drag.
  struct Applied {
    Vec3 at_rest;
    double fade;
    bool bent;  // the forces have no closed form
    // Of a joint body whose forces are bent: its parts, and their shares of its mass.
    vector<pair<Entity, double>> parts{};

    void keep(auto& archive) { archive(at_rest, fade, bent, parts); }
  };
  /// members: bodies, ascending. applied: by member, from `time` (s) on. `world` must outlive this object. step_error:
  /// of a step, and of parabolas on curved surfaces, as a share of the least radius and of speeds.
  ConstrainedSystem(const World& world, double time, vector<Entity> members, vector<Applied> applied,
                    double step_error);

  /// To be restored: then it has what work() and add_impulses() need.
  explicit ConstrainedSystem(const World& world) : ConstrainedSystem(world, 0, {}, {}, 0) {}

  /// Adds a contact between two members, or of a member and a fixed thing, with its normal. A bilateral one never
  /// opens.
  /// `guess`: of its force (N).
  void add(const Contact& contact, const ContactConstraint& pair, double guess);
  /// Registers a fixed thing that moves, at its position (m) and velocity (m/s) at the start, before contacts with it
  /// are added.
  void add_moving(Entity e, const Vec3& x, const Vec3& v);
  /// Sets the forces between members, which have those numbers.
  void couple(CoupledForces forces) { couplings_ = std::move(forces); }
  /// Whether one of them swings: no motion in contact with it is a parabola.
  bool any_swings() const {
    return any_of(carriers_, [](const Carrier& carrier) { return carrier.rate > 0; });
  }
  /// Whether such things, or such forces, do work on the members.
  bool works() const { return !carriers_.empty() || couplings_.any(); }
  /// Leaves member number k out of that work, because it does not take part in the motion.
  void leave_out(size_t k) { left_[k] = 1; }
  /// Their work (J) in the first `length` (s) of a motion that was followed. Forces change as they did then.
  double work(const DenseMotion& motion, double length) const;
  /// Calls take(impulse) for each contact of members that are not left out, with its impulse between two times (s) of
  /// such a motion. Of a rod it is that of the force's magnitude.
  void add_impulses(const DenseMotion& motion, double from, double to, const WorkingPath::Take& take) const;
  /// The work (J) in that time of the forces between members without a potential, and what their potential loses (J).
  struct Exchanged {
    CoupledForces::Shares work;
    double released = 0;
  };
  Exchanged exchanged(const DenseMotion& motion, double length) const;
  bool has_carriers() const { return !carriers_.empty(); }
  bool is_coupled() const { return couplings_.any(); }
  /// Opens the closed contacts that are marked in `which`. From then on they are watched, and not followed.
  void open_contacts(const vector<uint8_t>& which);

  /// Accelerations (m/s^2) by member at x (m) and v (m/s): the nearest to the applied ones for which closed contacts do
  /// not approach, n . (a_b - a_a) >= -bending. Afterwards the rows hold the forces, the normals and the bending.
  /// `least`: where the motion leaves forces open, they are the least ones.
  vector<Vec3> accelerate(const vector<Vec3>& x, const vector<Vec3>& v, bool least = false);
  /// The second derivative of closed contact c's gap (m/s^2), for accelerations a.
  double gap_acceleration(size_t c, const vector<Vec3>& a) const;

  /// The scales of the motion.
  struct Scales {
    double length = never;    // m, the least radius
    double acceleration = 0;  // m/s^2, the greatest by a force or by the surfaces' curvature
    double speed = 0;         // m/s, the greatest relative to what members touch, or that of falling by a radius
    double opening = 0;       // m/s^2, a greater acceleration of a gap is more than rounding
    double time() const { return speed > 0 ? length / speed : never; }  // s
  };
  Scales scales(const vector<Vec3>& x, const vector<Vec3>& v) const;

  /// The decay rate by linear drag (1/s), if it is the same for all members; otherwise -1.
  double common_fade() const;
  /// The time (s) for which all members move along parabolas, or along paths that a common drag bends.
  /// They start at x (m) with velocities v (m/s) and accelerations a (m/s^2). The forces are those of the last
  /// accelerate().
  double straight_time(const vector<Vec3>& x, const vector<Vec3>& v, const vector<Vec3>& a) const;

  /// The motion from there on until a change, or for `longest` (s).
  struct Followed {
    unique_ptr<DenseMotion> motion;
    double next = 0;       // s, a good length for the next step
    bool changes = false;  // it ends where a contact opens, closes or reaches a rim
    // Bodies have a speed, but longer steps than those that move them by less than their rounding were rejected.
    bool stuck = false;
  };
  /// The forces are those of the last accelerate(). first: a guess of the step (s), or 0.
  Followed follow(const vector<Vec3>& x, const vector<Vec3>& v, const vector<Vec3>& a, double first, double longest);

  const vector<ContactConstraint>& rows() const { return rows_; }  // of closed contacts
  const Certificate& certificate() const { return certificate_; }

  void keep(auto& archive) {
    archive(time_, members_, applied_, inverse_mass_, couplings_, carriers_, left_, closed_, held_);
  }

 private:
  /// A fixed thing that moves. In a motion that is followed it is one more point, after the members. Where it swings,
  /// its acceleration is -rate^2 (x - middle).
  struct Carrier {
    Entity thing;
    Vec3 x;                      // m, at the start
    Vec3 v;                      // m/s, at the start
    double rate = 0;             // rad/s
    double greatest = 0;         // m/s^2, its acceleration at most
    Vec3 middle = Vec3::Zero();  // m

    Vec3 acceleration(const Vec3& at) const { return -(rate * rate) * (at - middle); }

    void keep(auto& archive) { archive(thing, x, v, rate, greatest, middle); }
  };

  /// The errors of a step that are allowed: of positions (m) and of velocities (m/s).
  struct Allowed {
    double place;  // m
    double speed;  // m/s
    // By point, where forces act between members. One that is far away or fast then leaves the others their digits.
    vector<double> places{};
    vector<double> speeds{};
  };

  const Carrier* carrier_of(Entity e) const;
  size_t place_of_carrier(const Carrier& carrier) const {
    return members_.size() + size_t(&carrier - carriers_.data());
  }
  const Carrier* carrier_of(const ContactConstraint& row, Entity e) const {
    return row.b == ContactConstraint::fixed ? carrier_of(e) : nullptr;
  }
  double greatest_swing() const;
  double to_extreme() const;
  vector<Vec3> with_carriers(vector<Vec3> of_members, Vec3 Carrier::*of_carrier) const;
  Vec3 relative_velocity(const vector<Vec3>& v, const ContactConstraint& row, Entity e) const;
  Vec3 moved(const DenseMotion& motion, const vector<Vec3>& x, const ContactConstraint& row, Entity e) const;
  double relative_speed(const vector<Vec3>& v) const;
  vector<double> place_roundings(const vector<Vec3>& x, const vector<Vec3>& v, const vector<Vec3>& a) const;
  double distance_rounding(const vector<double>& of_places, const ContactConstraint& row, Entity e) const;
  double reaction(const ContactConstraint& row) const;
  double turning_time(double load, double bend, double w, double a, double rounding) const;
  Allowed allowed_errors(const vector<Vec3>& x, const vector<Vec3>& v, const vector<Vec3>& a) const;
  void allow_each(const vector<Vec3>& x, const vector<Vec3>& v, const vector<Vec3>& a, Allowed& allowed) const;
  vector<double> own_speeds(const vector<Vec3>& v) const;
  Vec3 common_velocity(const vector<Vec3>& v) const;
  double within_reach(const vector<Vec3>& x, const vector<Vec3>& v, const vector<Vec3>& a) const;
  vector<Vec3> forces_at(const vector<Vec3>& x, const vector<Vec3>& v) const;
  bool any_bent() const;
  bool add_integrals(const DenseMotion& motion, double from, double to, vector<double>& sums) const;
  Vec3 place_of(const vector<Vec3>& x, uint32_t b, Entity e) const;
  Followed follow_smooth(const vector<Vec3>& x, const vector<Vec3>& v, const vector<Vec3>& a, double h);
  double error_between(const DenseMotion& motion, const DormandPrince::Acceleration& forces) const;
  void check_clock(double length) const;
  Followed follow_stiff(const vector<Vec3>& x, const vector<Vec3>& v, double h);
  double greatest_fade() const;
  void allow_contradictions(const vector<Vec3>& a, vector<ContactConstraint>& rows) const;
  vector<Vec3> solve_rows(const vector<Vec3>& x, const vector<Vec3>& v, vector<ContactConstraint>& rows,
                          Certificate& certificate, bool least = false) const;
  static bool moves(const DenseMotion& motion);
  double opens(const DenseMotion& motion, double t);
  double find_opening(const DenseMotion& motion, double from, double to, double at_end);
  double first_change(const DenseMotion& motion);
  bool over_rim(const DenseMotion& motion, const vector<Vec3>& x) const;
  enum class Opened { near, away, back };
  Opened classify_opened(const DenseMotion& motion, const vector<Vec3>& x) const;

  const World& world_;
  double time_;              // s
  const double step_error_;  // a share of the least radius and of speeds
  // A share of coordinates and speeds: an error that counts as rounding. It is as much smaller in a run with smaller
  // errors of steps, because what it does would else be the same in both.
  const double rounding_;
  vector<Entity> members_;
  vector<Applied> applied_;
  vector<double> inverse_mass_;  // 1/kg
  CoupledForces couplings_;
  vector<Carrier> carriers_;
  vector<uint8_t> left_;  // by member: whether it is left out of their work
  vector<Contact> closed_;
  vector<Contact> opened_;
  vector<ContactConstraint> rows_;
  vector<ContactConstraint> opened_rows_;
  vector<ContactConstraint> held_;  // rows_ in the motion that is followed
  Scales scales_;                   // of the step that is followed
  Allowed allowed_;                 // the same
  Certificate certificate_;
};

}  // namespace carom
