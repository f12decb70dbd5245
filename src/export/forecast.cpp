#include <cmath>
#include <limits>

#include "export/exports.h"
#include "export/picture_streams.h"
#include "export/timeline.h"

namespace carom {
namespace {

// Typical sizes, bytes: a motion's six numbers, a time, a name, a row of energy.csv; what a pixel of a rendered picture
// takes as PNG, and in a film at crf 18, which halves for each 6 more.
constexpr double motion_bytes = 114, time_bytes = 6, name_bytes = 8, energy_bytes = 110, collision_bytes = 260,
                 contact_bytes = 40;
constexpr double png_bytes_per_pixel = 0.3, film_bytes_per_pixel = 0.02;

std::uint64_t whole(double x) {
  constexpr double most = 9e18;
  return x >= most ? static_cast<std::uint64_t>(most) : static_cast<std::uint64_t>(std::llround(x));
}

double pixels(Size size) {
  return static_cast<double>(size.width) * size.height;
}

}  // namespace

Forecast forecast(const Scene& scene) {
  const Output& output = scene.output;
  const double bodies = scene.world.body_count(), duration = scene.simulate.duration;
  double rows = 0, frames = 0, bytes = static_cast<double>(scene.resolved.size()) + 2000;
  if (output.trajectory) {
    const auto instants = static_cast<double>(Ticks::every(output.trajectory->every, duration).count());
    rows = instants * bodies;
    bytes += output.trajectory->wide ? rows * motion_bytes + bodies * 6 * (name_bytes + 8) + instants * time_bytes
                                     : rows * (motion_bytes + time_bytes + name_bytes);
  }
  if (output.energy) bytes += static_cast<double>(Ticks::every(output.energy->every, duration).count()) * energy_bytes;
  if (output.contacts)  // which bodies rest when nobody knows; half of them always
    bytes += static_cast<double>(Ticks::every(output.contacts->every, duration).count()) * contact_bytes * bodies / 2;
  if (output.collisions) bytes += collision_bytes * bodies;  // how many there will be nobody knows; one a body
  const PictureStreams plan = plan_pictures(scene);
  for (std::size_t i = 0; i < plan.streams.size(); ++i) {
    const auto count = static_cast<double>(plan.ticks[i].count());
    const double area = pixels(plan.streams[i].size);
    frames += count;
    if (plan.uses[i].frames || plan.uses[i].sheet) bytes += count * area * png_bytes_per_pixel;
    if (plan.uses[i].film) bytes += count * area * film_bytes_per_pixel * std::exp2((18 - output.video->crf) / 6.0);
  }
  return {whole(rows), whole(frames), whole(bytes)};
}

}  // namespace carom
