#pragma once
// Bodies that press on one another and on fixed things, by themselves. While the set of closed contacts stays the same
// their motion is smooth: forces keep what presses in contact (0 <= force, 0 <= the gap's second derivative, one of
// them zero; the surfaces' curvature in it), and a method of order 8 follows it (dormand_prince.h). Contacts in which a
// force comes to its end open, those at a feature's rim go over to the next feature: instants that are found on the
// method's dense output, at which it ends its step (event-driven integration: Acary & Brogliato, Numerical Methods for
// Nonsmooth Dynamical Systems, 2008, ch. 8). Openings show without the forces, which need not be unique: in the
// accelerations that contacts allow, some gap then grows.
#include <memory>
#include <vector>

#include "geometry/touch.h"
#include "numerics/dense_motion.h"
#include "simulate/contact_list.h"
#include "solver/contact_problem.h"

namespace carom {

class ConstrainedSystem {
 public:
  /// What forces do to a member: m/s^2, where it stands; 1/s, how fast linear drag takes its velocity.
  struct Applied {
    Vec3 at_rest;
    double fade;
    bool bent;  // they have no closed form
  };
  /// members: bodies, ascending; applied: by member, from `time` (s) on. `world` must outlive this.
  ConstrainedSystem(const World& world, double time, std::vector<Entity> members, std::vector<Applied> applied);

  /// A contact of members number a and b, or of a and something fixed. normal: from a to b.
  void add(const Contact& contact, std::uint32_t a, std::uint32_t b, const Vec3& normal);
  /// Of those closed, contact c opens: followed no more, but looked after.
  void open(const std::vector<std::uint8_t>& which);

  /// m/s^2, by member at x (m) and v (m/s): those nearest to the applied ones that keep closed contacts from nearing
  /// each other, n . (a_b - a_a) >= -bending. The rows then have the forces, the normals and the bending.
  std::vector<Vec3> accelerate(const std::vector<Vec3>& x, const std::vector<Vec3>& v);
  /// m/s^2: the second derivative of closed contact c's gap, where the accelerations are a.
  double gap_acceleration(std::size_t c, const std::vector<Vec3>& a) const;

  /// What motion is measured by.
  struct Scales {
    double length = never;    // m, the least radius
    double acceleration = 0;  // m/s^2, the greatest that a force or the surfaces' curvature makes
    double speed = 0;         // m/s, the greatest, or that of falling by a radius
    double opening = 0;       // m/s^2, a gap's acceleration that is more than rounding
    double time() const { return speed > 0 ? length / speed : never; }  // s
  };
  Scales scales(const std::vector<Vec3>& x, const std::vector<Vec3>& v) const;

  /// 1/s: linear drag takes the velocities of all members equally fast. -1: it does not.
  double common_fade() const;
  /// s: for how long all members move along parabolas, or along paths that a common drag bends, from velocities v on
  /// with accelerations a.
  double straight_time(const std::vector<Vec3>& v, const std::vector<Vec3>& a) const;

  /// The motion from there on until something changes, or for `longest` (s).
  struct Followed {
    std::unique_ptr<DenseMotion> motion;
    double next = 0;       // s, a good length of the next step
    bool changes = false;  // it ends where a contact opens, closes or comes to a rim
  };
  /// The forces are those of the last accelerate(). first: s, a guess, or 0.
  Followed follow(const std::vector<Vec3>& x, const std::vector<Vec3>& v, const std::vector<Vec3>& a, double first,
                  double longest);

  const std::vector<ContactConstraint>& rows() const { return rows_; }  // of closed contacts
  const Certificate& certificate() const { return certificate_; }

 private:
  std::vector<Vec3> forces_at(const std::vector<Vec3>& x, const std::vector<Vec3>& v) const;
  bool any_bent() const;
  Vec3 place_of(const std::vector<Vec3>& x, std::uint32_t b, Entity e) const;
  Followed follow_smooth(const std::vector<Vec3>& x, const std::vector<Vec3>& v, const std::vector<Vec3>& a, double h);
  Followed follow_stiff(const std::vector<Vec3>& x, const std::vector<Vec3>& v, double h);
  double greatest_fade() const;
  std::vector<Vec3> solve_rows(const std::vector<Vec3>& x, const std::vector<Vec3>& v,
                               std::vector<ContactConstraint>& rows, Certificate& certificate) const;
  double opens(const DenseMotion& motion, double t);
  double find_opening(const DenseMotion& motion, double from, double to, double at_end);
  double first_change(const DenseMotion& motion);
  bool over_rim(const DenseMotion& motion, const std::vector<Vec3>& x) const;
  enum class Opened { near, away, back };
  Opened look_at_opened(const DenseMotion& motion, const std::vector<Vec3>& x) const;

  const World& world_;
  const double time_;  // s
  std::vector<Entity> members_;
  std::vector<Applied> applied_;
  std::vector<double> inverse_mass_;  // 1/kg
  std::vector<Contact> closed_, opened_;
  std::vector<ContactConstraint> rows_, opened_rows_;
  Scales scales_;  // of the step that is followed
  Certificate certificate_;
};

}  // namespace carom
