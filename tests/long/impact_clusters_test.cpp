// A hundred thousand random clusters of 2 to 60 bodies that are struck at one instant.
#include "simulate/impact_clusters.h"
#include "std.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

namespace carom {
namespace {

using namespace impact_clusters;

TEST(ImpactClusters, AHundredThousandKeepAllGuarantees) {
  Findings all;
  double longest = 0;  // s, of one with its images
  for (uint64_t seed = 0; seed < 100'000; ++seed) {
    const auto start = std::chrono::steady_clock::now();
    examine(seed, 60, all, seed % 2 == 0 ? Walls::still : Walls::moving);
    longest = std::max(longest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }

  expect_guarantees(all);
  std::printf(
      "%u rounds and %.2g s at most; %llu ended by their limit, %llu for want of room; gain %.1e, books %.1e, momentum "
      "%.1e, approach %.1e, pull %.1e, e = 0 %.1e and %.1e; mirrored by more than 1e-15 off in %llu, %.1e at most\n",
      all.rounds, longest, static_cast<unsigned long long>(all.ended),
      static_cast<unsigned long long>(all.without_room), all.gain, all.books, all.momentum, all.approach, all.pull,
      all.projection, all.distance, static_cast<unsigned long long>(all.mirror_far), all.mirror);
}

}  // namespace
}  // namespace carom
