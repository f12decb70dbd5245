// The helix stands between two straight ends, outside of the body. Chords of a turn are off its circle of radius c by
// c (1 - cos(pi / n)), which is at most a quarter of a pixel.
#include "overlay/springs.h"

#include <numbers>
#include <variant>

#include "overlay/wire.h"
#include "physics/force.h"
#include "std.h"

namespace carom {
namespace {

constexpr double coil_radius = 0.4;  // of the body's radius
constexpr double thickness = 0.15;   // of the coil's radius
constexpr double lead = 0.08;        // of a spring's length, straight at the anchor and at the body
constexpr double pitch = 1.5;        // of the coil's radius, at rest
constexpr double fewest_turns = 4, most_turns = 24;
constexpr double most_chords = 48;  // of a turn

/// A frame whose third axis is `along`. It turns smoothly with `along`, except where this is opposite to a direction
/// that no spring of a scene is likely to have.
Eigen::Quaterniond frame_along(const Vec3& along) {
  const Vec3 usual = Vec3(-0.48, -0.6, -0.64);
  return Eigen::Quaterniond::FromTwoVectors(usual, along) * Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), usual);
}

/// Where a helix stands: between two ends, of which the radii of bodies (m) are left out.
struct Ends {
  Vec3 from, to;                  // m
  double from_radius, to_radius;  // m; 0: a fixed point
  double rest_length;             // m, or the length at the start
};

double turns_of(double rest_length, double coil) {
  return clamp(std::round(rest_length / (pitch * coil)), fewest_turns, most_turns);
}

void add_spring(const Moment& moment, const Ends& ends, vector<Stroke>& strokes) {
  const Vec3 whole = ends.to - ends.from;
  const double length = whole.norm();
  if (!(length > 0)) return;

  // The smaller of two bodies gives the coil's size.
  const double size = ends.from_radius > 0 ? min(ends.from_radius, ends.to_radius) : ends.to_radius;
  const Vec3 along = whole / length;
  const double coil = coil_radius * size;
  const double from = ends.from_radius + lead * length;
  const double until = length - ends.to_radius - lead * length;
  Wire wire(thickness * coil, ends.from, wire_steel, strokes);
  const double error = chord_error * min(moment.pixel_at(ends.from), moment.pixel_at(ends.to));

  // The turns, unless they are too small to be seen.
  if (until > from && coil > 2 * error) {
    const double turns = turns_of(ends.rest_length, coil);
    const double chords = clamp(ceil(std::numbers::pi / std::acos(1 - error / coil)), 6.0, most_chords);
    const Eigen::Quaterniond frame = frame_along(along);
    wire.go_to(ends.from + from * along);

    const double count = turns * chords;
    for (double i = 0; i <= count; ++i) {
      const double angle = 2 * std::numbers::pi * i / chords, height = from + i / count * (until - from);
      wire.go_to(ends.from + frame * Vec3(coil * std::cos(angle), coil * std::sin(angle), height));
    }
    wire.go_to(ends.from + until * along);
  }
  wire.go_to(ends.to);
}

/// The springs between bodies. Those of merged bodies hold the joint one.
void add_body_springs(const Moment& moment, vector<Stroke>& strokes) {
  const World& world = moment.world;
  const State& state = moment.state;
  const vector<size_t>& hidden = moment.scene.overlay.hidden_body_springs;
  const auto body_of = [&](Entity i) { return state.part_of.empty() ? i : state.part_of[i]; };
  for (size_t k = 0; k < world.springs.size(); ++k) {
    const BodySpring& spring = world.springs[k];
    const Entity a = body_of(spring.a);
    const Entity b = body_of(spring.b);
    if (contains(hidden, k) || !spring.acts(state.time) || a == b || a == no_entity || b == no_entity) continue;

    const vector<Vec3>& start = moment.scene.initial.position;
    const double rest = spring.rest_length > 0 ? spring.rest_length : (start[spring.b] - start[spring.a]).norm();
    // It is seen between the bodies, less a lead in proportion.
    const Vec3 from = state.position[a];
    const Vec3 to = state.position[b];
    add_spring(moment, {from, to, moment.radius_of(a), moment.radius_of(b), rest}, strokes);
  }
}

}  // namespace

void add_springs(const Moment& moment, vector<Stroke>& strokes) {
  const World& world = moment.world;
  const vector<size_t>& hidden = moment.scene.overlay.hidden_springs;
  for (size_t k = 0; k < world.forces.size(); ++k) {
    const Force& force = world.forces[k];
    const Spring* spring = std::get_if<Spring>(&force.law);
    if (spring == nullptr || contains(hidden, k)) continue;

    for (Entity body = 0; body < world.body_count(); ++body) {
      if (!acts(force, body, moment.state.time) || moment.is_part(body)) continue;
      const double rest =
          spring->rest_length > 0 ? spring->rest_length : (moment.scene.initial.position[body] - spring->anchor).norm();
      add_spring(moment, {spring->anchor, moment.state.position[body], 0, moment.radius_of(body), rest}, strokes);
    }
  }
  add_body_springs(moment, strokes);
}

}  // namespace carom
