// The cause of text that is not YAML, at the place where its author looks for it.
#include "yaml/syntax.h"

#include "std.h"
#include "yaml/parsed.h"

namespace carom {
namespace {

TEST(Syntax, AnOpenBracketIsShownWhereItOpens) {
  EXPECT_EQ(Parsed("a: [1, 2\nb: 3\n").error(), "1:4 this `[` is never closed = expected `]` before the next key");
  EXPECT_EQ(Parsed("a: {x: 1\n").error(), "1:4 this `{` is never closed = expected `}` before the next key");
}

TEST(Syntax, AnOpenQuoteIsShownWhereItOpens) {
  EXPECT_EQ(Parsed("a: 'one\nb: two\n").error(), "1:4 this `'` is never closed = expected `'` before the next key");
}

TEST(Syntax, BracketsOfTwoKindsAreShownTogether) {
  EXPECT_EQ(Parsed("a:\n  [1, 2}\n").error(), "2:8 `}` cannot close the `[` of line 2 = expected `]`");
}

TEST(Syntax, BracketsInQuotesAndCommentsAreNone) {
  const Parsed file("a: 'it''s [' # {\nb: \"\\\"[\"\n");
  EXPECT_TRUE(file.diagnostics.empty()) << file.errors();
}

TEST(Syntax, ABracketTooManyIsRemoved) {
  EXPECT_EQ(Parsed("a: 1\nb: [1]]\n").error(), "2:7 this bracket closes nothing = remove it");
}

TEST(Syntax, ASecondColonInALineNeedsQuotes) {
  EXPECT_EQ(Parsed("title: one: two\n").error(),
            "1:11 a second ':' in this line = expected one `key: value` a line; text that holds ': ' needs quotes");
}

TEST(Syntax, ALineWithoutAColonIsTheFaultNotTheNextOne) {
  EXPECT_EQ(Parsed("a: 1\nword\nb: 2\n").error(), "2:1 this line has no ':' = expected `key: value`");
}

TEST(Syntax, ALineThatIsIndentedBelowAValueIsShown) {
  EXPECT_EQ(Parsed("a: 1\n  b: 2\n").error(),
            "2:3 this line is indented further than the line above, which has its value already = expected the same "
            "indentation");
}

TEST(Syntax, AColourWithoutQuotesBeginsAComment) {
  EXPECT_EQ(Parsed("a: {color: #ff0000, b: 1}\n").error(),
            "1:12 `#ff0000` begins a comment, which hides the rest of the line = a colour that begins with # needs "
            "quotes: '#ff0000'");
}

TEST(Syntax, TextAfterABracketNeedsQuotes) {
  EXPECT_EQ(Parsed("caption: {time} s\n").error(),
            "1:17 text goes on after the closing bracket = a text that begins with a bracket or a brace needs quotes");
}

TEST(Syntax, ANoBreakSpaceAtTheStartOfALineIsNamed) {
  EXPECT_EQ(Parsed("a: 1\n\u00a0b: 2: 3\n").error(),
            "2:1 this is no space to YAML = U+00A0 is a no-break space: write a plain space");
}

TEST(Syntax, AnUnknownEscapeNeedsSingleQuotes) {
  EXPECT_EQ(Parsed("a: \"C:\\dir\"\n").error(),
            "1:7 an unknown escape in a text in double quotes = in single quotes a backslash is just a backslash");
}

TEST(Syntax, PlainTextCannotBeginWithSomeCharacters) {
  EXPECT_EQ(Parsed("a: @home\n").error(), "1:4 plain text cannot begin with `@` = put the text in quotes");
}

TEST(Syntax, AListEntryInALineOfItsKeyIsRefused) {
  EXPECT_EQ(Parsed("a: - 1\n").error(),
            "1:4 a list entry cannot begin here = expected lists as [a, b], or `- ` in lines of their own");
}

}  // namespace
}  // namespace carom
