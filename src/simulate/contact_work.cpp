// The work of moving things on bodies that they carry. The change of a body's energy by contact is booked as the
// method's deviation wherever it happens, because contact with things at rest does no work. This part of it is work.
#include "simulate/contact_work.h"

#include "simulate/event_log.h"

namespace carom {

void ContactWork::change(Entity i, const Instant& now, double power) {
  const Power& last = power_[i];
  if (last.power == 0 && power == 0) return;
  if (last.power != 0) log_.carry(last.power * (now - last.since));
  power_.write(i) = {now, power};
}

}  // namespace carom
