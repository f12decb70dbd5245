// Estimates rows, pictures, bytes and wall time from the scene alone, with typical constants.
// The time of the simulation itself is not included.
#include <cmath>
#include <limits>

#include "export/forecast.h"
#include "export/picture_streams.h"
#include "export/timeline.h"
#include "export/writer.h"
#include "numerics/whole.h"
#include "physics/world.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"

namespace carom {
namespace {

// Bytes of a pixel of a rendered picture as PNG. In 1280 x 720 the scenes in scenes/ have 0.07 to 0.41, on average
// 0.15. Crowds have more: 0.65 with 10,000 balls of tests/benchmark/pictures.
constexpr double png_bytes_per_pixel = 0.2;
// Bytes of a pixel of a picture in a film at crf 18. They halve for each 6 more.
constexpr double film_bytes_per_pixel = 0.02;

// Wall times, in s, on two cores of 3 GHz.

// Until the first picture.
constexpr double first_picture_s = 0.3;
// For a pixel.
constexpr double pixel_s = 8e-9;
// For each sample of a pixel.
constexpr double sample_s = 3e-9;
// For a pixel as PNG, encoded beside the drawing.
constexpr double png_pixel_s = 4e-9;
// For a pixel of a film.
constexpr double film_pixel_s = 8e-9;
// For the charts of plots/.
constexpr double plots_s = 0.35;
// For a byte of a table.
constexpr double table_byte_s = 1e-8;

std::uint64_t whole(double x) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(nearest_whole(x), 0));
}

double pixels(Size size) {
  return static_cast<double>(size.width) * size.height;
}

}  // namespace

Forecast forecast(const Scene& scene) {
  const Output& output = scene.output;
  const double bodies = scene.world.body_count(), duration = scene.simulate.duration;
  double rows = 0, frames = 0, bytes = static_cast<double>(scene.resolved.size()) + 2000;
  const auto instants = [&](const OutputKind& kind) {
    return kind.is_sampled() ? static_cast<double>(Ticks::every(kind.every(output), duration).count()) : 0;
  };
  for (const OutputKind& kind : output_kinds()) {
    if (!kind.asked(output)) continue;
    if (const WriterKind* writer = writer_named(kind.name)) bytes += writer->bytes(scene, instants(kind));
    if (kind.name == "trajectory") rows += instants(kind) * bodies;
  }
  double seconds = 0.005 + bytes * table_byte_s + (output.plots ? plots_s : 0);
  const PictureStreams plan = plan_pictures(scene);
  for (std::size_t i = 0; i < plan.streams.size(); ++i) {
    const auto count = static_cast<double>(plan.ticks[i].count());
    const double area = pixels(plan.streams[i].size);
    frames += count;
    if (count > 0) seconds += first_picture_s + count * area * (pixel_s + sample_s * plan.streams[i].samples);
    if (plan.uses[i].frames) seconds += count * area * png_pixel_s;
    if (plan.uses[i].film) seconds += count * area * film_pixel_s;
    if (plan.uses[i].frames || plan.uses[i].sheet) bytes += count * area * png_bytes_per_pixel;
    if (plan.uses[i].film) bytes += count * area * film_bytes_per_pixel * std::exp2((18 - output.video->crf) / 6.0);
  }
  return {whole(rows), whole(frames), whole(bytes), seconds};
}

}  // namespace carom
