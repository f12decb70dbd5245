// Estimates rows, pictures, bytes and wall time from the scene alone, with typical constants.
// The time of the simulation itself is not included.

#include "export/forecast.h"
#include "export/picture_streams.h"
#include "export/timeline.h"
#include "export/writer_kinds.h"
#include "numerics/whole.h"
#include "physics/world.h"
#include "scene/film_format.h"
#include "scene/film_layout.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

// Bytes of tables, by those in CSV.
constexpr double gzip_share = 0.4, workbook_share = 0.7;

// Bytes of pictures, measured with scenes/*.yaml. Bodies have more of them than the ground and the sky.

// Of a pixel of a rendered picture as PNG: in 1280 x 720 from 0.07 with 1 body to 0.41 with 200.
constexpr double png_pixel_bytes = 0.1;
// For the root of the number of bodies.
constexpr double png_body_bytes = 0.022;
// With 10,000 balls of tests/benchmark/pictures.
constexpr double png_most_bytes = 0.65;

// Of a picture in an MP4 at crf 18: with few bodies 180 to 580 in 1280 x 720. They halve for each 6 more.
constexpr double film_picture_bytes = 150;
// Of each of its pixels.
constexpr double film_pixel_bytes = 0.0002;
// Of a body, for the root of the pixels: with 200 bodies 106 in 1280 x 720 and 55 in 640 x 360.
constexpr double film_body_bytes = 0.1;
// Of a pixel of a crowd: 0.073 with 2,000 balls in gas_in_a_room, most of them hidden.
constexpr double film_most_bytes = 0.08;
// Of a second of sound: AAC of 128 kbit/s.
constexpr double sound_bytes = 16e3;
// Other formats in the bytes of an MP4: 4 to 11 and 1.0 to 1.9.
constexpr double gif_bytes = 6.5, webp_bytes = 1.4;

// Wall times, in s, on two cores of 3 GHz.

// Until the first picture.
constexpr double first_picture_s = 0.3;
// For a pixel.
constexpr double pixel_s = 5e-9;
// For each sample of a pixel.
constexpr double sample_s = 2e-9;
// For a pixel as PNG, encoded beside the drawing.
constexpr double png_pixel_s = 2.5e-9;
// For a pixel of a film.
constexpr double film_pixel_s = 5e-9;
// For the charts of plots/, or of a report.
constexpr double plots_s = 0.35;
// For a byte of a table.
constexpr double table_byte_s = 1e-8;
// For a byte of a table in CSV that goes into a workbook: 13 s for 160 MB.
constexpr double workbook_byte_s = 8e-8;

uint64_t whole(double x) {
  return uint64_t(max<int64_t>(nearest_whole(x), 0));
}

double pixels(Size size) {
  return double(size.width) * size.height;
}

double png_bytes(double area, double bodies) {
  return area * min(png_pixel_bytes + png_body_bytes * sqrt(bodies), png_most_bytes);
}

/// What is written of a table, as a part of its bytes in CSV.
double share_of_bytes(const TablesOutput& tables, const OutputKind& kind) {
  if (!kind.files.ends_with(".csv")) return 1;
  if (tables.format == TablesOutput::Format::gzip) return gzip_share;
  return tables.format == TablesOutput::Format::xlsx ? 1 + workbook_share : 1;
}

/// Of one picture.
double film_bytes(const VideoOutput& video, double area, double bodies) {
  const double of_bodies = min(bodies * film_body_bytes * sqrt(area), area * film_most_bytes);
  const double at_18 = film_picture_bytes + area * film_pixel_bytes + of_bodies;
  const double by_crf = std::exp2((18 - video.crf) / 6.0);
  switch (film_format(video.file).value_or(FilmFormat::mp4)) {
    case FilmFormat::gif:
      return at_18 * gif_bytes;
    case FilmFormat::webp:
      return at_18 * webp_bytes * by_crf;
    case FilmFormat::mp4:
      break;
  }
  return at_18 * by_crf;
}

}  // namespace

Forecast forecast(const Scene& scene) {
  const Output& output = scene.output;
  const double bodies = scene.world.body_count(), duration = scene.simulate.duration;
  double frames = 0, bytes = double(scene.resolved.size()) + 2000;
  double seconds = 0;
  vector<TableSize> tables;

  const auto instants = [&](const OutputKind& kind) {
    return kind.is_sampled() ? double(Ticks::every(kind.every(output), duration).count()) : 0;
  };

  for (const OutputKind& kind : output_kinds()) {
    if (!kind.asked(output)) continue;
    const WriterKind* const writer = writer_named(kind.name);
    if (writer == nullptr) continue;
    const double in_csv = writer->bytes(scene, instants(kind)), share = share_of_bytes(output.tables, kind);
    bytes += in_csv * share;
    if (share > 1) seconds += in_csv * workbook_byte_s;
    if (writer->size != nullptr) tables.push_back(writer->size(scene, instants(kind)));
  }

  // The pictures.
  seconds += 0.005 + bytes * table_byte_s + (output.charts() ? plots_s : 0);
  const PictureStreams plan = plan_pictures(scene);
  for (size_t i = 0; i < plan.streams.size(); ++i) {
    // Where a slowdown is not known yet, the most pictures that it may add.
    const bool longer = plan.uses[i].film && output.video->slow && !scene.known.slows_at;
    const double count = double(plan.ticks[i].count()) + (longer ? floor(most_delay() * output.video->fps) : 0);
    const double area = pixels(plan.streams[i].size);
    const double cards = plan.uses[i].film ? double(title_pictures(*output.video)) : 0;
    frames += count + cards;

    if (count > 0) seconds += first_picture_s + count * area * (pixel_s + sample_s * plan.streams[i].samples);
    if (plan.uses[i].frames) seconds += count * area * png_pixel_s;
    if (plan.uses[i].film) seconds += (count + cards) * area * film_pixel_s;
    if (plan.uses[i].frames || plan.uses[i].sheet) bytes += count * png_bytes(area, bodies);
    if (plan.uses[i].film) bytes += (count + cards) * film_bytes(*output.video, area, bodies);
    if (plan.uses[i].film && output.video->sound) bytes += (count + cards) / output.video->fps * sound_bytes;
  }
  return {whole(frames), whole(bytes), seconds, std::move(tables)};
}

}  // namespace carom
