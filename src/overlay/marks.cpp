#include "overlay/marks.h"

#include <fmt/format.h>

#include "physics/energy.h"
#include "render/sight.h"
#include "scene/color_scale.h"
#include "std.h"

namespace carom {
namespace {

constexpr double longest_bar = 0.2;   // of the picture's width
constexpr double least_speed = 1e-6;  // of the greatest to expect: a slower body is at rest

struct LengthUnit {
  double metres;
  const char* name;
};
constexpr LengthUnit length_units[] = {{1e3, "km"},  {1, "m"},          {1e-2, "cm"},
                                       {1e-3, "mm"}, {1e-6, "\u00b5m"}, {1e-9, "nm"}};

/// Of 1, 2 and 5 times powers of ten the greatest up to `most`.
double rounded_down(double most) {
  const double power = pow(10, floor(std::log10(most) + 1e-12));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= most) return digit * power;
  return power;
}

vector<string> lines_of(const Labels& labels, const Moment& moment, Entity body, double fastest) {
  vector<string> lines;
  const double speed = moment.state.velocity[body].norm();
  const double mass = mass_now(moment.world, moment.state, body);
  if (labels.name) lines.push_back(moment.scene.roster.name(body));
  if (labels.speed) lines.push_back(three_digits(speed, fastest) + " m/s");
  if (labels.momentum) lines.push_back(three_digits(mass * speed, mass * fastest) + " kg m/s");
  return lines;
}

/// Whether something lies between the eye and a body's centre: another body, or a thing that is not seen through.
bool is_hidden(const Sight& sight, const Moment& moment, Entity body) {
  const Vec3& eye = moment.eye.camera.eye;
  const Vec3& center = moment.state.position[body];
  for (Entity other = 0; other < moment.world.body_count(); ++other) {
    if (other == body || moment.is_part(other)) continue;
    const Volume volume = volume_now(moment.world, moment.state, other);
    if (is_between(volume, moment.state.position[other], eye, center)) return true;
  }
  return sight.is_hidden(moment.world, moment.state.time, eye, center);
}

void add_labels(const Labels& labels, const Moment& moment, double fastest, Marks& marks) {
  const Eye& eye = moment.eye;
  const Sight sight(moment.scene);
  for (Entity body = 0; body < moment.world.body_count(); ++body) {
    if (moment.is_part(body) || !eye.may_see(eye.point(moment.state.position[body]), moment.radius_of(body))) continue;
    const optional<BodyBounds> bounds = bounds_of(moment, body);
    if (!bounds) continue;
    marks.bounds.push_back(*bounds);

    const double x = (bounds->left + bounds->right) / 2, y = (bounds->top + bounds->bottom) / 2;
    const bool in_view = x >= 0 && x <= eye.size.width && y >= 0 && y <= eye.size.height;
    const bool wanted = labels.on.empty() || std::binary_search(labels.on.begin(), labels.on.end(), body);
    if (wanted && in_view && !is_hidden(sight, moment, body))
      marks.labels.push_back({*bounds, lines_of(labels, moment, body, fastest)});
  }
}

Color color_of(const Scene& scene, Entity body) {
  const BodyRange& range = scene.roster.range_of(body);
  return range.coloring ? body_color(scene.look, body) : range.color;
}

MomentumSum momentum_of(const Moment& moment, const MarkScales& scales) {
  MomentumSum sum;
  const World& world = moment.world;
  const auto part = [&](const Vec3& momentum, const Color& color) {
    const Vec3 seen = moment.eye.direction(momentum);
    return MomentumSum::Part{seen.x(), seen.y(), color};
  };

  const bool few = world.body_count() <= most_momenta;
  for (Entity body = 0; few && body < world.body_count(); ++body) {
    if (moment.is_part(body)) continue;
    const double mass = mass_now(world, moment.state, body);
    sum.parts.push_back(part(mass * moment.state.velocity[body], color_of(moment.scene, body)));
  }
  sum.reach = scales.momentum > 0 ? scales.momentum : 1;

  const Vec3 total = momentum(world, moment.state);
  sum.total = part(total, {1, 1, 1});
  sum.at_start = part(scales.start, {1, 1, 1});
  sum.text = fmt::format("sum: {} kg m/s", three_digits(total.norm(), sum.reach));
  return sum;
}

}  // namespace

string three_digits(double value, double scale) {
  const double size = std::abs(value);
  if (!(size > least_speed * scale)) return "0";
  // Rounded first, so that 9.996 is 10.0 and has no fourth digit.
  const double rounded = std::stod(fmt::format("{:.2e}", size));
  const int power = int(floor(std::log10(rounded) + 1e-9));
  const string sign = value < 0 ? "-" : "";
  if (power < -3 || power > 5) {
    const double front = rounded / pow(10, power);
    return fmt::format("{}{:.2f}e{}", sign, front, power);
  }
  return fmt::format("{}{:.{}f}", sign, rounded, max(0, 2 - power));
}

string length_text(double length) {
  const LengthUnit* unit = std::begin(length_units);
  while (unit + 1 != std::end(length_units) && length < unit->metres * (1 - 1e-9)) ++unit;
  return fmt::format("{:.6g} {}", length / unit->metres, unit->name);
}

ScaleBar scale_bar_of(const Eye& eye) {
  const double pixel = eye.pixel * eye.point(eye.camera.target).z();  // m
  const double length = rounded_down(longest_bar * eye.size.width * pixel);
  return {length / pixel, length_text(length)};
}

bool has_marks(const Scene& scene) {
  const Overlay& overlay = scene.overlay;
  return overlay.labels || overlay.scale_bar || (overlay.momentum_arrows && scene.world.body_count() > 0);
}

MarkScales mark_scales(const Scene& scene) {
  MarkScales scales;
  if (!has_marks(scene)) return scales;
  for (Entity i = 0; i < scene.world.body_count(); ++i) {
    const double speed = expected_speed(scene, i);
    scales.speed = max(scales.speed, speed);
    scales.momentum += scene.world.mass[i] * speed;
  }
  scales.start = momentum(scene.world, scene.initial);
  for (const Vec3& impulse : scene.world.impulse) scales.start += impulse;
  return scales;
}

Marks marks_of(const Moment& moment, const MarkScales& scales) {
  Marks marks;
  const Overlay& overlay = moment.scene.overlay;
  if (overlay.labels) add_labels(*overlay.labels, moment, scales.speed, marks);
  if (overlay.scale_bar) marks.scale_bar = scale_bar_of(moment.eye);
  if (overlay.momentum_arrows && moment.world.body_count() > 0) marks.momentum = momentum_of(moment, scales);
  return marks;
}

}  // namespace carom
