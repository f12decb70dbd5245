#pragma once
// A predicted event of the exact simulator, and the data of its body that events need.

#include "geometry/contact_time.h"
#include "physics/entity.h"
#include "simulate/path/instant.h"
#include "simulate/path/modes.h"
#include "std.h"

namespace carom {

struct ExactEvent {
  // In the order of events at one instant.
  enum class Kind : uint8_t {
    force,    // a force on the body starts or ends, or a fixed thing changes its velocity
    rest,     // bounces end: a line in the record
    release,  // a body slides off a wall's face
    // A step of an island: no impact, but new forces.
    step,
    body_fixed,
    body_body,
    string,  // a string goes taut; the partner is the string
    none
  };
  static constexpr bool is_impact(Kind kind) { return Kind::body_fixed <= kind && kind <= Kind::string; }

  Instant time{never, 0};
  Entity partner = no_entity;
  // The event is stale if the partner has another version.
  uint16_t partner_version = 0;
  uint8_t feature = no_feature;  // where they meet, as in Touch
  Kind kind : 7 = Kind::none;
  bool tied : 1 = false;  // another impact of the body falls on about the same instant
};

/// The origin of a flight: the thing that the body has just struck, and the feature.
struct FlightOrigin {
  Entity partner = no_entity;
  uint8_t feature = no_feature;
};

/// The data of a body that events need, apart from its flight. It takes half a cache line.
class ExactBody {
 public:
  ExactEvent event;      // its next one
  uint16_t version = 1;  // counts its flights; never 0

 private:
  friend class ModeChanges;
  Mode mode_ = Mode::flying;

 public:
  uint8_t origin_feature = no_feature;
  Entity origin_partner = no_entity;

  Mode mode() const { return mode_; }
  FlightOrigin origin() const { return {origin_partner, origin_feature}; }
  void set_origin(const FlightOrigin& origin) {
    origin_partner = origin.partner;
    origin_feature = origin.feature;
  }
};
static_assert(sizeof(ExactBody) == 32);

}  // namespace carom
