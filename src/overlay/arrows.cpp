// The scale is constant in time, so that the lengths of a film can be compared. It comes from the scene at time 0.
#include "overlay/arrows.h"

#include "physics/coupled_forces.h"
#include "physics/force.h"
#include "scene/color_scale.h"
#include "std.h"

namespace carom {
namespace {

constexpr double longest = 6;                           // median radii, of a typical arrow
constexpr double shaft_radius = 0.1;                    // median radii
constexpr double head_radius = 0.3, head_length = 0.9;  // median radii
constexpr double least_width = 2;                       // pixels
constexpr double usual_gravity = 9.80665;               // m/s^2

struct ArrowText {
  string_view name, unit;
  uint32_t rgb;
};

// In the order of ArrowScale::Kind.
constexpr array<ArrowText, 3> arrow_texts = {
    {{"velocity", "m/s", 0x2b7bba}, {"momentum", "kg m/s", 0x3d9a50}, {"force", "N", 0xd9541e}}};

/// The force (N) of gravity and the scene's forces. coupled: m/s^2, by body, by forces between bodies.
Vec3 force_on(const Moment& moment, const vector<Vec3>& coupled, Entity body) {
  const double mass = mass_now(moment.world, moment.state, body);
  return mass * (coupled[body] + free_acceleration(moment.world, body, moment.state.time, moment.state.position[body],
                                                   moment.state.velocity[body]));
}

/// What arrows of this kind show of a body, in the kind's unit.
Vec3 shown_by(ArrowScale::Kind kind, const Moment& moment, const vector<Vec3>& coupled, Entity body) {
  const Vec3& velocity = moment.state.velocity[body];
  if (kind == ArrowScale::Kind::velocity) return velocity;
  if (kind == ArrowScale::Kind::force) return force_on(moment, coupled, body);
  return mass_now(moment.world, moment.state, body) * velocity;
}

double greatest_force(const Scene& scene) {
  const World& world = scene.world;
  const vector<Vec3> coupled = coupled_accelerations(world, scene.initial);
  double greatest = 0, heaviest = 0;
  for (Entity i = 0; i < world.body_count(); ++i) {
    const Vec3 a = free_acceleration(world, i, 0, scene.initial.position[i], scene.initial.velocity[i]);
    greatest = max(greatest, world.mass[i] * (a + coupled[i]).norm());
    heaviest = max(heaviest, world.mass[i]);
  }
  return greatest > 0 ? greatest : heaviest * usual_gravity;
}

/// The distance (m) from the centre to the surface along a unit vector.
double way_out(const Volume& volume, const Vec3& along) {
  const auto through = [&](int axis) {
    const double part = std::abs(along[axis]);
    return part > 0 ? volume.half[axis] / part : infinity;
  };

  switch (volume.shape) {
    case Shape::sphere:
      return volume.half.x();
    case Shape::cylinder: {
      const double across = hypot(along.x(), along.z());
      return across > 0 ? min(volume.half.x() / across, through(1)) : through(1);
    }
    case Shape::box:
      return min({through(0), through(1), through(2)});
  }
  return 0;
}

void add_arrow(const Vec3& start, const Vec3& arrow, double size, const Color& color, vector<Stroke>& strokes) {
  const double length = arrow.norm();
  // A short arrow is a head alone, in proportion.
  const double head = min(head_length * size, length), scale = head / (head_length * size);
  const Vec3 neck = start + (length - head) / length * arrow;

  const auto add = [&](const Vec3& from, const Vec3& to, double from_radius, double to_radius) {
    Stroke stroke;
    stroke.from = from;
    stroke.to = to;
    stroke.from_radius = from_radius;
    stroke.to_radius = to_radius;
    stroke.least_width = least_width;
    stroke.color = color;
    strokes.push_back(stroke);
  };

  if (length > head) add(start, neck, shaft_radius * size, shaft_radius * size);
  add(neck, start + arrow, scale * head_radius * size, 0);
}

}  // namespace

Color ArrowScale::color() const {
  return from_rgb(arrow_texts[size_t(kind)].rgb);
}

string_view ArrowScale::name() const {
  return arrow_texts[size_t(kind)].name;
}

string_view ArrowScale::unit() const {
  return arrow_texts[size_t(kind)].unit;
}

vector<ArrowScale> arrow_scales(const Scene& scene) {
  vector<ArrowScale> scales;
  if (scene.world.body_count() == 0) return scales;
  const double size = median_radius(scene.world);
  const auto add = [&](ArrowScale::Kind kind, double greatest) {
    scales.push_back({kind, rounded_up(greatest), longest * size, size});
  };

  if (scene.overlay.velocity_arrows || scene.overlay.momentum_arrows) {
    double speed = 0;     // m/s
    double momentum = 0;  // kg m/s
    for (Entity i = 0; i < scene.world.body_count(); ++i) {
      const double expected = expected_speed(scene, i);
      speed = max(speed, expected);
      momentum = max(momentum, scene.world.mass[i] * expected);
    }
    if (scene.overlay.velocity_arrows) add(ArrowScale::Kind::velocity, speed);
    if (scene.overlay.momentum_arrows) add(ArrowScale::Kind::momentum, momentum);
  }

  // Without gravity and forces no arrow is ever drawn.
  if (scene.overlay.force_arrows &&
      !(scene.world.gravity.isZero(0) && scene.world.forces.empty() && !has_couplings(scene.world)))
    add(ArrowScale::Kind::force, greatest_force(scene));
  return scales;
}

void add_arrows(const Moment& moment, const vector<ArrowScale>& scales, vector<Stroke>& strokes) {
  if (scales.empty()) return;
  const World& world = moment.world;
  vector<Vec3> coupled;
  if (any_of(scales, [](const ArrowScale& scale) { return scale.kind == ArrowScale::Kind::force; }))
    coupled = coupled_accelerations(world, moment.state);
  for (Entity body = 0; body < world.body_count(); ++body) {
    if (moment.is_part(body)) continue;
    const Vec3& x = moment.state.position[body];

    for (const ArrowScale& scale : scales) {
      const Vec3 arrow = scale.length / scale.typical * shown_by(scale.kind, moment, coupled, body);
      const double length = arrow.norm();
      if (length < 0.25 * moment.pixel_at(x)) continue;

      const Vec3 along = arrow / length;
      const Volume volume = volume_now(world, moment.state, body);
      add_arrow(x + way_out(volume, along) * along, arrow, scale.size, scale.color(), strokes);
    }
  }
}

}  // namespace carom
