#pragma once
// The pictures in an animated WebP, which ffprobe 5 cannot read.

#include "files/output_file.h"
#include "std.h"

namespace carom {

/// How many pictures at `fps` a second the durations of a WebP amount to. Equal pictures are stored as one long one.
/// None: a still picture, as of a film whose pictures are all equal. 0: a damaged file. Throws ExportError if it cannot
/// be read.
optional<uint64_t> webp_frames(const FilePlace& place, const string& name, double fps);

}  // namespace carom
