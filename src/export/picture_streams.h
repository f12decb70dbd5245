#pragma once
// Which pictures are drawn when, and what each one is for.
#include <vector>

#include "export/timeline.h"
#include "scene/output.h"

namespace carom {

struct Scene;

/// One sequence of pictures of one size and quality; frames, video and sheet share one where theirs are the same.
struct PictureStream {
  Size size;
  int samples = 4;
  int timeline_stream = 0;
};

/// The sinks of one PictureStream.
struct PictureUse {
  bool frames = false, film = false, sheet = false;
};

struct PictureStreams {
  std::vector<PictureStream> streams;  // timeline_stream: the index into `ticks` until a Timeline gives its own
  std::vector<PictureUse> uses;        // by stream
  std::vector<Ticks> ticks;            // by stream
};

/// One stream for frames and film if they agree in size, quality and instants, so that a picture is drawn once for
/// both. Throws ExportError for a film or a sheet that cannot be.
PictureStreams plan_pictures(const Scene& scene);

/// The shape and quality of the sheet's pictures: those of the frames, else of the film, else the frames' defaults.
FramesOutput sheet_model(const Output& output);

}  // namespace carom
