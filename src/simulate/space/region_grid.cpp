// A hash-free grid for each octave of region sizes. Cells wrap around at the grid's end, so that space has no bounds
// and no cell needs a key. One grid for all sizes would have cells as wide as the largest region. Cells are cache
// lines, with overflow lines for crowded ones.
#include "simulate/space/region_grid.h"

#include <cstring>

#include "std.h"

namespace carom {

namespace {

// The number of regions in a cell for which a grid is made.
constexpr size_t regions_a_cell = 3;

}  // namespace

// Far beyond 2^60 cells everything shares the outermost cell. Searches are slower there, but correct.
RegionGrid::Cell RegionGrid::cell_of(float x, double per_width) {
  const double c = double(x) * per_width;
  if (!(std::abs(c) < 0x1p60)) return c < 0 ? -(Cell{1} << 60) : Cell{1} << 60;
  const auto whole = static_cast<Cell>(c);
  return whole - (double(whole) > c);
}

int64_t RegionGrid::wrap(Cell c, Cell low, int64_t cells) {
  const Cell at = c - low;
  if (uint64_t(at) < uint64_t(cells)) return at;
  const Cell rest = at % cells;
  return rest < 0 ? rest + cells : rest;
}

void RegionGrid::start(const Region& low, const Region& high) {
  low_ = low;
  high_ = high;
}

RegionGrid::Octave& RegionGrid::octave_of(int level) {
  const int number = (level + 3) >> 2;
  for (Octave& grid : octaves_)
    if (grid.number == number) return grid;
  const float half = half_of_level(4 * number);
  octaves_.push_back({number, half, 0.5 / double(half), {}, {}, {}, 0, 0});
  shape(octaves_.back(), 1);
  return octaves_.back();
}

/// Gives a grid as many cells as the space in use has, but no more than these regions need.
void RegionGrid::shape(Octave& grid, size_t regions) {
  const float low[3] = {low_.x, low_.y, low_.z};
  const float high[3] = {high_.x, high_.y, high_.z};
  int axis[3] = {0, 1, 2};
  double extent[3];

  for (int k = 0; k < 3; ++k) {
    grid.low[k] = cell_of(low[k], grid.per_width);
    extent[k] = double(cell_of(high[k], grid.per_width)) - double(grid.low[k]) + 1;
  }

  // The shortest axis comes first. The others share what it leaves.
  std::sort(axis, axis + 3, [&](int k, int l) { return extent[k] < extent[l]; });
  auto left = double(regions / regions_a_cell + 1);
  bool all = true;
  for (int k = 0; k < 3; ++k) {
    const double most = k == 0 ? std::cbrt(left) : k == 1 ? sqrt(left) : left;
    const double cells = min(extent[axis[k]], max(1.0, floor(most)));
    all = all && cells == extent[axis[k]];
    grid.cells[axis[k]] = int64_t(cells);
    left /= cells;
  }

  grid.buckets.assign(size_t(grid.cells[0] * grid.cells[1] * grid.cells[2]), {});
  grid.most = all ? ~size_t{0} : 2 * max(regions, 2 * regions_a_cell);
}

inline RegionGrid::Bucket& RegionGrid::bucket_of(Octave& grid, const Region& region) {
  const int64_t x = wrap(cell_of(region.x, grid.per_width), grid.low[0], grid.cells[0]);
  const int64_t y = wrap(cell_of(region.y, grid.per_width), grid.low[1], grid.cells[1]);
  const int64_t z = wrap(cell_of(region.z, grid.per_width), grid.low[2], grid.cells[2]);
  return grid.buckets[size_t((z * grid.cells[1] + y) * grid.cells[0] + x)];
}

void RegionGrid::link(Bucket& first, Entity i) {
  Bucket* bucket = &first;
  while (bucket->count == Bucket::room) {
    if (bucket->next == 0) {
      const bool in_overflow = bucket != &first;
      const size_t own = in_overflow ? size_t(bucket - overflow_.data()) : 0;

      // A new overflow bucket, or one that is free again.
      uint32_t number;
      if (free_.empty()) {
        overflow_.emplace_back();
        number = uint32_t(overflow_.size());
      } else {
        number = free_.back();
        free_.pop_back();
      }

      (in_overflow ? overflow_[own] : first).next = number;
      bucket = &overflow_[number - 1];
      break;
    }
    bucket = &overflow_[bucket->next - 1];
  }

  bucket->body[bucket->count++] = i;
}

void RegionGrid::unlink(Bucket& first, Entity i) {
  // All but the last of a cell's buckets are full.
  Bucket* at = &first;
  Bucket* before = nullptr;
  Entity* place = nullptr;

  for (;;) {
    Entity* const end = at->body + at->count;
    if (place == nullptr) {
      Entity* const found = std::find(at->body, end, i);
      if (found != end) place = found;
    }
    if (at->next == 0) break;
    before = at;
    at = &overflow_[at->next - 1];
  }

  *place = at->body[--at->count];
  if (at->count == 0 && before != nullptr) {
    free_.push_back(before->next);
    before->next = 0;
  }
}

void RegionGrid::grow(Octave& grid, span<const Region> regions) {
  vector<Entity> all;
  all.reserve(grid.regions);

  for (Bucket& first : grid.buckets) {
    for (const Bucket* bucket = &first;; bucket = &overflow_[bucket->next - 1]) {
      all.insert(all.end(), bucket->body, bucket->body + bucket->count);
      if (bucket->next == 0) break;
      free_.push_back(bucket->next);
    }
  }

  for (const uint32_t number : free_) overflow_[number - 1] = {};
  LargeVector<Bucket>().swap(grid.buckets);
  shape(grid, 2 * grid.regions);
  for (const Entity i : all) link(bucket_of(grid, regions[i]), i);
}

void RegionGrid::expect(int level, size_t regions) {
  Octave& grid = octave_of(level);
  if (grid.regions == 0) shape(grid, regions);
}

void RegionGrid::put(Entity i, span<const Region> regions, int level) {
  Octave& grid = octave_of(level);
  link(bucket_of(grid, regions[i]), i);
  if (++grid.regions > grid.most) grow(grid, regions);
}

void RegionGrid::remove(Entity i, const Region& region, int level) {
  Octave& grid = octave_of(level);
  unlink(bucket_of(grid, region), i);
  --grid.regions;
}

void RegionGrid::move(Entity i, const Region& from, int from_level, span<const Region> regions, int to_level) {
  if (Octave& grid = octave_of(to_level); &grid == &octave_of(from_level)) {
    Bucket &old = bucket_of(grid, from), &now = bucket_of(grid, regions[i]);
    if (&old == &now) return;
    unlink(old, i);
    link(now, i);
    return;
  }
  remove(i, from, from_level);
  put(i, regions, to_level);
}

/// Appends the bodies in these cells to the `count` found. Keeps room for `most` more after each overflow, and for
/// `slack`.
void RegionGrid::take(const Bucket* from, const Bucket* end, size_t most, size_t& count, vector<Entity>& found) const {
  Entity* to = found.data() + count;

  for (; from != end; ++from) {
    std::memcpy(to, from->body, sizeof(from->body));
    to += from->count;
    if (from->next == 0) [[likely]]
      continue;

    // The rest of a crowded cell is in overflow buckets.
    count = size_t(to - found.data());
    for (const Bucket* bucket = from; bucket->next != 0;) {
      bucket = &overflow_[bucket->next - 1];
      const size_t room = count + bucket->count + most + slack;
      if (found.size() < room) found.resize(2 * room);
      std::memcpy(found.data() + count, bucket->body, sizeof(bucket->body));
      count += bucket->count;
    }
    to = found.data() + count;
  }
  count = size_t(to - found.data());
}

size_t RegionGrid::near(const Region& region, vector<Entity>& found) const {
  size_t count = 0;
  const float middle[3] = {region.x, region.y, region.z};
  for (const Octave& grid : octaves_) {
    if (grid.regions == 0) continue;
    const float reach = (region.half + grid.half) * (1 + 0x1p-20F);

    // The cells within reach, by axis.
    int64_t from[3];
    int64_t cells[3];
    for (int k = 0; k < 3; ++k) {
      const Cell low = cell_of(middle[k] - reach, grid.per_width);
      const Cell high = cell_of(middle[k] + reach, grid.per_width);
      const bool all = high - low + 1 >= grid.cells[k] || !(reach < 0x1p126F);
      from[k] = all ? 0 : wrap(low, grid.low[k], grid.cells[k]);
      cells[k] = all ? grid.cells[k] : high - low + 1;
    }

    // Room for all that may be there.
    const auto most = size_t(cells[0] * cells[1] * cells[2]) * Bucket::room;
    const size_t room = count + most + slack;
    if (found.size() < room) found.resize(2 * room);

    // The cells of a row are contiguous, except for those beyond the grid's last one.
    const int64_t first = min(cells[0], grid.cells[0] - from[0]);
    const int64_t rest = cells[0] - first;
    const auto next = [&](int64_t at, int k) { return at + 1 == grid.cells[k] ? 0 : at + 1; };

    int64_t z = from[2];
    for (int64_t dz = 0; dz < cells[2]; ++dz, z = next(z, 2)) {
      int64_t y = from[1];
      for (int64_t dy = 0; dy < cells[1]; ++dy, y = next(y, 1)) {
        const Bucket* const row = grid.buckets.data() + (z * grid.cells[1] + y) * grid.cells[0];
        take(row + from[0], row + from[0] + first, most, count, found);
        if (rest > 0) take(row, row + rest, most, count, found);
      }
    }
  }
  return count;
}

}  // namespace carom
