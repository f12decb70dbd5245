// Copies the balls of each cell: a test of sixteen then reads five neighbouring lines of the cache.
#include "raster/ball_packs.h"

#include <tuple>

#include "std.h"

namespace carom::raster {

void BallPacks::fill(const Shot& shot, const LightCells& balls, const vector<float>& towards_light) {
  const size_t cells = balls.start.size() - 1;
  constexpr size_t wide = std::tuple_size_v<decltype(BallPack::x)>;

  // Where each cell's packs begin.
  first.resize(cells + 1);
  uint32_t count = 0;
  for (size_t cell = 0; cell < cells; ++cell) {
    first[cell] = count;
    count += uint32_t((balls.of(cell).size() + wide - 1) / wide);
  }

  first.back() = count;
  packs.resize(count), last_place.resize(count);

  for (size_t cell = 0; cell < cells; ++cell) {
    span<const uint32_t> left = balls.of(cell);
    for (uint32_t k = first[cell]; k < first[cell + 1]; ++k) {
      BallPack& to = packs[k];
      const span<const uint32_t> members = left.first(std::min(left.size(), wide));
      left = left.subspan(members.size());

      for (size_t i = 0; i < members.size(); ++i) {
        const Solid& s = shot.solids[members[i]];
        to.x[i] = s.center[0], to.y[i] = s.center[1], to.z[i] = s.center[2], to.radius[i] = s.radius;
        to.solid[i] = int32_t(members[i]);
      }

      // The places left over have balls without size.
      for (size_t i = members.size(); i < wide; ++i) to.x[i] = to.y[i] = to.z[i] = to.radius[i] = 0, to.solid[i] = -1;
      last_place[k] = members.size() == wide ? towards_light[members.back()] : numeric_limits<float>::infinity();
    }
  }
}

}  // namespace carom::raster
