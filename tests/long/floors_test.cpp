#include "simulate/floors.h"
#include "std.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

TEST(LongFloors, ABodyAndThoseThatItCarriesCrossTenThousandOfThemUnharmed) {
  for (const Sliding kind : {Sliding::ball, Sliding::box, Sliding::cylinder})
    for (const int riders : {0, 1, 2})
      for (uint64_t seed = 1; seed <= 10'000; ++seed)
        EXPECT_EQ(fault_of(random_crossing(kind, seed, riders)), "")
            << seed << ", body " << static_cast<int>(kind) << ", " << riders;
}

}  // namespace
}  // namespace carom
