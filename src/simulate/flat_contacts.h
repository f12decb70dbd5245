#pragma once
// Rest on flat fixed surfaces. A body's bounces under load end at a time known in closed form: after an impact that
// leaves it with the speed u, at 2u / (p (1 - e)) from then, where p is the acceleration that presses it on (a
// geometric series of flights). When that is less than the clock can resolve, or the impact is slower than rest_speed,
// the body is put to rest: from then on it moves in the surface, with the reaction taken from its acceleration, and its
// path is a parabola again. Contact of any other kind, with a body, an edge, a corner or anything round, has no such
// path: such bodies join the contact group (exact_group.h).
#include <array>
#include <vector>

#include "physics/contact_force.h"
#include "simulate/exact_bodies.h"

namespace carom {

class CollapseDetector;

/// A flat surface that carries a body.
struct FlatContact {
  Entity surface;
  std::uint8_t feature;   // of the pair (touch.h; of a ball and a wall: contact_time.h)
  Vec3 normal;            // unit, from the surface to the body
  bool settling;          // bounces have not ended yet, but will at
  Instant rest_time;      //
  double residual_speed;  // m/s, what the last bounce left
};

/// Those of a body.
struct FlatContactList {
  static constexpr std::size_t most = 4;
  std::array<FlatContact, most> at;
  std::size_t count = 0;
};

class FlatContacts {
 public:
  FlatContacts(ExactBodies& bodies, CollapseDetector& collapses)
      : bodies_(bodies), collapses_(collapses), contacts_(bodies.body.size()) {}

  const FlatContactList& of(Entity i) const { return contacts_[i]; }
  bool carry(Entity i, Entity surface) const;
  /// Whether body i cannot strike this fixed thing: it lies behind a surface that carries the body.
  bool hide(Entity i, Entity fixed) const;

  /// Adds a surface to those that carry body i.
  void add(Entity i, const FlatContact& contact);
  void remove(Entity i, Entity surface);
  /// Removes those that are level, or nearly so, with a surface of this normal, which carries the body from now on.
  void remove_level(Entity i, const Vec3& normal);
  /// The same at the surface's rim, over which body i slides. Where another one lies level with it, that one carries
  /// the body on. Gives it and where they touch, or no_entity.
  FlightOrigin hand_over(Entity i, Entity surface);
  void clear(Entity i);
  /// At the start: a body that touches a flat surface (but for rounding of the scene's numbers), does not move along
  /// its normal and is pressed on rests there from the first.
  void find_initial(Entity i);
  /// Records the end of the bounces that are due: the body has been carried since the last impact.
  void end_bounces(Entity i);

  /// Body i's velocity has become v (m/s). Gives up the contacts that it leaves or strikes (the strike comes next, as
  /// an event), unless the hop or the bounce would be one that numbers cannot tell from none. Gives the velocity that
  /// the others allow.
  Vec3 keep_at(Entity i, const Vec3& v) { return contacts_[i].count == 0 ? v : keep_at_surfaces(i, v); }
  /// Gives up contacts that do not press. Gives the acceleration (m/s^2) that forces and the contacts' reactions leave
  /// to body i, but for drag; zero in lasting contact, where steps have the forces in them.
  Vec3 keep_pressing(Entity i) {
    if (bodies_.in_lasting_contact(i)) return Vec3::Zero();
    return contacts_[i].count == 0 ? bodies_.applied[i] : keep_pressing_surfaces(i);
  }
  /// m/s^2, the same without one surface, changing nothing: what would press body i against that surface.
  Vec3 acceleration_without(Entity i, Entity surface) const;

  /// Appends the forces of body i's contacts: what keeps it to them.
  void report(Entity i, std::vector<ContactForce>& forces) const;

 private:
  Vec3 keep_at_surfaces(Entity i, const Vec3& v);
  Vec3 keep_pressing_surfaces(Entity i);
  void record_bounce(Entity i, const FlatContact& contact, double approach, double e);
  static void keep(FlatContactList& contacts, const std::array<bool, FlatContactList::most>& which);

  ExactBodies& bodies_;
  CollapseDetector& collapses_;
  SparseArray<FlatContactList> contacts_;
};

}  // namespace carom
