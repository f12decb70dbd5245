#include "numerics/team.h"
#include "std.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace carom {
namespace {

TEST(Team, CallsATaskOnceByEachThreadAndWaitsForAll) {
  for (const int count : {1, 2, 5}) {
    Team team(count);
    ASSERT_EQ(team.size(), count);
    vector<int> calls(static_cast<size_t>(count), 0);
    for (int k = 1; k <= 2000; ++k) {
      team.run([&](int thread) { ++calls[static_cast<size_t>(thread)]; });
      for (const int of_thread : calls) ASSERT_EQ(of_thread, k);
    }
  }
}

TEST(Team, ThatHasWaitedLongDoesTheNextTask) {
  Team team(3);
  vector<int> calls(3, 0);
  for (int k = 0; k < 3; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    team.run([&](int thread) {
      if (thread == 1) std::this_thread::sleep_for(std::chrono::milliseconds(5));
      ++calls[static_cast<size_t>(thread)];
    });
  }
  EXPECT_EQ(calls, (vector<int>{3, 3, 3}));
}

}  // namespace
}  // namespace carom
