#include "export/frame_files.h"

#include <exception>

#include "scene/output_kinds.h"
#include "std.h"

namespace carom {

FrameFiles::FrameFiles(FolderWriter& folder, size_t threads)
    : series_(folder, frame_files),
      frames_([this](Frame& frame) { series_.put(frame.number, frame.png.encode()); }, 0, threads > 1 ? threads : 0) {}

FrameFiles::~FrameFiles() {
  try {
    frames_.finish();
  } catch (const std::exception&) {
    // Another error ends the run.
  }
}

void FrameFiles::put(int64_t number, const Image& image, bool again) {
  if (again && last_ != nullptr) {
    frames_.finish();
    series_.put(number, last_->file());
    return;
  }
  Frame& frame = frames_.item();
  frame.number = number;
  frame.png.take(image);
  last_ = &frame.png;
  frames_.send();
}

}  // namespace carom
