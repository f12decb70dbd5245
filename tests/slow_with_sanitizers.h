#pragma once
// Marks of tests that the build with sanitizers leaves out. There a test without a mark has two minutes: see
// tests/CMakeLists.txt. With SLOW_TOO in the environment, as in ./dev stress, none is left out, and scenes run to their
// end.

#include <gtest/gtest.h>

#include <cstdlib>
#include <initializer_list>

#include "std.h"

namespace carom {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool with_sanitizers = true;
#elif defined(__has_feature)
inline constexpr bool with_sanitizers = __has_feature(address_sanitizer);
#else
inline constexpr bool with_sanitizers = false;
#endif

inline bool slow_too() {
  return std::getenv("SLOW_TOO") != nullptr;
}

/// Whether the running test is left out. `words`: parts of the names or values of the parameters that are slow; none:
/// all are.
inline bool is_left_out(std::initializer_list<string_view> words) {
  if (!with_sanitizers || slow_too()) return false;
  const ::testing::TestInfo& test = *::testing::UnitTest::GetInstance()->current_test_info();
  const string names = string(test.name()) + " " + (test.value_param() == nullptr ? "" : test.value_param());
  const auto is_in_names = [&](string_view word) { return names.find(word) != string::npos; };
  return words.size() == 0 || any_of(words, is_in_names);
}

}  // namespace carom

/// The first line of a test that takes more than some 30 s with sanitizers. In brackets: words of the slow parameters.
#define SLOW_WITH_SANITIZERS(...) \
  if (carom::is_left_out({__VA_ARGS__})) GTEST_SKIP() << "slow with sanitizers"

/// The first line of a test of limits (of memory, open files and time), which sanitizers exceed by themselves.
#define NOT_WITH_SANITIZERS() \
  if (carom::with_sanitizers) GTEST_SKIP() << "sanitizers exceed its limits"
