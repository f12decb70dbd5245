// Text of unknown origin made safe to display, and characters that look like others.
#include "yaml/printable.h"

#include "std.h"
#include "yaml/letters.h"
#include "yaml/lookalikes.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

TEST(Printable, KeepsLettersOfAllScripts) {
  EXPECT_EQ(printable("größe 球 \U0001F600"), "größe 球 \U0001F600");
}

TEST(Printable, EscapesWhatATerminalObeysOrHides) {
  EXPECT_EQ(printable("\x1b[2J"), "\\x1b[2J");
  EXPECT_EQ(printable("a\nb\t"), "a\\x0ab\\x09");
  EXPECT_EQ(printable("\u202e"), "\\u202e");
  EXPECT_EQ(printable("\u009b"), "\\u009b");
}

TEST(Printable, EscapesBytesThatAreNotUtf8) {
  EXPECT_EQ(printable("a\xff"), "a\\xff");
  EXPECT_EQ(printable("\xc3"), "\\xc3");
}

TEST(Escaped, BeyondSixteenBitsIsASurrogatePair) {
  EXPECT_EQ(escaped(0x202E), "\\u202e");
  EXPECT_EQ(escaped(0xE0001), "\\udb40\\udc01");
}

TEST(Utf8, LengthIsZeroForBytesThatAreNone) {
  char32_t code = 0;
  EXPECT_EQ(utf8_length("a", 0, code), 1);
  EXPECT_EQ(utf8_length("\u20ac", 0, code), 3);
  EXPECT_EQ(code, U'\u20ac');
  // A continuation, an overlong form, a surrogate, and a character beyond the last.
  for (const char* text : {"\x80", "\xc0\x80", "\xe0\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x82"})
    EXPECT_EQ(utf8_length(text, 0, code), 0) << printable(text);
}

TEST(Utf8, CountsAByteThatIsNoneAsACharacter) {
  EXPECT_EQ(count_characters("größe"), 5u);
  EXPECT_EQ(count_characters("a\xff\xfe"), 3u);
}

TEST(LowerCase, ChangesAsciiAlone) {
  EXPECT_EQ(in_lower_case("AbZ_1Ö"), "abz_1Ö");
}

TEST(Lookalike, IsNamedWithWhatIsMeant) {
  EXPECT_EQ(lookalike_in("1 \u2013 2"), "U+2013 is an en dash: write `-`");
  EXPECT_EQ(lookalike_in("größe - x"), "");
}

TEST(Lookalike, OfASpaceIsBlank) {
  EXPECT_TRUE(is_blank(lookalike_at("\u00a0", 0).value()));
  EXPECT_TRUE(is_blank(lookalike_at("\u200b", 0).value()));
  EXPECT_FALSE(is_blank(lookalike_at("\u2212", 0).value()));
  EXPECT_FALSE(lookalike_at(" ", 0));
}

}  // namespace
}  // namespace carom
