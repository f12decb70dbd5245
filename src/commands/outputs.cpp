#include "commands/outputs.h"

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

}  // namespace

Output restricted(const Output& asked, const std::vector<std::string>& only) {
  const auto wanted = [&](const char* name) { return std::find(only.begin(), only.end(), name) != only.end(); };
  Output output;
  if (wanted("trajectory")) output.trajectory = asked.trajectory.value_or(TrajectoryOutput{});
  output.collisions = wanted("collisions");
  if (wanted("energy")) output.energy = asked.energy.value_or(EnergyOutput{});
  if (wanted("contacts")) output.contacts = asked.contacts.value_or(ContactsOutput{});
  if (wanted("frames")) output.frames = asked.frames.value_or(asked.video ? frames_like(*asked.video) : FramesOutput{});
  if (wanted("video")) output.video = asked.video.value_or(asked.frames ? video_like(*asked.frames) : VideoOutput{});
  if (wanted("sheet")) output.sheet = asked.sheet.value_or(SheetOutput{});
  return output;
}

bool holds_all(const Output& output, const std::vector<std::string>& only) {
  return std::all_of(only.begin(), only.end(), [&](const std::string& name) {
    return (name == "trajectory" && output.trajectory) || (name == "collisions" && output.collisions) ||
           (name == "energy" && output.energy) || (name == "contacts" && output.contacts) ||
           (name == "frames" && output.frames) || (name == "video" && output.video) ||
           (name == "sheet" && output.sheet);
  });
}

}  // namespace carom
