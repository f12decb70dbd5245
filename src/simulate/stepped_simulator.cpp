#include "simulate/stepped_simulator.h"

#include <algorithm>

#include "simulate/stepped_releases.h"
#include "simulate/tolerances.h"

namespace carom {

namespace {

constexpr int steps_at_a_time = 4096;
constexpr std::size_t room_for_step = EventLog::capacity / 2;  // collisions; a step may have more

}  // namespace

std::unique_ptr<Simulator> make_stepped_simulator(const World& world, const State& initial,
                                                  const SteppedOptions& options) {
  return std::make_unique<SteppedSimulator>(world, initial, options);
}

SteppedSimulator::SteppedSimulator(const World& world, const State& initial, const SteppedOptions& options)
    : shared_(world, initial, options),
      motion_(shared_),
      events_(shared_.paths),
      predictor_(shared_, events_),
      binding_(shared_, motion_, predictor_.neighbours()),
      impacts_(shared_, motion_, predictor_, binding_, events_),
      group_(shared_, motion_, predictor_),
      view_(shared_, motion_.of_clusters(), group_) {
  for (Entity i = 0; i < world.body_count(); ++i) {
    if (shared_.clusters.holds(i)) continue;
    std::vector<Entity> bodies{i};
    binding_.bind(bodies, 0);
  }
}

void SteppedSimulator::advance_to(double time) {
  shared_.log.begin_advance();
  view_.clear();
  const double until = std::min(time, shared_.clock.duration());
  for (int steps = 0; shared_.clock.to() < until; ++steps) {
    if (steps == steps_at_a_time || !shared_.log.has_room(room_for_step)) {
      time_ = std::max(time_, shared_.clock.to());
      return;
    }
    do_step();
    predictor_.tidy();
  }
  time_ = std::max(time_, time);
}

void SteppedSimulator::do_step() {
  begin_step();
  bind_clusters();
  begin_paths();
  predict_events();
  for (StepEvent event; events_.pop(event);) impacts_.process(event);
  end_step();
}

/// The end of the last step becomes the beginning of this one.
void SteppedSimulator::begin_step() {
  shared_.awake.keep_if([&](Entity i) {
    shared_.paths.begin_step(i);
    if (shared_.bounces.joins_group(i)) shared_.group.join(i);
    shared_.bounces.begin_step(i);
    shared_.group.end_step(i);
    return !shared_.clusters.asleep(i);
  });
  shared_.paths.pieces.clear();
  predictor_.begin_step();
  shared_.clock.advance();
}

/// Clusters that move, and those that wake, are found anew.
void SteppedSimulator::bind_clusters() {
  const bool forces_change = shared_.clock.forces_change();
  std::vector<std::vector<Entity>> found;
  for (std::uint32_t c = 0; c < shared_.clusters.size(); ++c) {
    const Cluster& cluster = shared_.clusters[c];
    if (!cluster.in_use() || (cluster.asleep && !cluster.woken && !forces_change)) continue;
    std::vector<Entity> bodies;
    motion_.dissolve(c, 0, bodies);
    if (!joins_group(bodies)) {
      found.push_back(std::move(bodies));
      continue;
    }
    for (const Entity i : bodies) shared_.group.join(i);
  }
  for (std::vector<Entity>& bodies : found) {
    std::erase_if(bodies, [&](Entity i) { return shared_.clusters.holds(i); });  // bound with others before
    if (!bodies.empty()) binding_.bind(bodies, 0);
  }
}

/// Whether the bodies of a former cluster take this step with the contact group.
bool SteppedSimulator::joins_group(const std::vector<Entity>& bodies) const {
  return bodies.size() > stepped_tolerance::most_cluster_bodies ||
         std::any_of(bodies.begin(), bodies.end(), [&](Entity i) { return shared_.group.joined(i); });
}

/// All bodies' paths to the step's end, as if nothing met. Of those of the contact group, the paths that its step
/// finds.
void SteppedSimulator::begin_paths() {
  for (const Entity i : shared_.awake.list())
    if (!shared_.clusters.holds(i) && !shared_.group.joined(i)) motion_.begin(i);
  group_.step();
  for (std::uint32_t c = 0; c < shared_.clusters.size(); ++c)
    if (shared_.clusters[c].moves()) motion_.begin(shared_.clusters[c]);
}

void SteppedSimulator::predict_events() {
  predictor_.predict_step();
  for (std::uint32_t c = 0; c < shared_.clusters.size(); ++c)
    if (shared_.clusters[c].moves()) predict_releases(shared_, motion_.of_clusters(), shared_.clusters[c], events_);
}

/// All paths have come to the step's end: checks where they are and books what forces and contact have done.
void SteppedSimulator::end_step() {
  const StepPaths& paths = shared_.paths;
  const double length = shared_.clock.length();
  double strays = 0;  // m, what projecting clusters on their surfaces adds to displacements
  for (const Entity i : shared_.awake.list())
    if (shared_.clusters.holds(i))
      strays = std::max(strays, (paths.end_x[i] - paths.path[i].position(length - paths.start[i])).norm());
  predictor_.add_travel(strays);
  for (const Entity i : shared_.awake.list()) {
    shared_.check_bounds(i, paths.end_x[i], paths.end_v[i]);
    shared_.log.note_speed(paths.end_v[i].norm());
    const double work =
        shared_.free.works() ? motion_.book_work(i, paths.end_x[i], paths.end_v[i], length - paths.start[i]) : 0;
    if (shared_.group.in_step(i)) group_.book_energy(i, work);
  }
}

}  // namespace carom
