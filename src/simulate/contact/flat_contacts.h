#pragma once
// Rest on flat fixed surfaces. A body's bounces under load end at a time in closed form, by a geometric series of
// flights. After an impact that leaves the speed u, they end 2u / (p (1 - e)) later. Here p is the acceleration that
// presses the body on. The body is put to rest when that time is less than the clock resolves, or when the impact is
// slower than rest_speed. It then moves in the surface, the reaction reduces its acceleration, and its path is a
// parabola again. Contact of any other kind, with a body, an edge, a corner, a round thing or one that swings, has no
// such path. Such bodies join islands (exact_group.h).

#include "physics/contact_force.h"
#include "simulate/contact/exact_bodies.h"
#include "simulate/contact/flat_contact_problems.h"
#include "simulate/contact/mode_changes.h"
#include "std.h"

namespace carom {

class CollapseDetector;

/// A flat surface that carries a body.
struct FlatContact {
  Entity surface;
  uint8_t feature;             // of the pair (touch.h; of a ball and a wall: contact_time.h)
  Vec3 normal = Vec3::Zero();  // unit, from the surface to the body
  // Bounces have not ended: the contact settles. They end at the time below.
  bool settling;
  Instant rest_time;      // s
  double residual_speed;  // m/s, left by the last bounce

  void keep(auto& archive) { archive(surface, feature, normal, settling, rest_time, residual_speed); }
};

/// The flat contacts of a body.
struct FlatContactList {
  static constexpr size_t most = 4;
  array<FlatContact, most> at;
  size_t count = 0;

  void keep(auto& archive) {
    archive(count);
    archive.check(count <= most);
    for (size_t k = 0; k < count; ++k) archive(at[k]);
  }
};

class FlatContacts {
 public:
  FlatContacts(ExactBodies& bodies, ModeChanges& modes, CollapseDetector& collapses)
      : bodies_(bodies), modes_(modes), collapses_(collapses), contacts_(bodies.body.size()) {}

  const FlatContactList& of(Entity i) const { return contacts_[i]; }
  bool carries(Entity i, Entity surface) const;
  /// Whether one more surface can carry body i, beside those that do and `coming` others.
  bool has_room(Entity i, size_t coming = 0) const { return contacts_[i].count + coming < FlatContactList::most; }
  /// Whether a surface that carries body i changes its velocity at the present instant.
  bool switches(Entity i) const;
  /// The path of a fixed thing from `start` (s) on, as long as its present velocity lasts.
  FadingPath path_of(Entity surface, const Instant& start) const;
  /// Stores the forces of the surfaces that carry body i from this instant on, and the power of those that move.
  void note_forces(Entity i);
  /// Whether body i cannot strike this fixed thing, because it lies behind a surface that carries the body.
  bool hides(Entity i, Entity fixed) const;

  /// Adds a surface to those that carry body i, for which there must be room.
  void add(Entity i, const FlatContact& contact);
  void remove(Entity i, Entity surface);
  /// Removes surfaces that are level, or nearly so, with a surface of this normal, which carries the body from this
  /// instant on.
  void remove_level(Entity i, const Vec3& normal);
  /// Removes the surface at its rim, over which body i slides. If another surface is level with it, that one carries
  /// the body on. Returns that surface and the feature of contact, or no_entity.
  FlightOrigin hand_over(Entity i, Entity surface);
  void clear(Entity i);
  /// At the start, a body may touch a flat surface, up to rounding of the scene's numbers, without motion along its
  /// normal. If it is pressed on, it rests there from the beginning.
  void find_initial(Entity i);
  /// Records the end of bounces that are due. The body has been carried since the last impact.
  void end_bounces(Entity i);

  /// Changes body i's velocity to v (m/s). Contacts that it leaves or strikes end. The strike follows as an event.
  /// They stay where rounding hides the hop or the bounce. Returns the velocity that the remaining contacts allow.
  Vec3 keep_at(Entity i, const Vec3& v) { return lies_on_flat(bodies_.mode(i)) ? keep_at_surfaces(i, v) : v; }
  /// Ends contacts that do not press. Returns the acceleration (m/s^2) by forces and reactions, without drag.
  /// It is zero in lasting contact, where steps contain the forces.
  Vec3 keep_pressing(Entity i) {
    if (in_lasting_contact(bodies_.mode(i))) return Vec3::Zero();
    return lies_on_flat(bodies_.mode(i)) ? keep_pressing_surfaces(i) : bodies_.applied[i];
  }
  /// The same without one surface, and without any change: the acceleration that would press body i against that
  /// surface (m/s^2). The caller notes the certificate.
  FlatSolution acceleration_without(Entity i, Entity surface) const;

  /// The acceleration (m/s^2) along n, the direction to a surface that moves, by drag on a body that it carries.
  double drag_along(Entity i, const Vec3& n, Entity surface) const {
    return bodies_.moving.any() ? -bodies_.fade[i] * n.dot(bodies_.fixed_velocity(surface)) : 0;
  }

  /// Appends the forces that keep body i on its surfaces.
  void report(Entity i, vector<ContactForce>& forces) const;

  void keep(auto& archive) { archive(contacts_); }

 private:
  void note_mode(Entity i);
  using Surfaces = array<FlatSurface, FlatContactList::most>;
  size_t surfaces_of(const FlatContactList& contacts, Entity without, double factor, Surfaces& surfaces) const;
  FlatSolution note_solution(Entity i, const FlatSolution& solution, double& lost);
  static vector<Entity> opposite_surfaces(const FlatContactList& contacts);
  /// The force of a surface on a body.
  struct SurfaceForce {
    Entity surface;
    Vec3 normal;       // unit, from the body to the surface
    double along = 0;  // m/s, of the surface along the normal
    double force = 0;  // N
  };
  vector<SurfaceForce> surfaces_below(Entity i) const;
  vector<SurfaceForce> forces_on(Entity i) const;
  void note_pushes(Entity i, const FlatContactList& contacts, span<const double> pushes);
  Vec3 keep_at_surfaces(Entity i, const Vec3& v);
  Vec3 keep_pressing_surfaces(Entity i);
  Vec3 place_of(Entity i, const FlatContact& contact) const;
  void record_bounce(Entity i, const FlatContact& contact, double approach, double e, double lost);
  static void retain(FlatContactList& contacts, const array<bool, FlatContactList::most>& which);

  ExactBodies& bodies_;
  ModeChanges& modes_;
  CollapseDetector& collapses_;
  SparseArray<FlatContactList> contacts_;
};

}  // namespace carom
