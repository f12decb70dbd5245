#pragma once
// The time step of the contact group, all bodies at once. First come velocities: the nearest ones to the free ones with
// which no touching pair approaches, and pairs in a fast impact separate at e times their approach. Then come
// displacements: the nearest ones to the mean of old and new velocities with which nothing overlaps at the step's end.
// A body that is stopped short keeps its speed, and collides in the next step. Both are problems of complementarity
// (Moreau, in Nonsmooth Mechanics and Applications, CISM 302 (1988) 1; Stewart & Trinkle, Int. J. Numer. Meth. Eng. 39
// (1996) 2673). Velocities start from the last step's forces. The method is of first order. The linearised
// displacements of convex bodies are on the safe side: what overlap there is the solver has left.
#include <vector>

#include "physics/contact_problem.h"
#include "simulate/stepped_group_bodies.h"
#include "simulate/stepped_group_contacts.h"
#include "simulate/stepped_shared.h"

namespace carom {

/// The contact forces of the group's last step: where the next one's solver starts.
class GroupForces {
 public:
  explicit GroupForces(std::size_t bodies) : of_(bodies) {}
  /// N, between a and b, a < b; 0: none is known.
  double between(Entity a, Entity b) const;
  /// Takes the forces of a step of length h (s) in place of those that are known of these bodies.
  void remember(const GroupBodies& bodies, const std::vector<GroupContact>& contacts, double h);

 private:
  struct PartnerForce {
    Entity partner;
    double force;  // N
  };
  std::vector<std::vector<PartnerForce>> of_;  // by the first of the two
};

class GroupStep {
 public:
  /// `shared` must outlive this.
  explicit GroupStep(StepShared& shared) : shared_(shared), forces_(shared.world.body_count()) {}

  /// Finds the velocities at the step's end, and the contacts' impulses.
  void find_velocities(const GroupBodies& bodies, std::vector<GroupContact>& contacts);
  /// Finds the displacements.
  void find_displacements(const GroupBodies& bodies, const std::vector<GroupContact>& contacts);
  /// Finds which bodies contact forces act on.
  void find_pressed(const GroupBodies& bodies, const std::vector<GroupContact>& contacts);
  /// Slows bodies on which none act to the speed that they have fallen to, under constant forces.
  void limit_free_bodies(const GroupBodies& bodies);
  /// Both are found: what the next step starts from.
  void remember(const GroupBodies& bodies, const std::vector<GroupContact>& contacts);

  const Vec3& end_v(std::size_t k) const { return end_v_[k]; }    // m/s, of body k at the step's end
  const Vec3& drift(std::size_t k) const { return drift_[k]; }    // m/s, its displacement by the step's length
  bool pressed(std::size_t k) const { return pressed_[k] != 0; }  // whether a contact force acts on it

 private:
  void choose_pairs(const GroupBodies& bodies, std::vector<GroupContact>& contacts);
  Certificate solve_velocities(const GroupBodies& bodies, bool without_impacts);
  bool gains_energy(const GroupBodies& bodies, const std::vector<Vec3>& free) const;
  double allowed_overlap(const GroupBodies& bodies) const { return overlap_ * bodies.smallest_radius; }

  StepShared& shared_;
  GroupForces forces_;
  std::vector<ContactConstraint> pairs_;  // the problem at hand,
  std::vector<std::size_t> contact_of_;   // and, by pair, the place of its contact
  std::vector<Vec3> end_v_, drift_;       // m/s
  std::vector<std::uint8_t> pressed_;
  // Of a radius: by how much bodies may overlap, for a step or two: ever less, as long as displacements converge. A gap
  // that this leaves is as good as none.
  double overlap_ = stepped_tolerance::most_overlap;
  double froude_ = 1;      // the bodies' mean speed, by that of falling by a radius
  bool converged_ = true;  // the displacements found keep all contacts
};

}  // namespace carom
