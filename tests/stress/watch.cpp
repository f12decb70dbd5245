#include "stress/watch.h"

#include <ctime>

#include "physics/world.h"
#include "std.h"
#include "stress/digits.h"
#include "stress/seen_otherwise.h"

namespace carom::stress {

namespace {

constexpr size_t most_collisions_sampled = 60;
constexpr int looks = 24;

bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

}  // namespace

Watched watch(const RandomScene& scene, const vector<double>& times, double patience) {
  Watched run;
  const std::clock_t begin = std::clock();
  unique_ptr<Simulator> simulator;
  const auto keep = [&] {
    run.records.insert(run.records.end(), simulator->collisions().begin(), simulator->collisions().end());
    for (const PathPiece& piece : simulator->paths()) run.pieces[piece.body].push_back({piece.from, piece.kicked});
  };

  try {
    ExactOptions options = scene.options;
    options.record_paths = !times.empty();
    run.pieces.resize(scene.world.body_count());
    simulator = make_exact_simulator(scene.world, scene.initial, options);
    keep();
    run.start = simulator->state();

    const auto go_to = [&](double time) {
      do {
        simulator->advance_to(time);
        keep();
        run.too_slow = static_cast<double>(std::clock() - begin) > patience * CLOCKS_PER_SEC;
      } while (simulator->time() < time && !run.too_slow);
    };

    for (const double t : times) {
      go_to(t);
      if (run.too_slow) return run;
      run.seen.push_back(simulator->state());
    }

    go_to(scene.options.duration);
    run.end = simulator->state();
    run.tally = simulator->tally();
  } catch (const SimulationError& error) {
    run.error = error.what();
    if (simulator) keep();
  }
  return run;
}

vector<double> sample_times(const RandomScene& scene, const vector<Collision>& records) {
  const double duration = scene.options.duration;
  vector<double> times;
  for (int k = 1; k <= looks; ++k) times.push_back(duration * k / looks);

  const auto about = [&](double t) {
    if (t > 0) times.push_back(std::nextafter(t, 0));
    times.push_back(t);
    times.push_back(std::nextafter(t, duration));
  };

  const size_t stride = records.size() / most_collisions_sampled + 1;
  for (size_t k = 0; k < records.size(); ++k)
    if (k < most_collisions_sampled / 2 || k % stride == 0) about(records[k].time);

  for (const Force& f : scene.world.forces)
    for (const double t : {f.from, f.until})
      if (t > 0 && t < duration) about(t);
  for (const SurfaceMotion& motion : scene.world.motions)
    for (const MotionLeg& leg : motion.legs)
      if (leg.from > 0 && leg.from < duration) about(leg.from);

  times.erase(std::remove_if(times.begin(), times.end(), [&](double t) { return !(t >= 0 && t <= duration); }),
              times.end());
  ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

RandomScene scaled(RandomScene scene, int length, int time, int mass) {
  scale(scene.world, scene.initial, scene.options.duration, scene.options.rest_speed, {length, time, mass});
  return scene;
}

string difference(const Watched& a, const Watched& b, int length, int time, int mass) {
  if (a.error.empty() != b.error.empty()) return "one ends with an error: " + a.error + b.error;
  const double l = std::ldexp(1, -length), t = std::ldexp(1, -time), m = std::ldexp(1, -mass), v = l / t;

  const auto vectors = [](const Vec3& p, const Vec3& q) {
    return same(p.x(), q.x()) && same(p.y(), q.y()) && same(p.z(), q.z());
  };

  const size_t n = std::min(a.records.size(), b.records.size());
  for (size_t k = 0; k < n; ++k) {
    const Collision &c = a.records[k], &d = b.records[k];
    if (c.kind != d.kind || c.a != d.a || c.b != d.b || !same(c.time, d.time * t) || !vectors(c.normal, d.normal) ||
        !vectors(c.position, d.position * l) || !same(c.approach_speed, d.approach_speed * v) ||
        !same(c.separation_speed, d.separation_speed * v) || !same(c.impulse, d.impulse * m * v) ||
        !same(c.energy_lost, d.energy_lost * m * v * v))

      return "record " + to_string(k) + " of " + to_string(n) + ", at t = " + text(c.time) + " and " +
             text(d.time * t) + " between " + to_string(c.a) + " and " + to_string(c.b) + " or " + to_string(d.a) +
             " and " + to_string(d.b);
  }

  if (a.records.size() != b.records.size())
    return to_string(a.records.size()) + " records and " + to_string(b.records.size());
  if (!a.error.empty()) return {};

  for (size_t i = 0; i < a.end.position.size(); ++i)
    if (!vectors(a.end.position[i], b.end.position[i] * l) || !vectors(a.end.velocity[i], b.end.velocity[i] * v))
      return "body " + to_string(i) + " at the end, though all records are the same";

  if (!same(a.tally.energy_lost, b.tally.energy_lost * m * v * v)) return "energy lost";
  if (a.tally.resting != b.tally.resting) return "bodies at rest";
  return {};
}

RandomScene turned(RandomScene scene) {
  World& world = scene.world;
  bool cylinders = false;
  const auto note_shape = [&](const Volume& v) { cylinders = cylinders || v.shape == Shape::cylinder; };
  for (const Volume& v : world.volume) note_shape(v);
  for (const Obstacle& o : world.obstacles) note_shape(o.volume);

  const auto turn = [&](Vec3& v) { v = cylinders ? Vec3(v.z(), v.y(), v.x()) : Vec3(v.z(), v.x(), v.y()); };
  each_vector(world, scene.initial, turn);
  for (Volume& v : world.volume) turn(v.half);
  for (Obstacle& o : world.obstacles) turn(o.volume.half);
  if (cylinders) right_walls(world);
  return scene;
}

}  // namespace carom::stress
