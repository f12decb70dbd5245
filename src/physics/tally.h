#pragma once
// Running sums of a run: what summary.csv needs without a table of collisions.
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "physics/collision.h"

namespace carom {

/// Impacts that lasting contact took up: they leave no approach and are not recorded.
struct TakenUp {
  std::uint64_t impacts = 0;
  double fastest = 0;  // m/s, of approach
  double energy = 0;   // J, a part of the energy lost
};

struct Tally {
  std::uint64_t body_body = 0;   // collisions
  std::uint64_t body_fixed = 0;  // collisions
  std::uint64_t merges = 0;
  std::uint64_t collapses = 0;  // clusters of bodies that hit each other ever faster and slower, taken into contact
  double first_collision = std::numeric_limits<double>::quiet_NaN();  // s, NaN: none
  double last_collision = std::numeric_limits<double>::quiet_NaN();   // s, NaN: none
  std::uint64_t doubtful = 0;  // contact problems whose answer may be off by more than rounding
  double energy_lost = 0;      // J, by impacts: those recorded, and those that contact took up
  double method_error = 0;     // J, that lasting contact took beside impacts (below 0: made): its method's own error
  double work = 0;             // J, by the World's forces (gravity apart)
  std::vector<double> force_work;  // J, by force: its part of that; empty: there are no forces, or it is not known
  double greatest_phase = 0;       // rad, by which forces turn in a step of a method with steps of one length
  double max_overlap = 0;          // m, deepest seen
  double max_speed = 0;            // m/s, greatest seen
  std::uint64_t resting = 0;       // bodies in resting contact now
  double stepped_contact = 0;      // s, summed over bodies: lasting contact that time stepping has told
  TakenUp taken_up;

  /// Takes a record into the counts; the end of bounces is no collision.
  void count(CollisionKind kind, double time) {
    if (kind == CollisionKind::rest) return;
    ++(kind == CollisionKind::body_body ? body_body : kind == CollisionKind::body_fixed ? body_fixed : merges);
    if (std::isnan(first_collision)) first_collision = time;
    last_collision = time;
  }
  std::uint64_t collisions() const { return body_body + body_fixed + merges; }
};

}  // namespace carom
