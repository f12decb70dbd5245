#pragma once
// The effect of impacts on velocities: of two bodies, and of a body and a fixed thing. Pairs are resolved one at a
// time.
#include <memory>

#include "geometry/touch.h"
#include "numerics/vec3.h"
#include "physics/entity.h"
#include "simulate/impact/impact_parts.h"

namespace carom {

struct Collision;
struct FlatContact;
struct Flight;

class StringImpacts;

class ExactImpacts {
 public:
  ExactImpacts(ExactBodies& bodies, const ImpactParts& parts);
  ~ExactImpacts();

  /// Bodies a < b meet at the present instant, at this feature.
  void collide_pair(Entity a, Entity b, std::uint8_t feature);
  /// Body i meets a fixed thing at the present instant.
  void collide_fixed(Entity i, Entity surface, std::uint8_t feature);
  /// A string goes taut at the present instant.
  void tighten(Entity string);

 private:
  /// A body and a fixed thing at the instant of their impact.
  struct FixedImpact {
    Entity body;
    Entity surface;
    std::uint8_t feature;
    bool flat;
    bool began_now;   // the flight began at this instant
    Vec3 x;           // m
    Vec3 v;           // m/s
    Vec3 u;           // m/s, of the fixed thing
    Touch there;      // the contact of the two
    double e;         // restitution
    double approach;  // m/s
    double unkicked;  // m/s, without the effect of later forces
    double press;     // m/s^2, drives the two together
  };

  /// The same of two bodies, with its effect.
  struct PairImpact;

  double press_of(Entity a, const Vec3& xa, Entity b, const Vec3& xb, const Touch& there, const Vec3& w) const;
  Vec3 pull_after(Entity i, const Vec3& x, const Flight& f, Entity other, const Touch& there, const Vec3& w) const;
  bool too_slow_to_wake(Entity striker, Entity struck, double approach) const;
  double holding(double press, Entity i, Entity e) const;
  [[gnu::noinline]] bool move_as_one(Entity a, Entity b, double approach) const;
  void hold_together(Entity a, Entity b, const Vec3& n);
  void release(Entity i);
  bool is_plastic(const Collision& met, double press, double length) const;
  void bounce_off(Entity striker, Entity struck, std::uint8_t feature, const Touch& there, double approach);
  void apply_pair(const PairImpact& impact);
  FixedImpact find_fixed(Entity i, Entity surface, std::uint8_t feature);
  bool comes_to_rest(const FixedImpact& impact, FlatContact& contact) const;
  bool over_at_once(const FixedImpact& impact, double left) const;
  bool ends_in_contact(const FixedImpact& impact);
  void check_room(const FixedImpact& impact) const;

  ExactBodies& bodies_;
  const ImpactParts parts_;
  const std::unique_ptr<StringImpacts> strings_;
};

}  // namespace carom
