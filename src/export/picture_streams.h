#pragma once
// Plans which pictures are drawn at which times, and their uses.

#include "export/timeline.h"
#include "scene/output.h"
#include "std.h"

namespace carom {

struct Scene;

/// One sequence of pictures of one size and quality. Frames, video and sheet share one where theirs are equal.
struct PictureStream {
  Size size;
  int samples = 4;
  int timeline_stream = 0;
  double interval = 1.0 / 30;  // s, simulated, from picture to picture of a film, apart from a slowdown
  int decimals = 3;            // with which times of pictures are written
  FilmClock clock{};
  bool charted = false;  // the pictures are those of a film, with a chart beside them
};

/// The uses of one PictureStream.
struct PictureUse {
  bool frames = false, film = false, sheet = false;
};

struct PictureStreams {
  /// timeline_stream is the index into `ticks` until a Timeline assigns its own.
  vector<PictureStream> streams;
  vector<PictureUse> uses;  // by stream
  vector<Ticks> ticks;      // by stream
};

/// One stream for frames and film if they agree in size, quality and instants, so that each picture is drawn once.
/// Throws ExportError for a film or a sheet that is impossible.
PictureStreams plan_pictures(const Scene& scene);

/// One picture at `time` (s), like those of the sheet.
PictureStream still_stream(const Scene& scene, double time);

/// The instants of all pictures that the scene requests, whichever of them --only leaves. If it requests none, those of
/// the pictures that --only adds, else the keyframes of gltf.
vector<Ticks> shown_instants(const Scene& scene);

/// The shape and quality of the sheet's pictures: those of the requested frames, else of the film, else the defaults of
/// frames. Whether --only leaves them does not matter.
PictureOutput sheet_model(const Scene& scene);

}  // namespace carom
