#pragma once
// The source chapter's own program: frame by frame, overlap by overlap. See book.cpp.

#include "simulate/simulator.h"
#include "std.h"

namespace carom {

struct World;

struct BookOptions {
  double step = 1.0 / 60;         // s, of a frame
  bool as_printed = false;        // listings 8.3 and 8.4 with their slips
  uint64_t max_collisions = 0;    // limit, an error beyond it; 0: no limit
  bool record_collisions = true;  // false: there is no buffer, and collisions() stays empty
  bool record_paths = false;      // false: there is no buffer for paths()
  bool stop_at_rest = false;
  uint64_t stop_collisions = 0;     // 0: none
  vector<WatchedQuantity> watch{};  // for extremes()
};

/// `world` must outlive the simulator. `initial` is at time 0, before the world's impulses (forces of the first frame).
unique_ptr<Simulator> make_book_simulator(const World& world, const State& initial, const BookOptions& options);

}  // namespace carom
