// Errors as a terminal shows them, and names that were meant.
#include "yaml/diagnostics.h"

#include "std.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

/// Errors of one text.
struct Listed {
  explicit Listed(string text, bool option = false) : sources{{option ? "--set x=1" : "a.yaml", text, option}} {}
  Listed(const Listed&) = delete;

  Listed& add(uint32_t offset, uint32_t length, const string& message, const string& remedy = "") {
    diagnostics.add({0, offset, length}, message, remedy);
    return *this;
  }
  string text() const { return diagnostics.text(false); }

  vector<Source> sources;
  Diagnostics diagnostics{sources};
};

TEST(Diagnostics, ShowPlaceLineCaretAndRemedy) {
  EXPECT_EQ(Listed("one: 1\nmass: red\n").add(13, 3, "no number", "expected a number").text(),
            "a.yaml:2:7: error: no number\n"
            "   2 | mass: red\n"
            "     |       ^~~\n"
            "     = expected a number\n");
}

TEST(Diagnostics, ShowEachLineOfARemedy) {
  EXPECT_EQ(Listed("x\n").add(0, 1, "wrong", "this\nor that").text(),
            "a.yaml:1:1: error: wrong\n   1 | x\n     | ^\n     = this\n     = or that\n");
}

TEST(Diagnostics, OfAnOptionHaveNoLine) {
  EXPECT_EQ(Listed("x=1", true).add(2, 1, "wrong").text(), "--set x=1: error: wrong\n     | x=1\n     |   ^\n");
}

TEST(Diagnostics, OfAWholeFileHaveNoPlace) {
  const vector<Source> sources;
  Diagnostics diagnostics(sources);
  diagnostics.add_unplaced("a.yaml", "no such file", "look for it");
  EXPECT_EQ(diagnostics.text(false), "a.yaml: error: no such file\n    = look for it\n");
}

TEST(Diagnostics, CountColumnsInCharactersAndCaretsInCells) {
  EXPECT_EQ(Listed("球: x\n").add(5, 1, "wrong").text(), "a.yaml:1:4: error: wrong\n   1 | 球: x\n     |     ^\n");
  EXPECT_EQ(Listed("e\u0301: x\n").add(5, 1, "wrong").text(),
            "a.yaml:1:5: error: wrong\n   1 | e\u0301: x\n     |    ^\n");
}

TEST(Diagnostics, HideWhatATerminalWouldObey) {
  EXPECT_EQ(Listed("\x1b[2J: x\n").add(6, 1, "wrong").text(),
            "a.yaml:1:7: error: wrong\n   1 | ?[2J: x\n     |       ^\n");
}

TEST(Diagnostics, ShowALongLineThroughAWindowAroundTheCaret) {
  const string shown = Listed(string(1000, 'a') + "X" + string(1000, 'b')).add(1000, 1, "wrong").text();
  EXPECT_EQ(shown, "a.yaml:1:1001: error: wrong\n   1 | ..." + string(60, 'a') + "X" + string(39, 'b') +
                       "...\n     |    " + string(60, ' ') + "^\n");
}

TEST(Diagnostics, ShowAPlaceAtTheEndOfTheText) {
  EXPECT_EQ(Listed("a: 1").add(4, 1, "too early").text(), "a.yaml:1:5: error: too early\n   1 | a: 1\n     |     ^\n");
  EXPECT_EQ(Listed("").add(0, 1, "empty").text(), "a.yaml:1:1: error: empty\n   1 | \n     | ^\n");
}

TEST(Diagnostics, PaintOnlyIfAsked) {
  Listed errors("x\n");
  errors.add(0, 1, "wrong");
  EXPECT_EQ(errors.text().find('\x1b'), string::npos);
  EXPECT_EQ(errors.diagnostics.text(true),
            "\x1b[1ma.yaml:1:1\x1b[0m: \x1b[1;31merror:\x1b[0m wrong\n   1 | x\n     | \x1b[1;32m^\x1b[0m\n");
}

TEST(Diagnostics, StandInTheOrderOfTheFileAndThoseWithoutPlaceFirst) {
  Listed errors("a\nb\n");
  errors.add(2, 1, "second").add(0, 1, "first").diagnostics.add_unplaced("a.yaml", "of all");
  vector<string> order;
  for (const ErrorRecord& record : errors.diagnostics.records()) order.push_back(record.message);
  EXPECT_EQ(order, (vector<string>{"of all", "first", "second"}));
}

TEST(Diagnostics, CountWhatTheyDoNotShow) {
  Listed errors(string(60, 'x'));
  for (uint32_t i = 0; i < 52; ++i) errors.add(i, 1, "wrong");
  EXPECT_TRUE(errors.text().ends_with("and 2 more errors\n"));
  EXPECT_EQ(errors.diagnostics.records().size(), 50u);
  EXPECT_EQ(errors.diagnostics.count(), 52u);
}

TEST(Diagnostics, OfRepeatedThingsAreOneThatCountsItsMembers) {
  Listed errors("balls: 1\n");
  errors.diagnostics.mark_repeated({0, 0, 5});
  errors.add(0, 5, "ball 1 is 0.5 m away").add(0, 5, "ball 22 is -7e3 m away").add(0, 5, "another fault");
  EXPECT_EQ(errors.diagnostics.count(), 2u);
  EXPECT_EQ(errors.diagnostics.added(), 3u);
  EXPECT_EQ(errors.diagnostics.records()[0].remedy, "in 2 members, of which this is the first");
}

TEST(Diagnostics, NameACharacterThatOnlyLooksRight) {
  EXPECT_EQ(Listed("x: \u22121\n").add(3, 4, "no number", "expected one").diagnostics.records()[0].remedy,
            "U+2212 is a minus sign: write `-`\nexpected one");
}

TEST(Diagnostics, InPartsHoldWhatWasMeant) {
  const ErrorRecord record = Listed("a\n").add(0, 1, "no key", "did you mean `radius`?").diagnostics.records()[0];
  EXPECT_EQ(record.file, "a.yaml");
  EXPECT_EQ(record.line, 1u);
  EXPECT_EQ(record.near, "radius");
}

TEST(InBackticks, ShortensAndHidesControlCharacters) {
  EXPECT_EQ(in_backticks("red"), "`red`");
  EXPECT_EQ(in_backticks("a\ab"), "`a?b`");
  EXPECT_EQ(in_backticks(string(61, 'x')), "`" + string(60, 'x') + "...`");
}

TEST(Nearest, CountsASwapAsOneEditAndIgnoresCase) {
  EXPECT_EQ(nearest("raduis", {"mass", "radius"}), "radius");
  EXPECT_EQ(nearest("MASS", {"mass", "radius"}), "mass");
  EXPECT_EQ(nearest("massa", {"mass", "radius"}), "mass");
}

TEST(Nearest, IsNoneIfTooMuchDiffersOrNothingStays) {
  EXPECT_EQ(nearest("wall", {"mass", "radius"}), "");
  EXPECT_EQ(nearest("x", {"y"}), "");
  EXPECT_EQ(nearest("", {"a"}), "");
  EXPECT_EQ(nearest(string(65, 'a'), {string_view("a")}), "");
}

TEST(Nearest, OfEquallyNearNamesIsTheFirst) {
  EXPECT_EQ(nearest("bat", {"cat", "rat"}), "cat");
  EXPECT_EQ(nearest("bat", {"rat", "cat"}), "rat");
}

TEST(SuggestName, ListsNamesIfNoneIsNear) {
  EXPECT_EQ(suggest_name("rde", {"red", "blue"}), "did you mean `red`?");
  EXPECT_EQ(suggest_name("green", {"x", "y"}), "there are `x` and `y`");
  EXPECT_EQ(suggest_name("green", {"x"}), "there is `x`");
  EXPECT_EQ(suggest_name("green", {}), "");
}

TEST(NamesText, CountsWhatIsTooMuchAndJoinsMembers) {
  EXPECT_EQ(names_text({"a", "b", "c"}, 3), "`a`, `b` and `c`");
  EXPECT_EQ(names_text({"a", "b", "c"}, 2), "`a`, `b` and 1 more");
  EXPECT_EQ(names_text({"gas.1", "gas.2", "red"}, 3), "`gas` and `red`");
}

TEST(SuggestionIn, IsTheNameBetweenBackticks) {
  EXPECT_EQ(suggestion_in("no key; did you mean `mass`?"), "mass");
  EXPECT_EQ(suggestion_in("expected `mass`"), "");
}

TEST(FaultAndRemedy, AreTwoLinesOrTwoSentences) {
  EXPECT_EQ(fault_and_remedy("wrong\n  do this").remedy, "do this");
  EXPECT_EQ(fault_and_remedy("wrong. Remedy: do this").fault, "wrong");
  EXPECT_EQ(fault_and_remedy("wrong").fault, "wrong");
  EXPECT_EQ(fault_and_remedy("wrong").remedy, "");
}

}  // namespace
}  // namespace carom
