// Merges outputs with equal pictures into one stream, so that each picture is drawn once.
// A film without pictures and a sheet that is too large are refused here, before the run.
#include "export/picture_streams.h"

#include <algorithm>

#include "export/sheet.h"
#include "files/run_folder.h"
#include "scene/scene.h"

namespace carom {
namespace {

double end_of(const std::optional<double>& until, double duration) {
  return std::min(until.value_or(duration), duration);
}

Ticks ticks_of(const FramesOutput& frames, double duration) {
  return Ticks::rate(frames.fps, frames.from, end_of(frames.until, duration));
}

Ticks ticks_of(const VideoOutput& video, double duration) {
  return Ticks::film(video.fps, video.speed, video.from, end_of(video.until, duration));
}

Ticks ticks_of(const SheetOutput& sheet, double duration) {
  return Ticks::even(std::int64_t{sheet.columns} * sheet.rows, sheet.from, end_of(sheet.until, duration));
}

void add(PictureStreams& plan, Size size, int samples, const Ticks& ticks, const PictureUse& use) {
  plan.streams.push_back({size, samples, static_cast<int>(plan.streams.size())});
  plan.uses.push_back(use);
  plan.ticks.push_back(ticks);
}

}  // namespace

PictureOutput sheet_model(const Output& output) {
  if (output.frames) return *output.frames;
  return output.video ? static_cast<const PictureOutput&>(*output.video) : PictureOutput{};
}

std::vector<Ticks> shown_instants(const Scene& scene) {
  const Output& output = scene.requested.pictures() ? scene.requested : scene.output;
  const double duration = scene.simulate.duration;
  std::vector<Ticks> instants;
  if (output.frames) instants.push_back(ticks_of(*output.frames, duration));
  if (output.video) instants.push_back(ticks_of(*output.video, duration));
  if (output.sheet) instants.push_back(ticks_of(*output.sheet, duration));
  if (instants.empty()) instants.push_back(Ticks::every(1 / output.gltf.value_or(GltfOutput{}).fps, duration));
  return instants;
}

PictureStreams plan_pictures(const Scene& scene) {
  const Output& output = scene.output;
  const double duration = scene.simulate.duration;
  PictureStreams plan;
  if (const auto& frames = output.frames)
    add(plan, frames->size, frames->samples, ticks_of(*frames, duration), {true, false, false});
  if (const auto& video = output.video) {
    const Ticks ticks = ticks_of(*video, duration);
    if (ticks.count() < 1)
      throw ExportError("cannot make " + video->file + ": no picture falls between `from` and `until`");
    const auto& frames = output.frames;
    if (frames && frames->size == video->size && frames->samples == video->samples &&
        plan.ticks.front().has_times_of(ticks))
      plan.uses.front().film = true;
    else
      add(plan, video->size, video->samples, ticks, {false, true, false});
  }
  if (output.sheet) {
    const PictureOutput model = sheet_model(output);
    const Sheet sheet(*output.sheet, model.size);
    add(plan, sheet.picture_size(), model.samples, ticks_of(*output.sheet, duration), {false, false, true});
  }
  return plan;
}

}  // namespace carom
