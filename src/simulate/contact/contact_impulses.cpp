// A window takes its part of a force or of a path. Constant forces are kept by body, each with the sum that it counts
// for, so that a change of one body's forces costs no search among other contacts.
#include "simulate/contact/contact_impulses.h"

#include "std.h"

namespace carom {
namespace {

bool has(const vector<EntityRange>& ranges, Entity e) {
  return any_of(ranges, [&](const EntityRange& range) { return range.has(e); });
}

}  // namespace

/// Whether a contact is one of those of sum k. A string pulls at both of its bodies.
bool ContactImpulses::counts(size_t k, Entity i, Entity thing) const {
  const WatchedImpulse& watched = watched_[k];
  const Entity other = world_.is_string(thing) ? world_.second_body(thing) : no_entity;
  const auto first_in = [&](const vector<EntityRange>& names) {
    return has(names, i) || (other != no_entity && has(names, other));
  };
  if (!watched.b) return first_in(watched.a) || has(watched.a, thing);
  return (first_in(watched.a) && has(*watched.b, thing)) || (first_in(*watched.b) && has(watched.a, thing));
}

/// The part of a time that lies in the window of sum k (s); below 0: none.
double ContactImpulses::time_in(size_t k, const Instant& from, const Instant& until) const {
  const TimeWindow& window = watched_[k].window;
  return min(until, Instant{window.until, 0}) - max(from, Instant{window.from, 0});
}

void ContactImpulses::strike(const Instant& at, Entity i, Entity thing, double impulse) {
  for (size_t k = 0; k < sums_.size(); ++k)
    if (watched_[k].window.has(at.hi) && counts(k, i, thing)) sums_[k].add(impulse);
}

void ContactImpulses::spread(const Instant& from, const Instant& until, Entity i, Entity thing, double impulse) {
  const double length = until - from;
  if (impulse == 0 || !(length > 0)) return;
  for (size_t k = 0; k < sums_.size(); ++k) {
    const double part = time_in(k, from, until);
    if (part > 0 && counts(k, i, thing)) sums_[k].add(part < length ? impulse * (part / length) : impulse);
  }
}

void ContactImpulses::hold(Entity i, const Instant& now, span<const ContactForce> forces) {
  if (held_[i].rates.empty() && forces.empty()) return;
  Held& held = held_.write(i);
  for (const Rate& rate : held.rates)
    if (const double part = time_in(rate.sum, held.since, now); part > 0) sums_[rate.sum].add(rate.force * part);

  held.since = now;
  held.rates.clear();
  for (const ContactForce& of : forces)
    for (size_t k = 0; k < sums_.size(); ++k)
      if (of.force != 0 && counts(k, of.a, of.b)) held.rates.push_back({uint32_t(k), std::abs(of.force)});
}

/// Windows that take the same part of the path share its integrals.
void ContactImpulses::add_path(const Instant& start, const Instant& until, const WorkingPath& path,
                               vector<Sum>& sums) const {
  pair<double, double> known{-1, -1};  // s
  vector<ContactForce> found;
  for (size_t k = 0; k < sums.size(); ++k) {
    if (!(time_in(k, start, until) > 0)) continue;

    const double from = max(start, Instant{watched_[k].window.from, 0}) - start;
    const double to = min(until, Instant{watched_[k].window.until, 0}) - start;
    if (known != pair(from, to)) {
      known = {from, to};
      found.clear();
      path.impulses(from, to, [&](const ContactForce& impulse) { found.push_back(impulse); });
    }
    for (const ContactForce& of : found)
      if (counts(k, of.a, of.b)) sums[k].add(of.force);
  }
}

vector<double> ContactImpulses::up_to(double time, span<const OpenPath> paths) const {
  vector<Sum> sums = sums_;
  const Instant until{time, 0};
  for (size_t i = 0; !held_.empty() && i < held_.size(); ++i)
    for (const Rate& rate : held_[i].rates)
      if (const double part = time_in(rate.sum, held_[i].since, until); part > 0) sums[rate.sum].add(rate.force * part);
  for (const auto& [start, path] : paths) add_path(start, until, *path, sums);

  vector<double> values;
  for (const Sum& sum : sums) values.push_back(sum.value());
  return values;
}

}  // namespace carom
