#pragma once
// The numbered pictures of frames/, encoded and written by several threads.

#include "export/png.h"
#include "files/conveyor.h"
#include "files/series.h"
#include "std.h"

namespace carom {

class FrameFiles {
 public:
  /// `threads`: 1 is the caller's own thread. More encode the pictures while the caller draws the next ones.
  /// The files and their bytes do not depend on it. `folder` must outlive this object.
  /// Throws ExportError, as all functions of this class do.
  FrameFiles(FolderWriter& folder, size_t threads);
  /// Writes the pictures that are on their way, as far as possible.
  ~FrameFiles();

  /// `again`: the picture equals the one before. Waits while as many pictures as there are threads, and three more, are
  /// on their way. Throws the error of an earlier picture, too.
  void put(int64_t number, const Image& image, bool again);
  /// Waits until all pictures are written.
  void finish() { frames_.finish(); }
  /// The files written, by number; after finish().
  vector<FileRecord> records() const { return series_.records(); }

 private:
  struct Frame {
    int64_t number = 0;
    PngEncoder png;
  };

  Series series_;
  const PngEncoder* last_ = nullptr;  // of the frame before
  Conveyor<Frame> frames_;            // last, because its threads use series_
};

}  // namespace carom
