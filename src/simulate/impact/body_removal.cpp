// A removed body keeps its number, as a merged one does. It has neither neighbours nor events, and no mass in states.
// The bodies in lasting contact with it wake. Their island loses a member, and takes a step at once.
#include "simulate/impact/body_removal.h"

#include "physics/world.h"
#include "simulate/contact/exact_group.h"
#include "simulate/contact/flat_contacts.h"
#include "simulate/contact/flight_changes.h"
#include "std.h"

namespace carom {

vector<Entity> BodyRemoval::remove(Entity i) {
  const Instant now = bodies_.now;
  const double mass = bodies_.world.mass[i];
  const Vec3 x = flights_.position_of_method(i, now);
  const Vec3 v = flights_.velocity_of_method(i, now);

  // Its step, its flight and the work of its contacts end here.
  flights_.end_step(i);
  flights_.book_until(i, now);
  if (is_member(bodies_.mode(i))) bodies_.contact_work.end_paths(bodies_.islands.of(i).members, now);

  // What was in contact with it goes on without it.
  flat_.clear(i);
  vector<Entity> left = group_.withdraw(i);
  modes_.remove(i);

  // It takes its energy and momentum out of the world.
  const auto position = [&](Entity k) { return k == i ? x : bodies_.position(k); };
  const double coupled = bodies_.couplings.potential(span(&i, 1), position);  // J
  bodies_.log.remove(0.5 * mass * v.squaredNorm() + bodies_.merged.potential(i, x) + coupled, mass * v);
  bodies_.couplings.remove(i);
  bodies_.merged.remove(i);
  bodies_.ties.untie(i);
  bodies_.neighbours.remove(i);
  flights_.take_out(i, x, Vec3::Zero());
  return left;
}

}  // namespace carom
