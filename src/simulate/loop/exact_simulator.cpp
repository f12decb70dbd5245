// The event loop of the exact simulator. It takes the first event of the total order, updates the bodies concerned and
// predicts their next events. Other bodies do not move, so that a step costs as much as the event and not as the scene.
// Each kind of event belongs to one part. The loop returns early when a buffer is full, or after many events, so that
// the caller keeps control.
#include "simulate/loop/exact_simulator.h"

#include "geometry/touch.h"
#include "physics/archive.h"
#include "physics/restitution.h"
#include "physics/world_now.h"
#include "std.h"

namespace carom {

namespace {

// Collisions that one event causes, as a rule at most.
constexpr size_t collisions_of_event = 8;
constexpr uint32_t events_at_a_time = 65536;
// A step of an island takes as long as so many impacts for each of its bodies.
constexpr uint32_t events_of_a_step = 64;
// A share of the duration: what an event at time 0 sets lies ahead by so much.
constexpr double shortest_delay = 0x1p-100;
// Number of bodies with data that fit into a processor's cache.
constexpr Entity cached_bodies = 24576;

}  // namespace

unique_ptr<Simulator> make_exact_simulator(const World& world, const State& initial, const ExactOptions& options) {
  return make_unique<ExactSimulator>(world, initial, options);
}

ExactSimulator::ExactSimulator(const World& world, const State& initial, const ExactOptions& options)
    : bodies_(world, options),
      crossings_(bodies_, [this](Entity i) { return bodies_.flight_end(i); }),
      paths_(bodies_, crossings_),
      collapses_(bodies_),
      modes_(bodies_),
      flat_(bodies_, modes_, collapses_),
      group_(bodies_, modes_, flat_, collapses_, paths_),
      // What makes flights and events, then what happens at an event.
      flights_(bodies_, flat_, paths_),
      queue_(bodies_),
      prefetch_(bodies_, queue_),
      predictor_(bodies_, queue_, modes_, flat_, group_),
      islands_(bodies_, modes_, group_, flat_, collapses_, flights_, paths_),
      merging_(bodies_, modes_, group_, flat_, flights_, paths_),
      guard_(world.body_count(), options.duration),
      impacts_(bodies_, {collapses_, flat_, group_, flights_, merging_, guard_}),
      appearances_(bodies_, initial),
      attends_(watches() || world.body_count() > cached_bodies) {
  start(initial);
}

/// Predicts the next events of the bodies that have changed. Those that are out of the world have none.
inline void ExactSimulator::predict_changed() {
  span<Entity> changed = flights_.take_changed();
  if (changed.size() > 2) [[unlikely]] {
    ranges::sort(changed);
    changed = changed.first(size_t(std::unique(changed.begin(), changed.end()) - changed.begin()));
  }

  for (const Entity i : changed) {
    if (!is_in_world(bodies_.mode(i))) [[unlikely]] {
      bodies_.body[i].event = ExactEvent{};
      queue_.remove(i);
    } else {
      predictor_.predict(i);
    }
  }
}

void ExactSimulator::start(const State& initial) {
  const World& world = bodies_.world;
  if (bodies_.options.merge && bodies_.ties.any())
    throw SimulationError("bodies with strings cannot merge: remove `strings`, or `merge`");

  const Entity n = world.body_count();
  for (Entity i = 0; i < n; ++i) {
    const Vec3& x = initial.position[i];
    if (world.comes_later(i)) {
      hold_back(i, x);
      continue;
    }
    Vec3 v = initial.velocity[i];
    if (!world.impulse.empty()) v += world.impulse[i] / world.mass[i];
    if (!world.forces.empty()) bodies_.apply_forces(i, x, v);
    bodies_.flights.set(i, {{}, x, v, bodies_.force_at(i, x, v), bodies_.fade[i]});
    bodies_.note_speed(i, v);
  }

  const double close = impacts_.at_once.close_times(initial);
  queue_.set_close(close);
  guard_.set_close(close);
  bodies_.neighbours.start(initial.position);

  // Contacts at the start: with flat surfaces, with other things, along strings.
  if (!bodies_.options.merge) {
    for (Entity i = 0; i < n; ++i)
      if (is_in_world(bodies_.mode(i)) && !bodies_.applied[i].isZero(0) && !bodies_.bent[i]) flat_.find_initial(i);
    // Where no force acts, nothing presses.
    if (!(world.gravity.isZero(0) && world.forces.empty()))
      for (Entity i = 0; i < n; ++i)
        if (is_in_world(bodies_.mode(i))) group_.join_initial(i);
    if (bodies_.ties.any()) group_.join_by_strings();
  }

  // Forces between bodies.
  vector<uint8_t> coupled(bodies_.couplings.any() ? n : 0, 0);
  for (Entity i = 0; i < coupled.size(); ++i)
    if (coupled[i] == 0)
      for (const Entity k : couple(i)) coupled[k] = 1;

  for (Entity i = 0; i < n; ++i)
    if (bodies_.flies_in_steps(i) && bodies_.mode(i) == Mode::flying) flights_.let_fall(i);

  // The first events, then the first steps of islands.
  predictor_.predict_all();
  if (bodies_.islands.any())
    for (Entity i = 0; i < n; ++i)
      if (bodies_.mode(i) == Mode::fresh) begin_island(i);
  predict_changed();

  for (Entity i = 0; i < n; ++i) paths_.note_change(i);
  paths_.record_changes();
  if (bodies_.log.has_noted()) set_off(bodies_.now);
}

/// Keeps body i, which comes later, out of the world, at x (m).
void ExactSimulator::hold_back(Entity i, const Vec3& x) {
  bodies_.merged.remove(i);
  bodies_.flights.set(i, {{}, x, Vec3::Zero(), Vec3::Zero()});
  modes_.hold_back(i);
}

/// Makes the first step of body i's island an event, because it may be an impact, as by an impulse along a rod.
void ExactSimulator::begin_island(Entity i) {
  bodies_.islands.of(i).end = bodies_.now;
  for (const Entity k : bodies_.islands.of(i).members) flights_.note_changed(k);
}

void ExactSimulator::advance_to(double time) {
  bodies_.log.begin_advance();
  paths_.begin_advance();
  crossings_.begin_advance();
  answers_.state_fresh = false;

  const Instant until{min(time, bodies_.options.duration), 0};
  const auto before_now = [&] { return std::nextafter(bodies_.now.hi, 0); };
  uint32_t events = 0;

  do {
    // The buffer of crossings is full. More may happen at the instant of the last one.
    if (attends_ && crossings_.full()) {
      time_ = max(time_, std::nextafter(crossings_.recorded().back().time, 0));
      return crossings_.sort();
    }

    while (queue_.first_time() <= until.hi) {
      const Entity i = queue_.first();
      if (attends_ && bodies_.world.body_count() > cached_bodies) prefetch_.look_ahead();
      if (!queue_.leaves_first(i) && !(bodies_.body[i].event.time <= until)) break;
      if (attends_ && watches()) [[unlikely]] {
        if (is_over()) break;
        if (happens_before(queue_.leaves_first(i) ? Instant{queue_.first_time(), 0} : bodies_.body[i].event.time,
                           false)) {
          if (crossings_.full()) break;
          continue;
        }
      }

      events += take_event(i);
      if (bodies_.log.has_noted()) [[unlikely]]
        set_off(bodies_.now);

      // After many events without a result, the caller may need to check the clock.
      if (events >= events_at_a_time && before_now() > time_) {
        time_ = before_now();
        return crossings_.sort();
      }

      // A buffer is full. Stop just before the present instant, because more may happen at it.
      if (paths_.full() || (attends_ && crossings_.full()) || !bodies_.log.has_room(collisions_of_event)) {
        time_ = max(time_, before_now());
        return crossings_.sort();
      }
    }
  } while (attends_ && (crossings_.full() || happens_before(until, true)));

  paths_.record_changes();
  crossings_.sort();
  time_ = max(time, time_);

  // At the run's end, the last flights and the work along paths are booked.
  if (time_ < bodies_.options.duration) return;
  book_last(time_);
}

/// Takes body i's next event, or its exit from its region. Returns how many events take as long.
uint32_t ExactSimulator::take_event(Entity i) {
  ++effort_.events;
  if (!queue_.leaves_first(i)) return process(i);
  if (bodies_.now.hi < queue_.first_time()) bodies_.now = {queue_.first_time(), 0};
  ++effort_.regions;
  predictor_.renew_region(i);
  bodies_.neighbours.tidy();
  guard_.count(StallGuard::Happened::region_left, bodies_.now.hi);
  return 1;
}

uint32_t ExactSimulator::process(Entity i) {
  using Kind = ExactEvent::Kind;
  const ExactEvent event = bodies_.body[i].event;
  uint32_t weight = 1;

  bodies_.neighbours.prefetch_list(i);
  if (event.kind == Kind::body_body) bodies_.neighbours.prefetch_list(event.partner);
  if (bodies_.now < event.time) bodies_.now = event.time;

  switch (event.kind) {
    case Kind::body_body:
      if (bodies_.body[event.partner].version != event.partner_version) {
        // The partner's path has changed since.
        flights_.note_changed(i);
        break;
      }
      interrupt(event.partner);
      if (!strike_at_once(i, event)) {
        for (const Entity k : {i, event.partner}) flights_.end_step(k);
        impacts_.of_two.collide_pair(min(i, event.partner), max(i, event.partner), event.feature);
      }
      break;

    case Kind::body_fixed:
      if (strike_at_once(i, event)) break;
      flights_.end_step(i);
      impacts_.of_two.collide_fixed(i, event.partner, event.feature);
      break;
    case Kind::string:
      go_taut(i, event);
      break;
    case Kind::force:
      take_switch(i);
      break;

    case Kind::rest:
      flat_.end_bounces(i);
      flights_.note_changed(i);
      break;
    case Kind::release:
      slide_off(i, event.partner, event.feature);
      break;

    case Kind::step:
      if (is_member(bodies_.mode(i)) && event.time == bodies_.islands.of(i).end) {
        weight = events_of_a_step * uint32_t(bodies_.islands.of(i).members.size());
        islands_.advance(i);
      } else {
        end_flight(i);
      }
      break;
    case Kind::none:
      break;
  }

  // What has changed gets its next events.
  predict_changed();
  guard_.count(ExactEvent::is_impact(event.kind) ? StallGuard::Happened::impact : StallGuard::Happened::other,
               bodies_.now.hi);
  return weight;
}

/// A body of a crowd is struck: the crowd's step ends.
void ExactSimulator::interrupt(Entity thing) {
  if (thing != no_entity && bodies_.mode(thing) == Mode::stepped) islands_.interrupt(thing);
}

/// A string of body i goes taut, unless the path of the body at its other end has changed since it was predicted.
void ExactSimulator::go_taut(Entity i, const ExactEvent& event) {
  const Entity other = bodies_.ties.other(event.partner, i);
  if (other != no_entity && bodies_.body[other].version != event.partner_version) return flights_.note_changed(i);
  for (const Entity k : {i, other}) interrupt(k);
  impacts_.at_once.strike({i, event.partner, event.feature});
}

/// Resolves an impact together with others of its instant. Returns false, and changes nothing, where there are none.
inline bool ExactSimulator::strike_at_once(Entity i, const ExactEvent& event) {
  if (!event.tied && !queue_.close_at(bodies_.now.hi) && !impacts_.at_once.some_act_at_once() &&
      !guard_.may_be_endless()) [[likely]]
    return false;
  return may_be_simultaneous(i, event) && impacts_.at_once.strike({i, event.partner, event.feature});
}

/// Whether other impacts may happen at the instant of this one, which may be tied, plastic or near one of strings.
/// Crowds resolve theirs by themselves, and bodies that merge do so one after the other.
bool ExactSimulator::may_be_simultaneous(Entity i, const ExactEvent& event) {
  const bool body = event.kind == ExactEvent::Kind::body_body;
  if (bodies_.options.merge || bodies_.mode(i) == Mode::stepped) return false;
  if (body && bodies_.mode(event.partner) == Mode::stepped) return false;
  if (event.tied || queue_.close_at(bodies_.now.hi) || guard_.may_be_endless()) return true;
  if (pair_restitution(bodies_.world, i, event.partner) == 0) return true;
  return !bodies_.ties.of(i).empty() || (body && !bodies_.ties.of(event.partner).empty());
}

/// Applies a switch at the present instant to body i: of a force on it, or of the velocity of things that carry it.
/// Otherwise the body flies on, and may meet such things elsewhere.
void ExactSimulator::take_switch(Entity i) {
  if (bodies_.moving.any()) {
    const bool forced = bodies_.forced && bodies_.next_switch(i, std::nextafter(bodies_.now.hi, -1)) == bodies_.now.hi;
    if (!forced && !flat_.switches(i) && !group_.switches(i)) return flights_.note_changed(i);
  }
  flights_.end_step(i);
  switch_forces(i);
}

/// Sets the times that wait for events that are sure at an instant, at present or later. They lie ahead of it, by
/// rounding at least, so that what happens then is an event as any other. Events and steps that were predicted without
/// them are found anew.
void ExactSimulator::set_off(const Instant& at) {
  const double next = at.lo < 0 ? at.hi : std::nextafter(at.hi, infinity);
  const double time = max(next, shortest_delay * bodies_.options.duration);
  while (bodies_.log.has_noted()) bodies_.merged.set_off(bodies_.log.take_noted(time), time);

  bodies_.islands.for_each([&](const Island& island) {
    for (const shared_ptr<Crowd>& crowd : island.crowds) crowd->step.next_switch = bodies_.now;
    interrupt(island.members.front());
  });
  for (Entity i = 0; i < bodies_.world.body_count(); ++i)
    if (is_in_world(bodies_.mode(i))) flights_.note_changed(i);
  predict_changed();
  appearances_.try_again();
}

/// Cuts the strings of body i that hold until now.
void ExactSimulator::cut_strings(Entity i) {
  const vector<Entity> strings(bodies_.ties.of(i).begin(), bodies_.ties.of(i).end());
  for (const Entity string : strings) {
    if (bodies_.world.string(string).until > bodies_.now.hi) continue;
    const Entity other = bodies_.ties.other(string, i);
    bodies_.ties.cut(string);
    if (other == no_entity) continue;
    flights_.end_step(other);
    switch_forces(other);
  }
}

/// Ends body i's flight, and begins the next under the present forces and on the present surfaces.
void ExactSimulator::switch_forces(Entity i) {
  if (bodies_.ties.any()) cut_strings(i);
  const Vec3 x = bodies_.position(i);
  const Vec3 v = bodies_.velocity(i);
  paths_.note_change(i);
  flights_.book(i, x, bodies_.now);
  bodies_.flights.set(i, {bodies_.now, x, v, bodies_.flights.acceleration(i)});
  if (bodies_.mode(i) == Mode::asleep) group_.wake(i);

  if (is_member(bodies_.mode(i))) bodies_.islands.of(i).end = bodies_.now;

  bodies_.apply_forces(i, x, v);
  if (bodies_.bent[i]) flat_.clear(i);
  flights_.begin(i, x, flat_.keep_at(i, v), {});
  if (bodies_.couplings.any()) couple(i);
}

/// Puts body i, and all bodies that forces connect with it now, into one island, unless they are in one. Returns them.
vector<Entity> ExactSimulator::couple(Entity i) {
  vector<Entity> all = group_.coupled_with(i);
  const auto is_there = [&](Entity k) {
    return is_member(bodies_.mode(k)) && is_member(bodies_.mode(i)) && bodies_.islands.same(i, k);
  };
  if (all_of(all, is_there)) return all;

  for (const Entity k : all)
    if (!is_member(bodies_.mode(k))) flights_.end_step(k);
  group_.couple(all);
  for (const Entity k : all) flights_.note_changed(k);
  return all;
}

/// Body i slides over the rim of the face that carries it: onto a level face, or off. In the second case the rim's edge
/// is what it touched last.
void ExactSimulator::slide_off(Entity i, Entity surface, uint8_t edge) {
  const FlightOrigin next = flat_.hand_over(i, surface);
  flights_.begin(i, bodies_.position(i), bodies_.velocity(i),
                 next.partner == no_entity ? FlightOrigin{surface, edge} : next);
}

/// Ends a step of body i's own flight, or discards it if another flight has begun since.
void ExactSimulator::end_flight(Entity i) {
  const PolynomialPath* const curve = bodies_.flights.curve(i);
  if (curve != nullptr && bodies_.flights[i].start + curve->length <= bodies_.now)
    flights_.take_step(i);
  else
    flights_.note_changed(i);
}

bool ExactSimulator::watches() const {
  const ExactOptions& options = bodies_.options;
  const bool stops = options.stop_at_rest || options.stop_collisions > 0;
  return crossings_.any() || stops || !bodies_.world.appears.empty();
}

/// When everything at the present instant has happened, and the next event is at `next`: ends the run, or takes a
/// crossing or what comes into the world before that. `at_it`: or at that instant. Returns whether either has happened.
bool ExactSimulator::happens_before(const Instant& next, bool at_it) {
  if (is_over()) return false;
  if (!at_it && !(bodies_.now < next)) return false;

  const ExactOptions& options = bodies_.options;
  if (options.stop_collisions > 0 && tally().collisions() >= options.stop_collisions) {
    end_run(bodies_.now.hi, EndReason::collisions, 0);
  } else if (options.stop_at_rest && all_rest()) {
    end_run(bodies_.now.hi, EndReason::rest, 0);
  } else {
    // The first of both.
    paths_.record_changes();
    const Instant sure = crossings_.first_sure();
    const Instant comes = appearances_.any() ? appearances_.next() : Instant{never, 0};
    const Instant first = min(sure, comes);
    if (!(at_it ? first <= next : first < next) || first.hi > options.duration) return false;
    if (comes < sure) {
      take_appearances(comes);
      return true;
    }
    take_crossing(crossings_.take());
    if (!is_over()) return true;
  }

  // The run has ended. What else crosses at that instant happens too.
  const double end = tally().end->time;
  while (const optional<Crossings::Taken> taken = crossings_.take_until(end)) take_crossing(*taken);
  return true;
}

/// Does what a region does to a body that enters it. What it removes crosses all that it meets at that instant before.
void ExactSimulator::take_crossing(const Crossings::Taken& taken) {
  const RegionCrossing& crossing = taken.crossing;
  const WorldRegion& region = bodies_.world.regions[crossing.region];
  bodies_.log.note(crossing);
  guard_.count(StallGuard::Happened::region_crossed, crossing.time);

  if (crossing.enters && region.removes) {
    while (const optional<Crossings::Taken> other = crossings_.take_of(crossing.body, taken.at)) {
      bodies_.log.note(other->crossing);
      const WorldRegion& met = bodies_.world.regions[other->crossing.region];
      if (other->crossing.enters && met.stops) end_by(*other);
    }

    // The islands that lose the body take a step at once.
    if (bodies_.now < taken.at) bodies_.now = taken.at;
    paths_.note_change(crossing.body);
    interrupt(crossing.body);
    for (const Entity k : BodyRemoval(bodies_, modes_, group_, flat_, flights_).remove(crossing.body))
      if (is_member(bodies_.mode(k))) islands_.advance(k);
    predict_changed();
    paths_.delay(taken.sure);
    guard_.count(StallGuard::Happened::other, bodies_.now.hi);
  }

  if (bodies_.log.has_noted()) {
    if (bodies_.now < taken.at) bodies_.now = taken.at;
    set_off(taken.sure);
  }
  if (crossing.enters && region.stops) end_by(taken);
}

/// Lets the bodies come into the world that are due at an instant and have room.
void ExactSimulator::take_appearances(const Instant& at) {
  if (bodies_.now < at) bodies_.now = at;
  while (const optional<Appearances::Admitted> admitted = appearances_.take()) admit(*admitted);
}

/// Lets a body come into the world at present. It begins as the others did at the start.
void ExactSimulator::admit(const Appearances::Admitted& admitted) {
  const auto& [i, x, v] = admitted;
  const World& world = bodies_.world;

  paths_.note_change(i);
  modes_.appear(i);
  bodies_.merged.admit(i);
  bodies_.apply_forces(i, x, v);
  bodies_.flights.set(i, {bodies_.now, x, v, bodies_.force_at(i, x, v), bodies_.fade[i]});
  bodies_.note_speed(i, v);
  bodies_.log.appear(0.5 * world.mass[i] * v.squaredNorm() + bodies_.merged.potential(i, x), world.mass[i] * v);
  crossings_.note_appearance(i);

  // Its contacts. They are found between flights that begin at present.
  const vector<Entity> near = bodies_.neighbours_of(i);
  for (const Entity e : near) {
    if (!world.is_body(e)) continue;
    interrupt(e);
    const Vec3 xe = bodies_.position(e);
    if (touch(world, i, x, e, xe).gap > 2 * bodies_.contact_gap(i, x, xe)) continue;
    flights_.end_step(e);
    switch_forces(e);
  }
  if (!bodies_.options.merge) {
    if (!bodies_.applied[i].isZero(0) && !bodies_.bent[i]) flat_.find_initial(i);
    if (!(world.gravity.isZero(0) && world.forces.empty())) group_.join_initial(i);
  }
  if (bodies_.flies_in_steps(i) && bodies_.mode(i) == Mode::flying) flights_.let_fall(i);

  flights_.count(i);
  flights_.note_changed(i);
  if (bodies_.mode(i) == Mode::fresh) begin_island(i);
  predict_changed();
  guard_.count(StallGuard::Happened::other, bodies_.now.hi);
}

/// Ends the run by a crossing, unless it is over.
void ExactSimulator::end_by(const Crossings::Taken& taken) {
  if (is_over()) return;
  if (bodies_.now < taken.at) bodies_.now = taken.at;
  end_run(bodies_.now.hi, EndReason::region, taken.crossing.region);
}

/// Ends the run at `time` (s), the present instant or just before it.
void ExactSimulator::end_run(double time, EndReason reason, uint32_t region) {
  time = max({time, time_, paths_.latest()});
  bodies_.log.end({time, reason, region});
  paths_.end(time);
  book_last(time);
}

/// Books all that goes on at `time` (s), the run's end.
void ExactSimulator::book_last(double time) {
  bodies_.islands.for_each([&](const Island& island) { bodies_.contact_work.end_paths(island.members, {time, 0}); });
  if (!flights_.has_ended()) islands_.book_last(time);
  flights_.book_last(time);
}

/// Whether body i stays where it is until another body comes.
bool ExactSimulator::rests(Entity i) const {
  if (!is_in_world(bodies_.mode(i))) return true;
  const double past = bodies_.now.floor();
  const double end = bodies_.options.duration;

  if (bodies_.forced && bodies_.next_switch(i, past) < end) return false;
  if (bodies_.moving.any()) {
    const ExactEvent& event = bodies_.body[i].event;
    if (event.kind == ExactEvent::Kind::body_fixed && event.time.hi < end) return false;
    for (const Entity e : bodies_.neighbours.surfaces(i))
      if (bodies_.moving.next_switch(e, bodies_.now).hi < end) return false;
  }

  if (bodies_.mode(i) == Mode::asleep) return true;
  if (bodies_.mode(i) == Mode::settling) return false;

  const Flight f = bodies_.flights[i];
  if (!f.v.isZero(0) || is_kicked(bodies_.mode(i))) return false;
  if (f.curve == nullptr) return f.a.isZero(0);
  return all_of(f.curve->displacement, [](const Vec3& term) { return term.isZero(0); });
}

/// Whether all bodies rest. The search begins at a body that moved before, so that it seldom goes far.
bool ExactSimulator::all_rest() {
  if (appearances_.any() && appearances_.next().hi < bodies_.options.duration) return false;
  const Entity n = bodies_.world.body_count();
  for (Entity looked = 0; looked < n; ++looked) {
    if (!rests(answers_.awake)) return false;
    answers_.awake = answers_.awake + 1 == n ? 0 : answers_.awake + 1;
  }
  return true;
}

/// Prefetched data and answers to queries are left out.
template <typename Archive>
void ExactSimulator::keep(Archive& archive) {
  const World& world = bodies_.world;
  const ExactOptions& options = bodies_.options;
  archive.same(world.body_count(), world.entity_count(), world.forces.size(), options.watch.size(),
               options.impulses.size());
  archive.same(options.duration, options.merge, options.record_collisions, options.record_paths);

  archive(bodies_, crossings_, paths_, collapses_, modes_, flat_, group_, flights_, queue_, predictor_);
  archive(islands_, guard_, appearances_, effort_, time_);
}

string ExactSimulator::save() {
  StateWriter archive;
  keep(archive);
  return archive.take();
}

void ExactSimulator::restore(string_view bytes) {
  StateReader archive(bytes, bodies_.world);
  keep(archive);
  archive.finish();
  for (uint32_t k = 0; k < tally().changes.fired.size(); ++k)
    if (tally().changes.fired[k] < not_yet) bodies_.merged.set_off(k, tally().changes.fired[k]);
  answers_ = {};
}

Effort ExactSimulator::effort() const {
  Effort effort = effort_;
  effort.pair_tests = predictor_.pair_tests();
  effort.surface_tests = predictor_.surface_tests();
  effort.inexact_steps = islands_.inexact_steps();
  effort.next = queue_.first_time();
  return effort;
}

const State& ExactSimulator::state() {
  if (answers_.state_fresh) return answers_.state;

  const World& world = bodies_.world;
  answers_.state.time = is_over() ? tally().end->time : time_;
  const Instant at{answers_.state.time, 0};

  answers_.state.position.resize(world.body_count());
  answers_.state.velocity.resize(world.body_count());
  for (Entity i = 0; i < world.body_count(); ++i) {
    answers_.state.position[i] = flights_.position_of_method(i, at);
    answers_.state.velocity[i] = flights_.velocity_of_method(i, at);
  }

  if (bodies_.merged.any()) {
    answers_.state.mass = world.mass;
    answers_.state.radius = world.radius;
    answers_.state.volume = world.volume;
    answers_.state.part_of = bodies_.merged.whole_of();
    answers_.state.join_parts();
  }

  answers_.state.fired = fired_by(tally().changes.fired, answers_.state.time);
  answers_.state_fresh = true;
  return answers_.state;
}

span<const ContactForce> ExactSimulator::contacts() {
  answers_.contact_forces.clear();
  for (Entity i = 0; i < bodies_.world.body_count(); ++i) {
    if (lies_on_flat(bodies_.mode(i))) flat_.report(i, answers_.contact_forces);
    group_.report(i, answers_.contact_forces);
  }
  bodies_.islands.for_each([&](const Island& island) {
    if (bodies_.mode(island.members.front()) != Mode::fresh) islands_.report(island, time_, answers_.contact_forces);
  });
  ranges::sort(answers_.contact_forces,
               [](const ContactForce& p, const ContactForce& q) { return pair(p.a, p.b) < pair(q.a, q.b); });
  return answers_.contact_forces;
}

}  // namespace carom
