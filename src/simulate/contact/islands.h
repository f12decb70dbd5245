#pragma once
// Islands of the exact simulator: connected components of awake bodies in lasting contact. Fixed things and sleeping
// bodies do not connect. Each island moves by itself, in steps of its own. The number and the motion of other islands
// have no effect on it.
#include <deque>

#include "geometry/contact_time.h"
#include "numerics/lazy_array.h"
#include "physics/entity.h"
#include "simulate/path/instant.h"
#include "std.h"

namespace carom {

struct Crowd;

struct Island {
  vector<Entity> members;  // ascending after each step
  Instant end{never, 0};   // time of the next step
  bool busy = false;       // its contacts change too often for constrained motion
  // Constrained: the end of the step if nothing happens before.
  Instant planned{never, 0};
  double next_length = 0;  // s, a good length for the next step of constrained motion
  // Start of the count of contact changes.
  Instant counted;
  // The last change of contact.
  Instant changed;
  uint32_t changes = 0;  // changes of contact since `counted`
  uint32_t calm = 0;     // consecutive steps of a crowd in which the same pairs pressed
  // After so many of these the island is not busy.
  uint32_t calm_needed = 0;
  uint64_t pressing = 0;  // a hash of the pairs that pressed
  // What is left of the crowds of its members: that of its last step, or those that have united or split since.
  vector<shared_ptr<Crowd>> crowds;
  // Bodies of other kinds near it, with a new path since its last step.
  vector<Entity> watched;

  void keep(auto& archive) {
    archive(members, end, busy, planned, next_length, counted, changed, changes, calm, calm_needed, pressing);
    archive(crowds, watched);
  }
};

class Islands {
 public:
  explicit Islands(Entity bodies) : island_(bodies, none) {}

  /// The island of a member. References stay valid until it is merged with another one.
  Island& of(Entity i) { return islands_[island_[i]]; }
  const Island& of(Entity i) const { return islands_[island_[i]]; }
  bool same(Entity a, Entity b) const { return island_[a] == island_[b]; }
  bool any() const { return count_ > 0; }

  /// Calls what(island) for each island. The call must not change their number.
  template <typename What>
  void for_each(What what) const {
    for (const Island& island : islands_)
      if (!island.members.empty()) what(island);
  }

  /// Makes an island of body i, which is in none. Its step is due at `end`.
  void create(Entity i, const Instant& end);
  /// Unites the islands of two members. Its next step is due at `end`.
  void merge(Entity a, Entity b, const Instant& end);
  /// Reduces an island to the members in `stay`.
  void retain(Entity member, vector<Entity> stay);
  /// Splits an island. Members with another label become islands of their own, equal in all other data.
  /// `labels`: by member, the index of the first member of its part. Returns one member of each part.
  vector<Entity> split(Entity i, span<const uint32_t> labels);

  void keep(auto& archive) { archive(islands_, vacant_, island_, count_); }

 private:
  static constexpr uint32_t none = ~uint32_t{0};

  uint32_t take_place();
  void vacate(uint32_t place);

  std::deque<Island> islands_;
  vector<uint32_t> vacant_;
  LazyArray<uint32_t> island_;  // by body
  size_t count_ = 0;
};

}  // namespace carom
