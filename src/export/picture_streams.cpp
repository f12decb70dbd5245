// Merges outputs with equal pictures into one stream, so that each picture is drawn once.
// A film without pictures and a sheet that is too large are refused here, before the run.
#include "export/picture_streams.h"

#include "export/sheet.h"
#include "files/export_error.h"
#include "scene/film_format.h"
#include "scene/film_layout.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

double end_of(const optional<double>& until, double duration) {
  return min(until.value_or(duration), duration);
}

Ticks ticks_of(const FramesOutput& frames, double duration) {
  return Ticks::rate(frames.fps, frames.from, end_of(frames.until, duration));
}

Ticks ticks_of(const Scene& scene, const VideoOutput& video, double duration) {
  return Ticks::film(video.fps, video.speed, video.from, end_of(video.until, duration),
                     video.slow ? scene.known.slows_at : nullopt);
}

Ticks ticks_of(const SheetOutput& sheet, double duration) {
  return Ticks::even(int64_t{sheet.columns} * sheet.rows, sheet.from, end_of(sheet.until, duration));
}

void add(PictureStreams& plan, Size size, const PictureOutput& model, const FilmClock& clock, const Ticks& ticks,
         const PictureUse& use) {
  const int number = int(plan.streams.size());
  plan.streams.push_back({size, model.samples, number, clock.speed() / model.fps, ticks.decimals(), clock});
  plan.uses.push_back(use);
  plan.ticks.push_back(ticks);
}

/// The outputs that the sheet's pictures follow: --only may leave frames and film out.
const Output& models_of(const Scene& scene) {
  return scene.requested.frames || scene.requested.video ? scene.requested : scene.output;
}

/// The clock of sheet_model(), apart from a slowdown: pictures of the sheet are at even times.
FilmClock model_clock(const Scene& scene) {
  const Output& models = models_of(scene);
  return models.frames || !models.video ? FilmClock() : FilmClock(models.video->speed, 0);
}

/// Whether the pictures of the frames are those of the film.
bool shows_film(const Scene& scene, const PictureStream& frames, const Ticks& of_frames, const Ticks& of_film) {
  const VideoOutput& video = *scene.output.video;
  const bool same_flashes = !scene.overlay.flash || frames.clock.speed() == video.speed;
  const bool same_blur = scene.overlay.shutter == 0 || frames.interval == video.speed / video.fps;
  return !video.chart && frames.size == video.size && frames.samples == video.samples &&
         of_frames.has_times_of(of_film) && same_flashes && same_blur;
}

}  // namespace

PictureOutput sheet_model(const Scene& scene) {
  const Output& models = models_of(scene);
  if (models.frames) return *models.frames;
  return models.video ? static_cast<const PictureOutput&>(*models.video) : PictureOutput{};
}

PictureStream still_stream(const Scene& scene, double time) {
  const PictureOutput model = sheet_model(scene);
  const FilmClock clock = model_clock(scene);
  return {model.size, model.samples, 0, clock.speed() / model.fps, Ticks::even(1, time, time).decimals(), clock};
}

vector<Ticks> shown_instants(const Scene& scene) {
  const Output& output = scene.requested.pictures() ? scene.requested : scene.output;
  const double duration = end_of(scene);
  vector<Ticks> instants;
  if (output.frames) instants.push_back(ticks_of(*output.frames, duration));
  if (output.video) instants.push_back(ticks_of(scene, *output.video, duration));
  if (output.sheet) instants.push_back(ticks_of(*output.sheet, duration));
  if (instants.empty()) instants.push_back(Ticks::every(1 / output.gltf.value_or(GltfOutput{}).fps, duration));
  return instants;
}

PictureStreams plan_pictures(const Scene& scene) {
  const Output& output = scene.output;
  const double duration = end_of(scene);
  PictureStreams plan;
  if (const auto& frames = output.frames) {
    const Ticks ticks = ticks_of(*frames, duration);
    if (ticks.count() < 1)
      throw ExportError(string("cannot make frames: no picture falls between `from` and `until`; ") +
                        "a frame is at a whole multiple of 1/fps");
    add(plan, frames->size, *frames, {}, ticks, {true, false, false});
  }

  if (const auto& video = output.video) {
    const Ticks ticks = ticks_of(scene, *video, duration);
    if (ticks.count() < 1)
      throw ExportError("cannot make " + video->file + ": no picture falls between `from` and `until`");
    if (scene.background.transparent && film_format(video->file) == FilmFormat::mp4)
      throw ExportError("cannot make " + video->file + ": an MP4 has no transparency, and `background` is `none`; " +
                        "write frames, a .gif or a .webp, or give the background a colour");

    // Frames and film share pictures that are the same.
    if (plan.streams.empty() || !shows_film(scene, plan.streams.front(), plan.ticks.front(), ticks))
      add(plan, layout_of(*video).picture, *video, clock_of(scene, *video), ticks, {false, true, false});
    else
      plan.uses.front().film = true;
    if (video->chart) plan.streams.back().charted = true;
  }

  if (output.sheet) {
    const PictureOutput model = sheet_model(scene);
    const Sheet sheet(*output.sheet, model.size);
    add(plan, sheet.picture_size(), model, model_clock(scene), ticks_of(*output.sheet, duration), {false, false, true});
  }
  return plan;
}

}  // namespace carom
