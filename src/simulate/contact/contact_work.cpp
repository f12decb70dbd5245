// The work of moving things on bodies that they carry. The change of a body's energy by contact is booked as the
// method's deviation wherever it happens, because contact with things at rest does no work. This part of it is work.
// Impulses accrue with the same forces, and are booked where these change.
#include "simulate/contact/contact_work.h"

#include "simulate/event_log.h"
#include "std.h"

namespace carom {

void ContactWork::change(Entity i, const Instant& now, double power, span<const ContactForce> forces) {
  if (impulses.any()) impulses.hold(i, now, forces);
  const Power& last = power_[i];
  if (last.power == 0 && power == 0) return;
  if (last.power != 0) log_.add_carried_work(last.power * (now - last.since));
  power_.write(i) = {now, power};
}

void ContactWork::follow(const vector<Entity>& members, const Instant& now, shared_ptr<const WorkingPath> path) {
  const auto from_now = make_shared<Path>(Path{now, std::move(path)});
  for (const Entity i : members) path_.write(i) = from_now;
}

void ContactWork::end_paths(const vector<Entity>& members, const Instant& now) {
  if (path_.empty()) return;
  for (const Entity i : members) {
    if (!path_[i]) continue;
    Path& path = *path_[i];
    if (path.path) {
      path.path->book(now - path.start, log_);
      if (impulses.any()) impulses.add_path(path.start, now, *path.path);
    }
    path.path = nullptr;
    path_.write(i) = nullptr;
  }
}

vector<double> ContactWork::impulses_up_to(double time) const {
  set<const Path*> seen;
  vector<ContactImpulses::OpenPath> paths;
  for (size_t i = 0; !path_.empty() && i < path_.size(); ++i)
    if (path_[i] && path_[i]->path && seen.insert(path_[i].get()).second)
      paths.emplace_back(path_[i]->start, path_[i]->path.get());
  return impulses.up_to(time, paths);
}

}  // namespace carom
