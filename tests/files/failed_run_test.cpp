// Reasons of failed runs.
#include "files/failed_run.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

TEST(FailedRun, OfAFullDiskOrAFullQuotaIsKnownByItsText) {
  EXPECT_TRUE(names_full_disk("cannot write out/energy.csv: No space left on device"));
  EXPECT_TRUE(names_full_disk("cannot write out/energy.csv: Disk quota exceeded"));
  EXPECT_FALSE(names_full_disk("cannot write out/energy.csv: File too large"));
}

}  // namespace
}  // namespace carom
