// A removed body keeps its number, as a merged one does. It has neither neighbours nor events, and no mass in states.
// The bodies in lasting contact with it wake. Their island loses a member, and takes a step at once.
#include "simulate/impact/body_removal.h"

#include <utility>

#include "physics/world.h"
#include "simulate/contact/exact_group.h"
#include "simulate/contact/flat_contacts.h"
#include "simulate/contact/flight_changes.h"

namespace carom {

std::vector<Entity> BodyRemoval::remove(Entity i) {
  const Instant now = bodies_.now;
  const double mass = bodies_.world.mass[i];
  const Vec3 x = flights_.position_of_method(i, now);
  const Vec3 v = flights_.velocity_of_method(i, now);

  // Its step, its flight and the work of its contacts end here.
  flights_.end_step(i);
  flights_.book_until(i, now);
  if (is_member(bodies_.mode(i))) bodies_.contact_work.end_paths(bodies_.islands.of(i).members, now);
  bodies_.contact_work.change(i, now, 0);

  // What was in contact with it goes on without it.
  std::vector<Entity> left = release(i);
  modes_.remove(i);

  // It takes its energy and momentum out of the world.
  bodies_.log.remove(0.5 * mass * v.squaredNorm() + bodies_.merged.potential(i, x), mass * v);
  bodies_.merged.remove(i);
  bodies_.ties.untie(i);
  bodies_.neighbours.remove(i);
  flights_.take_out(i, x);
  return left;
}

/// Ends the contacts of body i. Returns one member of each island that it was in contact with.
std::vector<Entity> BodyRemoval::release(Entity i) {
  flat_.clear(i);
  if (!in_lasting_contact(bodies_.mode(i))) return {};

  // What sleeps beside it may rest on it.
  const Vec3 x = bodies_.position(i);
  std::vector<Entity> left;
  if (bodies_.mode(i) == Mode::asleep) group_.wake(i);
  for (const Entity e : bodies_.neighbours_of(i)) {
    if (!bodies_.world.is_body(e) || bodies_.mode(e) != Mode::asleep) continue;
    const double gap = touch(bodies_.world, i, x, e, bodies_.position(e)).gap;
    if (gap > exact_tolerance::waking_gap * bodies_.world.radius[i]) continue;
    group_.wake(e);
    left.push_back(e);
  }

  // Strings may hold what sleeps at their other ends.
  for (const Entity e : group_.asleep_on_strings(i)) {
    if (bodies_.mode(e) != Mode::asleep) continue;
    group_.wake(e);
    left.push_back(e);
  }

  // Its island goes on without it, if it has other members.
  group_.leave(i);
  std::vector<Entity> stay;
  for (const Entity k : bodies_.islands.of(i).members)
    if (k != i) stay.push_back(k);
  if (!stay.empty()) left.push_back(stay.front());
  bodies_.islands.retain(i, std::move(stay));
  return left;
}

}  // namespace carom
