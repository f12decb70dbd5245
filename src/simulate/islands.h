#pragma once
// Islands of the exact simulator: awake bodies in lasting contact with one another. Fixed things and sleeping bodies do
// not connect. Each island moves by itself, in steps of its own; what other islands do, or how many there are, is
// nothing to it.
#include <algorithm>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "geometry/contact_time.h"
#include "numerics/vec3.h"
#include "physics/entity.h"
#include "physics/path_piece.h"
#include "simulate/instant.h"
#include "simulate/lazy_array.h"

namespace carom {

struct Island {
  std::vector<Entity> members;    // ascending after each step
  Instant end{never, 0};          // when the next step is due
  bool fresh = true;              // has taken no step yet
  bool constrained = false;       // moves by constrained motion (constrained_motion.h), else by time stepping
  bool busy = false;              // its contacts change too often for constrained motion
  Instant planned{never, 0};      // constrained: when the step ends if nothing happens before
  double next_length = 0;         // s, a good length for the next step of constrained motion
  Instant counted, changed;       // since when, and when at last, contacts have changed
  std::uint32_t changes = 0;      // so often
  std::uint32_t calm = 0;         // time steps on end in which the same pairs pressed
  std::uint32_t calm_needed = 0;  // so many, and it is busy no more
  std::uint64_t pressing = 0;     // a hash of those pairs
  double step_length = 0;         // s, of the last time step
  double shortest_step = 0;       // s, of one that is as short as the method has them
  std::size_t impact_pairs = 0;   // that simultaneous impacts have solved for since then
  std::uint32_t short_steps = 0;  // time steps on end that simultaneous impacts ended at once
};

class Islands {
 public:
  explicit Islands(Entity bodies)
      : kicked_until(bodies),
        kick(bodies, Vec3::Zero()),
        piece_end(bodies, Instant{never, 0}),
        bend(bodies),
        island_(bodies, none) {}

  LazyArray<Instant> kicked_until;  // by member, in time stepping: forces are in its velocity up to this instant,
  LazyArray<Vec3> kick;             // m/s^2, this on average, from the start
  LazyArray<Instant> piece_end;     // by member, in constrained motion: when its flight is to follow its path anew,
  LazyArray<PathBend> bend;         // and by how much its path's velocity is another one until then

  /// That of a member. References stay valid until it is merged with another one.
  Island& of(Entity i) { return islands_[island_[i]]; }
  const Island& of(Entity i) const { return islands_[island_[i]]; }
  /// When a member's flight ends: with its island's step, or with its piece of a path.
  Instant due(Entity i) const {
    const Island& island = of(i);
    return island.constrained ? std::min(island.end, piece_end[i]) : island.end;
  }
  bool same(Entity a, Entity b) const { return island_[a] == island_[b]; }
  bool any() const { return count_ > 0; }

  /// Calls what(island) for each of them, which must not change how many there are.
  template <typename What>
  void for_each(What what) const {
    for (const Island& island : islands_)
      if (!island.members.empty()) what(island);
  }

  /// Body i, a member of none, becomes an island whose step is due at `end`.
  void create(Entity i, const Instant& end);
  /// Makes two members' islands one. Its next step is due at `now`, but where a fresh one joins a time step, which goes
  /// on. If either moves by time stepping, it does.
  void merge(Entity a, Entity b, const Instant& now);
  /// Leaves of an island only those that stay.
  void retain(Entity member, std::vector<Entity> stay);
  /// Splits an island: members with another label become islands of their own, alike in all else. labels: by member,
  /// the place of the first member of its part. Gives one member of each part.
  std::vector<Entity> split(Entity i, std::span<const std::uint32_t> labels);

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  std::uint32_t take_place();
  void release(std::uint32_t place);

  std::deque<Island> islands_;
  std::vector<std::uint32_t> vacant_;
  LazyArray<std::uint32_t> island_;  // by body
  std::size_t count_ = 0;
};

}  // namespace carom
