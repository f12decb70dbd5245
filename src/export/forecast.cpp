#include <cmath>
#include <limits>

#include "export/forecast.h"
#include "export/picture_streams.h"
#include "export/timeline.h"
#include "export/writer.h"
#include "numerics/whole.h"
#include "physics/world.h"
#include "scene/scene.h"

namespace carom {
namespace {

// Bytes: what a pixel of a rendered picture takes as PNG, and in a film at crf 18, which halves for each 6 more.
constexpr double png_bytes_per_pixel = 0.3, film_bytes_per_pixel = 0.02;
// Wall times, s, of two cores of 3 GHz: until the first picture; a pixel, and each of its samples; a pixel's PNG; a
// pixel of a film; a byte of a table.
constexpr double first_picture_s = 0.3, pixel_s = 8e-9, sample_s = 3e-9, png_pixel_s = 5e-8, film_pixel_s = 4.5e-8,
                 table_byte_s = 1e-8;

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
    return kind.every ? static_cast<double>(Ticks::every(kind.every(output), duration).count()) : 0;
  };
  for (const OutputKind& kind : output_kinds()) {
    if (!kind.asked(output)) continue;
    if (const WriterKind* writer = writer_named(kind.name)) bytes += writer->bytes(scene, instants(kind));
    if (kind.name == "trajectory") rows += instants(kind) * bodies;
  }
  double seconds = 0.005 + bytes * table_byte_s;
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
