#pragma once
// The work that fixed things which move do on bodies in lasting contact with them: contact force times velocity, booked
// as it accrues. Nothing is stored where nothing moves.
#include "physics/entity.h"
#include "simulate/instant.h"
#include "simulate/lazy_array.h"

namespace carom {

class EventLog;

class ContactWork {
 public:
  ContactWork(Entity bodies, EventLog& log) : power_(bodies), log_(log) {}

  /// From this instant on, such things do work on body i at this rate (W). The work until then is booked.
  void change(Entity i, const Instant& now, double power);
  /// The rate increases by this much (W).
  void add(Entity i, const Instant& now, double power) { change(i, now, power_[i].power + power); }

 private:
  struct Power {
    Instant since;
    double power = 0;  // W
  };

  LazyArray<Power> power_;  // by body
  EventLog& log_;
};

}  // namespace carom
