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

double turns_of(const Spring& spring, double coil, double start_length) {
  const double length = spring.rest_length > 0 ? spring.rest_length : start_length;
  return clamp(std::round(length / (pitch * coil)), fewest_turns, most_turns);
}

void add_spring(const Moment& moment, const Spring& spring, Entity body, vector<Stroke>& strokes) {
  const Vec3 end = moment.state.position[body], whole = end - spring.anchor;
  const double length = whole.norm(), reach = moment.radius_of(body);
  if (!(length > 0)) return;

  const Vec3 along = whole / length;
  const double coil = coil_radius * reach, from = lead * length, until = length - reach - lead * length;
  Wire wire(thickness * coil, spring.anchor, wire_steel, strokes);
  const double error = chord_error * min(moment.pixel_at(spring.anchor), moment.pixel_at(end));

  // The turns, unless they are too small to be seen.
  if (until > from && coil > 2 * error) {
    const double turns = turns_of(spring, coil, (moment.scene.initial.position[body] - spring.anchor).norm());
    const double chords = clamp(ceil(std::numbers::pi / std::acos(1 - error / coil)), 6.0, most_chords);
    const Eigen::Quaterniond frame = frame_along(along);
    wire.go_to(spring.anchor + from * along);

    const double count = turns * chords;
    for (double i = 0; i <= count; ++i) {
      const double angle = 2 * std::numbers::pi * i / chords, height = from + i / count * (until - from);
      wire.go_to(spring.anchor + frame * Vec3(coil * std::cos(angle), coil * std::sin(angle), height));
    }
    wire.go_to(spring.anchor + until * along);
  }
  wire.go_to(end);
}

}  // namespace

void add_springs(const Moment& moment, vector<Stroke>& strokes) {
  const World& world = moment.scene.world;
  const vector<size_t>& hidden = moment.scene.overlay.hidden_springs;
  for (size_t k = 0; k < world.forces.size(); ++k) {
    const Force& force = world.forces[k];
    const Spring* spring = std::get_if<Spring>(&force.law);
    if (spring == nullptr || contains(hidden, k)) continue;
    for (Entity body = 0; body < world.body_count(); ++body)
      if (acts(force, body, moment.state.time) && !moment.is_part(body)) add_spring(moment, *spring, body, strokes);
  }
}

}  // namespace carom
