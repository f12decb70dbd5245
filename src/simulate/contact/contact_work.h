#pragma once
// The work that fixed things which move do on bodies in lasting contact with them: contact force times velocity, booked
// as it accrues. The same for forces between bodies along paths of islands. Nothing is stored where there are neither.

#include "numerics/lazy_array.h"
#include "physics/entity.h"
#include "simulate/path/instant.h"
#include "std.h"

namespace carom {

class EventLog;

/// A path along which things that move, or forces between bodies, do work.
class WorkingPath {
 public:
  virtual ~WorkingPath() = default;
  /// Books their work in the first `seconds`.
  virtual void book(double seconds, EventLog& log) const = 0;
};

class ContactWork {
 public:
  ContactWork(Entity bodies, EventLog& log) : power_(bodies), path_(bodies), log_(log) {}

  /// From this instant on, such things do work on body i at this rate (W). The work until then is booked.
  void change(Entity i, const Instant& now, double power);
  /// Such things do work along a path from this instant on. `members`: the bodies on the path.
  void follow(const vector<Entity>& members, const Instant& now, shared_ptr<const WorkingPath> path);
  /// Books the work along the paths of these bodies, which end at this instant.
  void end_paths(const vector<Entity>& members, const Instant& now);

  /// All paths are of the type Made.
  template <typename Made>
  void keep(auto& archive) {
    archive(power_, path_);
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

  /// The work along a path of several bodies.
  struct Path {
    Instant start;
    shared_ptr<const WorkingPath> path;  // none: its work is booked

    void keep(auto& archive) { archive(start); }
  };

  LazyArray<Power> power_;            // by body
  LazyArray<shared_ptr<Path>> path_;  // by body; null: none
  EventLog& log_;
};

}  // namespace carom
