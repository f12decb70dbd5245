#pragma once
// The work that fixed things which move do on bodies in lasting contact with them: contact force times velocity, booked
// as it accrues. Nothing is stored where nothing moves.
#include <functional>
#include <memory>
#include <vector>

#include "numerics/lazy_array.h"
#include "physics/entity.h"
#include "simulate/path/instant.h"

namespace carom {

class EventLog;

class ContactWork {
 public:
  ContactWork(Entity bodies, EventLog& log) : power_(bodies), path_(bodies), log_(log) {}

  /// From this instant on, such things do work on body i at this rate (W). The work until then is booked.
  void change(Entity i, const Instant& now, double power);
  /// Along a path from this instant on, such things do the work (J) that `by` gives for so many seconds. `members`: the
  /// bodies on the path.
  void follow(const std::vector<Entity>& members, const Instant& now, std::function<double(double)> by);
  /// Books the work along the paths of these bodies, which end at this instant.
  void end_paths(const std::vector<Entity>& members, const Instant& now);

 private:
  struct Power {
    Instant since;
    double power = 0;  // W
  };

  /// The work along a path of several bodies.
  struct Path {
    Instant start;
    std::function<double(double)> work;  // none: it is booked
  };

  LazyArray<Power> power_;                 // by body
  LazyArray<std::shared_ptr<Path>> path_;  // by body; null: none
  EventLog& log_;
};

}  // namespace carom
