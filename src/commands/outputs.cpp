#include "commands/outputs.h"

#include <fmt/format.h>

#include <algorithm>

namespace carom {

namespace {

FramesOutput frames_like(const VideoOutput& video) {
  return {video.fps, video.size, video.samples, video.from, video.until};
}

VideoOutput video_like(const FramesOutput& frames) {
  VideoOutput video;
  video.fps = frames.fps;
  video.size = frames.size;
  video.samples = frames.samples;
  video.from = frames.from;
  video.until = frames.until;
  return video;
}

std::string clip_text(double fps, Size size, int samples, double from, const std::optional<double>& until) {
  std::string text =
      fmt::format("fps: {}, size: [{}, {}], samples: {}, from: {}", fps, size.width, size.height, samples, from);
  if (until) text += fmt::format(", until: {}", *until);
  return text;
}

std::string output_text(const Output& output) {
  std::string text = "output:\n";
  if (output.trajectory) {
    text += fmt::format("  trajectory: {{every: {}, layout: {}}}\n", output.trajectory->every,
                        output.trajectory->wide ? "wide" : "long");
  }
  if (output.collisions) text += "  collisions: true\n";
  if (output.energy) text += fmt::format("  energy: {{every: {}}}\n", output.energy->every);
  if (const auto& f = output.frames) {
    text += fmt::format("  frames: {{{}}}\n", clip_text(f->fps, f->size, f->samples, f->from, f->until));
  }
  if (const auto& v = output.video) {
    text += fmt::format("  video: {{file: {}, crf: {}, {}}}\n", v->file, v->crf,
                        clip_text(v->fps, v->size, v->samples, v->from, v->until));
  }
  if (output.sheet)
    text += fmt::format("  sheet: {{columns: {}, rows: {}}}\n", output.sheet->columns, output.sheet->rows);
  return text;
}

// The key `output` with all that is indented below it, or the end of the text.
void replace_output(std::string& resolved, const std::string& text) {
  std::size_t begin = resolved.starts_with("output:") ? 0 : resolved.find("\noutput:");
  if (begin == std::string::npos) {
    resolved += text;
    return;
  }
  if (begin > 0) ++begin;
  std::size_t end = resolved.find('\n', begin);
  while (end != std::string::npos && end + 1 < resolved.size() && resolved[end + 1] == ' ') {
    end = resolved.find('\n', end + 1);
  }
  resolved.replace(begin, end == std::string::npos ? std::string::npos : end + 1 - begin, text);
}

}  // namespace

void restrict_outputs(Scene& scene, const std::vector<std::string>& only) {
  const auto wanted = [&](const char* name) { return std::find(only.begin(), only.end(), name) != only.end(); };
  const Output& asked = scene.output;
  Output output;
  if (wanted("trajectory")) output.trajectory = asked.trajectory.value_or(TrajectoryOutput{});
  output.collisions = wanted("collisions");
  if (wanted("energy")) output.energy = asked.energy.value_or(EnergyOutput{});
  if (wanted("frames")) output.frames = asked.frames.value_or(asked.video ? frames_like(*asked.video) : FramesOutput{});
  if (wanted("video")) output.video = asked.video.value_or(asked.frames ? video_like(*asked.frames) : VideoOutput{});
  if (wanted("sheet")) output.sheet = asked.sheet.value_or(SheetOutput{});
  scene.output = output;
  replace_output(scene.resolved, output_text(output));
}

}  // namespace carom
