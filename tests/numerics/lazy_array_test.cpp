#include "numerics/lazy_array.h"
#include "std.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

TEST(LazyArray, HasTheCommonValueUntilItIsWritten) {
  LazyArray<int> array(3, 7);
  EXPECT_EQ(array[2], 7);
  EXPECT_TRUE(array.empty());
  array.write(1) = 5;
  EXPECT_FALSE(array.empty());
  EXPECT_EQ(array[0], 7);
  EXPECT_EQ(array[1], 5);
}

TEST(SparseArray, KeepsReferencesWhileOthersAreWritten) {
  SparseArray<int> array(1000);
  int& first = array.write(500);
  first = 3;
  for (size_t i = 0; i < 500; ++i) array.write(i) = 1;
  EXPECT_EQ(&array.write(500), &first);
  EXPECT_EQ(array[500], 3);
  EXPECT_EQ(array[999], 0);
}

}  // namespace
}  // namespace carom
