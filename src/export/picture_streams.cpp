// Merges outputs with equal pictures into one stream, so that each picture is drawn once.
// A film without pictures and a sheet that is too large are refused here, before the run.
#include "export/picture_streams.h"

#include <algorithm>

#include "export/sheet.h"
#include "files/run_folder.h"
#include "scene/scene.h"

namespace carom {
namespace {

Ticks ticks_of(const PictureOutput& frames, double duration) {
  return Ticks::rate(frames.fps, frames.from, std::min(frames.until.value_or(duration), duration));
}

bool same_pictures(const PictureOutput& a, const PictureOutput& b, double duration) {
  return a.fps == b.fps && a.size == b.size && a.samples == b.samples && a.from == b.from &&
         std::min(a.until.value_or(duration), duration) == std::min(b.until.value_or(duration), duration);
}

void add(PictureStreams& plan, Size size, const PictureOutput& model, const Ticks& ticks, const PictureUse& use) {
  plan.streams.push_back(
      {size, model.samples, static_cast<int>(plan.streams.size()), 1 / model.fps, 1, ticks.decimals()});
  plan.uses.push_back(use);
  plan.ticks.push_back(ticks);
}

}  // namespace

PictureOutput sheet_model(const Output& output) {
  if (output.frames) return *output.frames;
  return output.video ? static_cast<const PictureOutput&>(*output.video) : PictureOutput{};
}

PictureStreams plan_pictures(const Scene& scene) {
  const Output& output = scene.output;
  const double duration = scene.simulate.duration;
  PictureStreams plan;
  if (const auto& frames = output.frames) {
    const bool film = output.video && same_pictures(*frames, *output.video, duration);
    add(plan, frames->size, *frames, ticks_of(*frames, duration), {true, film, false});
  }
  if (const auto& video = output.video) {
    const Ticks ticks = ticks_of(*video, duration);
    if (ticks.count() < 1)
      throw ExportError("cannot make " + video->file + ": no picture falls between `from` and `until`");
    if (scene.transparent)
      throw ExportError("cannot make " + video->file + ": a film has no transparency, and `background` is `none`; " +
                        "write frames, or give the background a colour");
    if (plan.uses.empty() || !plan.uses.front().film) add(plan, video->size, *video, ticks, {false, true, false});
  }
  if (output.sheet) {
    const PictureOutput model = sheet_model(output);
    const Sheet sheet(*output.sheet, model.size);
    add(plan, sheet.picture_size(), model, Ticks::even(sheet.count(), duration), {false, false, true});
  }
  return plan;
}

}  // namespace carom
