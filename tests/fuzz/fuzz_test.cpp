// The short part: each target's seeds, then some thousands of inputs made from them (for long: ./dev fuzz).
#include <gtest/gtest.h>

#include "fuzz/mutate.h"
#include "fuzz/targets.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom::fuzz {
namespace {

class AnyBytes : public ::testing::TestWithParam<const char*> {
 protected:
  const Target& target() const { return *find_target(GetParam()); }

  void run(const string& input) const {
    try {
      target().run(input);
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what() << "\nof the input\n" << ::testing::PrintToString(input);
    }
  }
};

TEST_P(AnyBytes, OfSeedsKeepGuarantees) {
  SLOW_WITH_SANITIZERS("simulators");
  const vector<string> seeds = target().seeds();
  EXPECT_FALSE(seeds.empty());
  for (const string& seed : seeds) run(seed);
}

TEST_P(AnyBytes, KeepGuarantees) {
  SLOW_WITH_SANITIZERS("simulators");
  const vector<string> seeds = target().seeds(), all_words = words();
  Mutator mutator(1, seeds, all_words);
  // A mesh's reader is a process, a simulation takes milliseconds.
  const bool slow = string_view(GetParam()) == "mesh" || string_view(GetParam()) == "simulators";
  for (int k = slow ? 200 : 3000; k > 0 && !HasFailure(); --k) run(mutator.next(target().longest));
}

INSTANTIATE_TEST_SUITE_P(Targets, AnyBytes,
                         ::testing::Values("scene", "sweep", "settings", "mesh_reply", "mesh", "flights", "manifest",
                                           "table", "simulators"),
                         [](const auto& target) { return string(target.param); });

TEST(Targets, AreAllInTheShortPart) {
  EXPECT_EQ(targets().size(), 9u);
}

}  // namespace
}  // namespace carom::fuzz
