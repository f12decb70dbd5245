// Lists pairs in colours, greedily by a bit for each colour of a body. Bodies with many contacts run out of bits: their
// other rows have groups of their own.
#include "simulate/crowd/crowd_rows.h"

#include <bit>

#include "std.h"

namespace carom {

namespace {

constexpr uint32_t colours = 64;

/// Numbers of pairs, by colour. The last list has the pairs without a colour.
using Colours = array<vector<uint32_t>, colours + 1>;

}  // namespace

void CrowdRows::clear() {
  hot.clear();
  change.clear();
  state.clear();
  names.clear();
  parts.clear();
}

void CrowdRows::add_part(span<const Pair> pairs, uint32_t movable, uint32_t dummy) {
  RowPart part{groups(), groups(), groups()};

  // Writes a pair into a lane.
  const auto fill = [&](size_t group, size_t lane, const Pair& pair) {
    hot[group].a[lane] = pair.a;
    hot[group].b[lane] = pair.b;
    hot[group].share[lane] = 1 / pair.inverse;
    change[group].inverse[lane] = pair.inverse;
    state[group].force[lane] = pair.force;
    state[group].slow[lane] = pair.slow;
    state[group].shell[lane] = pair.shell;
    state[group].e[lane] = pair.e;
    names[group][lane] = pair.name;
  };

  // Lanes of a new group are empty.
  const auto open_group = [&] {
    hot.push_back({});
    change.push_back({});
    state.push_back({});
    names.push_back({});
    for (size_t lane = 0; lane < lanes; ++lane) {
      hot.back().a[lane] = hot.back().b[lane] = dummy;
      state.back().gap[lane] = 1;
    }
    return hot.size() - 1;
  };

  // Pairs of balls come first.
  Colours by_colour;
  used_.resize(max<size_t>(used_.size(), movable));
  for (const bool balls : {true, false}) {
    for (const Pair& pair : pairs) used_[pair.a] = used_[pair.b < movable ? pair.b : pair.a] = 0;
    for (vector<uint32_t>& colour : by_colour) colour.clear();
    for (uint32_t k = 0; k < pairs.size(); ++k) {
      const Pair& pair = pairs[k];
      if (pair.balls != balls) continue;
      const uint64_t taken = used_[pair.a] | (pair.b < movable ? used_[pair.b] : 0);
      const auto colour = uint32_t(std::countr_one(taken));
      by_colour[colour].push_back(k);

      if (colour == colours) continue;
      used_[pair.a] |= uint64_t{1} << colour;
      if (pair.b < movable) used_[pair.b] |= uint64_t{1} << colour;
    }

    // Groups of four, but for pairs without a colour. Those that press are together.
    for (uint32_t colour = 0; colour <= colours; ++colour) {
      const size_t together = colour == colours ? 1 : lanes;
      std::stable_partition(by_colour[colour].begin(), by_colour[colour].end(),
                            [&](uint32_t k) { return pairs[k].near; });
      for (size_t k = 0; k < by_colour[colour].size(); ++k) {
        if (k % together == 0) open_group();
        fill(hot.size() - 1, k % together, pairs[by_colour[colour][k]]);
      }
    }
    if (balls) part.balls = groups();
  }

  part.end = groups();
  parts.push_back(part);
}

}  // namespace carom
