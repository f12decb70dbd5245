#include "commands/text.h"
#include "std.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

TEST(Text, QuantitiesHaveFourDigitsAndAUnit) {
  EXPECT_EQ(quantity(0.44721359549995793, "s"), "0.4472 s");
  EXPECT_EQ(quantity(-0.0, "J"), "0 J");
  EXPECT_EQ(quantity(1.5e12, "m"), "1.5e+12 m");
  EXPECT_EQ(quantity(std::numeric_limits<double>::quiet_NaN(), "s"), "-");
}

TEST(Text, CountsAreGroupedByThousandsAndAgreeWithTheirNoun) {
  EXPECT_EQ(counted(0, "frame", "frames"), "0 frames");
  EXPECT_EQ(counted(1, "frame", "frames"), "1 frame");
  EXPECT_EQ(counted(999, "frame", "frames"), "999 frames");
  EXPECT_EQ(counted(1000, "frame", "frames"), "1,000 frames");
  EXPECT_EQ(counted(12345678, "frame", "frames"), "12,345,678 frames");
}

TEST(Text, BytesGoUpInPowersOfAThousand) {
  EXPECT_EQ(bytes_text(1), "1 byte");
  EXPECT_EQ(bytes_text(999), "999 bytes");
  EXPECT_EQ(bytes_text(1000), "1.0 kB");
  EXPECT_EQ(bytes_text(999'600), "1.0 MB");
  EXPECT_EQ(bytes_text(23'400'000), "23 MB");
  EXPECT_EQ(bytes_text(std::numeric_limits<uint64_t>::max()), "18 EB");
}

TEST(Text, WaitsHaveReadableUnits) {
  EXPECT_EQ(wait_text(0.0024), "2.4 ms");
  EXPECT_EQ(wait_text(0.24), "240 ms");
  EXPECT_EQ(wait_text(1.5), "1.50 s");
  EXPECT_EQ(wait_text(59.4), "59 s");
  EXPECT_EQ(wait_text(59.6), "1 min 0 s");
  EXPECT_EQ(wait_text(7500), "2 h 5 min");
  EXPECT_EQ(wait_text(infinity), "-");
  EXPECT_EQ(wait_text(-1), "-");
}

TEST(Text, LongListsHaveTheNumberLeftOut) {
  using Names = vector<string>;
  EXPECT_EQ(listed(Names{}), "");
  EXPECT_EQ(listed(Names{"a"}), "a");
  EXPECT_EQ(listed(Names{"a", "b"}), "a and b");
  EXPECT_EQ(listed(Names{"a", "b", "c"}), "a, b and c");
  EXPECT_EQ(listed(Names{"a", "b", "c", "d"}, 2), "a, b and 2 more");
}

TEST(Text, LinesBreakAtSpacesBeforeTheWidth) {
  EXPECT_EQ(wrapped("one two three", 2, 9), "one two\n  three");
  EXPECT_EQ(wrapped("one two three", 2, 100), "one two three");
  EXPECT_EQ(wrapped("averyverylongword b", 2, 9), "averyverylongword\n  b");
  EXPECT_EQ(wrapped("", 2, 9), "");
}

TEST(Text, ControlCharactersDoNotReachTheTerminal) {
  EXPECT_EQ(printable("a\x1b[2Jb\n"), "a\\x1b[2Jb\\x0a");
  EXPECT_EQ(printable("\xff \xc2\x9b ü"), "\\xff \\u009b ü");
  EXPECT_EQ(printable("\u202e\u2028\ufeff\u200b\U000e0001 \u00e9"), R"(\u202e\u2028\ufeff\u200b\udb40\udc01 é)");
}

TEST(Text, AShellGetsUnprintableCharactersByTheirBytes) {
  EXPECT_EQ(shell_word("a\u202eb"), R"sh("$(printf '\141\342\200\256\142')")sh");
}

}  // namespace
}  // namespace carom
