#include "scene/film_layout.h"

#include "numerics/whole.h"
#include "std.h"

namespace carom {

int64_t title_pictures(const VideoOutput& video) {
  return video.title ? max<int64_t>(nearest_whole(title_length * video.fps), 1) : 0;
}

FilmLayout layout_of(const VideoOutput& video) {
  const Size whole = video.size;
  if (!video.chart) return {whole, {0, 0}};
  if (3 * whole.width >= 4 * whole.height) {
    const int left = whole.width - whole.width / 3;
    return {{left, whole.height}, {whole.width - left, whole.height}, left, 0};
  }
  const int top = whole.height - whole.height / 3;
  return {{whole.width, top}, {whole.width, whole.height - top}, 0, top};
}

}  // namespace carom
