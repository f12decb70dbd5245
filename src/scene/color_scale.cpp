// A run does not know its extremes before it ends. The scale of a speed therefore comes from energy: a fall from the
// start is what most scenes turn into speed. A scale from the run itself would need a second run, and runs of a sweep
// would get scales that differ by chance.
#include "scene/color_scale.h"

#include "physics/world.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

constexpr double most_collisions = 10;

/// The way (m) of a volume at x along the unit vector `down` to the nearest plane.
double way_to_plane(const World& world, const Volume& volume, const Vec3& x, const Vec3& down) {
  double way = infinity;
  for (const Plane& plane : world.planes) {
    const double approach = -plane.normal.dot(down), height = plane.normal.dot(x - plane.point);
    if (approach > 0 && height >= 0) way = min(way, max(0.0, height - volume.support(plane.normal)) / approach);
  }
  return way;
}

/// The way (m) of a volume at x down to the lowest wall or obstacle. Negative: all of them are higher.
double way_to_lowest(const World& world, const Volume& volume, const Vec3& x, const Vec3& down) {
  double way = -infinity;
  for (const Wall& wall : world.walls)
    way = max(way, down.dot(wall.center - x) + wall.half_width * std::abs(wall.right.dot(down)) +
                       wall.half_height * std::abs(wall.up.dot(down)));
  for (const Obstacle& obstacle : world.obstacles)
    way = max(way, down.dot(obstacle.center - x) + obstacle.volume.support(down));
  return way - volume.support(down);
}

/// The way (m) from x down to the lowest place that strings from fixed points leave a body. Infinity: there is none.
double way_on_strings(const World& world, Entity body, const Vec3& x, const Vec3& down) {
  double way = infinity;
  for (const String& string : world.strings)
    if (string.body == body && string.other == no_entity && string.until == infinity)
      way = min(way, down.dot(string.anchor - x) + string.length);
  return max(way, 0.0);
}

enum class Rounding : uint8_t { down, up };

/// `value` > 0, rounded to two digits: 0.206155 up to 0.21. Two digits keep most masses and radii of authors.
double to_two_digits(double value, Rounding rounding) {
  const int exponent = int(floor(std::log10(value))) - 1;
  const double power = pow(10, std::abs(exponent));
  const double units = exponent < 0 ? value * power : value / power;
  // 0.3 / 0.01 is not 30.
  const double whole = rounding == Rounding::up ? ceil(units * (1 - 1e-9)) : floor(units * (1 + 1e-9));
  return exponent < 0 ? whole / power : whole * power;
}

/// Calls `use` with each body of this colouring.
template <typename Use>
void for_bodies(const Scene& scene, const Coloring& coloring, const Use& use) {
  for (const BodyRange& range : scene.roster.bodies) {
    if (range.coloring != coloring) continue;
    for (Entity i = range.first; i < range.first + range.count; ++i) use(i);
  }
}

ColorScale scale_from_scene(const Scene& scene, const Coloring& coloring) {
  const World& world = scene.world;
  double least = infinity, greatest = 0;
  const auto note = [&](double value) {
    least = min(least, value);
    greatest = max(greatest, value);
  };

  switch (coloring.by.value_or(ColorQuantity::group)) {
    case ColorQuantity::speed:
      for_bodies(scene, coloring, [&](Entity i) { note(expected_speed(scene, i)); });
      return {0, rounded_up(greatest)};

    case ColorQuantity::kinetic:
      for_bodies(scene, coloring, [&](Entity i) {
        const double speed = expected_speed(scene, i);
        note(0.5 * world.mass[i] * speed * speed);
      });
      return {0, rounded_up(greatest)};

    case ColorQuantity::collisions:
      return {0, most_collisions};
    case ColorQuantity::mass:
      for_bodies(scene, coloring, [&](Entity i) { note(world.mass[i]); });
      break;
    case ColorQuantity::radius:
      for_bodies(scene, coloring, [&](Entity i) { note(world.radius[i]); });
      break;
    case ColorQuantity::group:
      return {0, 1};
  }

  if (!(greatest > 0)) return {0, 1};  // there are no bodies
  return {least < greatest ? to_two_digits(least, Rounding::down) : 0, to_two_digits(greatest, Rounding::up)};
}

}  // namespace

double expected_speed(const Scene& scene, Entity body) {
  const World& world = scene.world;
  Vec3 v = scene.initial.velocity[body];
  if (!world.impulse.empty()) v += world.impulse[body] / world.mass[body];
  const double g = world.gravity.norm(), speed = v.norm();
  if (g == 0) return speed;
  const Vec3 down = world.gravity / g, &x = scene.initial.position[body];
  const Volume volume = world.volume_of(body);
  double fall = min(way_to_plane(world, volume, x, down), way_on_strings(world, body, x, down));
  if (fall == infinity) fall = way_to_lowest(world, volume, x, down);
  if (fall >= 0) return sqrt(speed * speed + 2 * g * fall);
  return (v + scene.simulate.duration * world.gravity).norm();
}

double rounded_up(double value) {
  if (!(value > 0)) return 1;
  const double power = pow(10, floor(std::log10(value)));
  // Rounding of the logarithm may take the power next to it.
  for (const double scale : {power / 10, power, 10 * power}) {
    for (const double mantissa : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
      if (const double candidate = mantissa * scale; candidate >= value * (1 - 1e-9)) return candidate;
  }
  return value;
}

ColorScale scale_of(const Scene& scene, const Coloring& coloring) {
  ColorScale scale = scale_from_scene(scene, coloring);
  scale.min = coloring.min.value_or(scale.min);
  scale.max = coloring.max.value_or(scale.max);
  return scale;
}

}  // namespace carom
