#pragma once
// The work that fixed things which move do on bodies in lasting contact with them, contact force times velocity, that
// of forces between bodies along paths of islands, and the impulses of contact forces. All are booked as they accrue.
// Nothing is stored where nothing moves, no forces are between bodies, and no impulse is asked for.

#include "numerics/lazy_array.h"
#include "physics/entity.h"
#include "simulate/contact/contact_impulses.h"
#include "simulate/path/instant.h"
#include "std.h"

namespace carom {

class EventLog;

class ContactWork {
 public:
  /// `works`: whether things move, or there are forces between bodies. All arguments must outlive this object.
  ContactWork(const World& world, bool works, span<const WatchedImpulse> impulses, EventLog& log)
      : impulses(world, impulses),
        any_(works || this->impulses.any()),
        power_(world.body_count()),
        path_(world.body_count()),
        log_(log) {}

  ContactImpulses impulses;

  /// Whether anything is to be booked.
  bool any() const { return any_; }
  /// From this instant on, such things do work on body i at this rate (W), and these forces act on it in contacts that
  /// are listed with it. The work and the impulses until then are booked.
  void change(Entity i, const Instant& now, double power, span<const ContactForce> forces = {});
  /// Such things do work, and contacts press, along a path from this instant on. `members`: the bodies on the path.
  void follow(const vector<Entity>& members, const Instant& now, shared_ptr<const WorkingPath> path);
  /// Books what has accrued along the paths of these bodies, which end at this instant.
  void end_paths(const vector<Entity>& members, const Instant& now);
  /// The impulses up to `time` (s), by options.impulses (N s).
  vector<double> impulses_up_to(double time) const;

  /// All paths are of the type Made.
  template <typename Made>
  void keep(auto& archive) {
    archive(impulses, power_, path_);
    for (size_t i = 0; i < path_.size(); ++i) {
      if (!path_[i]) continue;
      auto made = std::static_pointer_cast<const Made>(path_[i]->path);
      archive(made);
      path_[i]->path = made;
    }
  }

 private:
  struct Power {
    Instant since;
    double power = 0;  // W
  };

  /// What accrues along a path of several bodies.
  struct Path {
    Instant start;
    shared_ptr<const WorkingPath> path;  // none: it is booked

    void keep(auto& archive) { archive(start); }
  };

  const bool any_;
  LazyArray<Power> power_;            // by body
  LazyArray<shared_ptr<Path>> path_;  // by body; null: none
  EventLog& log_;
};

}  // namespace carom
