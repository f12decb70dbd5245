// The short part: each target's first inputs, then hundreds or thousands made from them. (./dev fuzz goes on for long,
// with libFuzzer's own mutations.)
#include <gtest/gtest.h>

#include "fuzz/mutate.h"
#include "fuzz/targets.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom::fuzz {

/// For the names of tests.
static std::ostream& operator<<(std::ostream& out, const Target& target) {
  return out << target.name;
}

namespace {

class AnyBytes : public ::testing::TestWithParam<Target> {
 protected:
  const Target& target() const { return GetParam(); }

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
  const vector<string> first_inputs = target().seeds(), all_words = words();
  Mutator mutator(1, first_inputs, all_words);
  for (int k = target().tries; k > 0 && !HasFailure(); --k) run(mutator.next(target().longest));
}

INSTANTIATE_TEST_SUITE_P(Targets, AnyBytes, ::testing::ValuesIn(targets().begin(), targets().end()),
                         [](const auto& test) { return string(test.param.name); });

}  // namespace
}  // namespace carom::fuzz
