// Binds every member of the structs concerned to a name. A new member then does not compile until it is in the text.
#include "scene/motion_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <type_traits>

#include "physics/force.h"
#include "scene/engines.h"
#include "scene/fields.h"
#include "scene/member.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/value_json.h"

namespace carom {
namespace {

class MotionText {
 public:
  explicit MotionText(const Scene& scene) : scene_(scene) {}

  string run() {
    simulate();
    const auto& [mass, radius, volume, restitution, impulse, appears, pours, planes, walls, obstacles, motions, forces,
                 gravity, combine, pairs, regions, strings, springs, gravitations, triggers] = scene_.world;

    line("gravity", gravity, "combine", int(combine));
    for (const auto& [a_first, a_count, b_first, b_count, value] : pairs)
      line("pair", a_first, a_count, b_first, b_count, value);

    for (size_t i = 0; i < mass.size(); ++i) {
      line("body", mass[i], radius[i], restitution[i], scene_.initial.position[i], scene_.initial.velocity[i]);
      if (!volume.empty()) line("volume", volume[i]);
      if (!impulse.empty()) line("impulse", impulse[i]);
      if (!appears.empty()) line("appears", appears[i]);
    }
    for (const auto& [first, count, rate, center, within, seed] : pours)
      line("pour", first, count, rate, center, within, seed);

    // Fixed things.
    for (const auto& [point, normal, own] : planes) line("plane", point, normal, own);
    for (const auto& [center, normal, right, up, half_width, half_height, own] : walls)
      line("wall", center, normal, right, up, half_width, half_height, own);
    for (const auto& [center, shape, own, hollow] : obstacles) {
      line("obstacle", center, shape, own);
      if (hollow != Hollow::none) line("hollow", int(hollow));
    }
    for (size_t fixed = 0; fixed < motions.size(); ++fixed) write(fixed, motions[fixed]);

    for (const Force& force : forces) write(force);
    for (const WorldRegion& region : regions) write(region);
    for (const auto& [body, other, anchor, length, own, rod, until] : strings) {
      line("string", body, other, anchor, length, own, int(rod));
      if (until < infinity) line("until", until);
    }

    for (const auto& [a, b, stiffness, rest_length, damping, from, until] : springs)
      line("between", a, b, stiffness, rest_length, damping, from, until);
    for (const auto& [constant, softening, from, until, on] : gravitations) {
      line("gravitation", constant, softening, from, until);
      for (const Entity body : on) line("on", body);
    }

    // Times that events set.
    for (const auto& [entered, a, b] : triggers.all) {
      if (entered) line("entry", entered->first, entered->count);
      line("event", a.first, a.count, b.first, b.count);
    }
    for (const auto& [of, index, window, ends, trigger, after] : triggers.ends)
      line("at", int(of), index, window, int(ends), trigger, after);
    return std::move(text_);
  }

 private:
  void simulate() {
    Simulate simulate = scene_.simulate;
    simulate.engine = engine_of(scene_.world, simulate);
    line("simulate", text_of_json(json_of(kind_named("simulate"), &simulate)));
    if (simulate.stop_at_rest) line("rest");
    if (simulate.stop_collisions) line("collisions", *simulate.stop_collisions);
  }

  void write(const WorldRegion& region) {
    const auto& [position, volume, normal, on, removes, stops] = region;
    line("region", position, volume, normal, removes, stops);
    for (const Entity body : on) line("of", body);
  }

  void write(size_t fixed, const SurfaceMotion& motion) {
    const auto& [legs, every, gain, gain_low, swing, windows] = motion;
    for (const auto& [from, velocity, start, start_low] : legs) line("motion", fixed, from, velocity, start, start_low);
    if (every < infinity) line("every", fixed, every, gain, gain_low);
    for (const auto& [from, until, velocity] : windows) line("window", fixed, from, until, velocity);
    if (swing) line("swing", fixed, swing->period, swing->middle, swing->sine, swing->cosine);
  }

  void write(const Force& force) {
    const auto& [law, from, until, on] = force;
    std::visit([&, start = from, end = until](const auto& it) { line("force", it.name, it, start, end); }, law);
    for (const Entity body : on) line("on", body);
  }

  template <typename... Values>
  void line(const Values&... values) {
    (write(values), ...);
    text_.back() = '\n';
  }

  // The values, each followed by a blank.
  template <typename T>
  requires(std::is_arithmetic_v<T> || std::is_convertible_v<T, string_view>) void write(const T& value) {
    text_ += fmt::format("{} ", value);
  }
  template <typename T>
  void write(const optional<T>& value) {
    value ? write(*value) : write("-");
  }
  void write(const Vec3& v) {
    for (int k = 0; k < 3; ++k) write(v[k]);
  }
  void write(const Volume& volume) {
    const auto& [shape, half] = volume;
    write(int(shape));
    write(half);
  }
  void write(const UniformForce& law) { write(law.force); }
  void write(const UniformAcceleration& law) { write(law.value); }
  void write(const Drag& law) {
    const auto& [linear, quadratic, wind] = law;
    write(linear);
    write(quadratic);
    write(wind);
  }
  void write(const Spring& law) {
    const auto& [anchor, stiffness, rest_length, damping] = law;
    write(anchor);
    write(stiffness);
    write(rest_length);
    write(damping);
  }
  void write(const Attractor& law) {
    const auto& [center, strength, softening] = law;
    write(center);
    write(strength);
    write(softening);
  }

  const Scene& scene_;
  string text_;
};

}  // namespace

string motion_text(const Scene& scene) {
  return MotionText(scene).run();
}

}  // namespace carom
