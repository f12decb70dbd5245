// Scalars to numbers, and what is said of those that are none.
#include "yaml/values.h"

#include "std.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

/// What is said of a plain scalar in place of a mass: "message = remedy".
string complaint_about(const string& text, bool quoted = false) {
  Node node;
  node.kind = Node::Kind::scalar;
  node.text = text;
  node.quoted = quoted;
  const Complaint complaint = explain_number(node, {"mass", "kg", "expected kg"});
  return complaint.message + " = " + complaint.remedy;
}

TEST(ParseNumber, ReadsDecimalsInAllSpellings) {
  EXPECT_EQ(parse_number("-1.5e3"), -1500.0);
  EXPECT_EQ(parse_number("+2"), 2.0);
  EXPECT_EQ(parse_number(".5"), 0.5);
  EXPECT_EQ(parse_number("5."), 5.0);
  EXPECT_EQ(parse_number("0"), 0.0);
}

TEST(ParseNumber, IsStricterThanYaml) {
  for (const char* text : {"", "007", "0x10", "1_000", "inf", ".nan", "1e", "1 kg", ".", "-", "1,5", " 1"})
    EXPECT_FALSE(parse_number(text)) << text;
}

TEST(ParseNumber, RefusesWhatADoubleDoesNotHold) {
  EXPECT_FALSE(parse_number("1e309"));
  EXPECT_FALSE(parse_number("1e-400"));
  EXPECT_EQ(parse_number("0e-400"), 0.0);
}

TEST(ParseWhole, TakesAnyNumberThatIsWhole) {
  EXPECT_EQ(parse_whole("12"), 12u);
  EXPECT_EQ(parse_whole("1e6"), 1'000'000u);
  EXPECT_EQ(parse_whole("2.0"), 2u);
  EXPECT_EQ(parse_whole("18446744073709551615"), 18446744073709551615u);
  for (const char* text : {"-1", "0.5", "01", "1e16", "x"}) EXPECT_FALSE(parse_whole(text)) << text;
}

TEST(ParseIndex, TakesDigitsAlone) {
  EXPECT_EQ(parse_index("10"), 10u);
  EXPECT_EQ(parse_index("0"), 0u);
  for (const char* text : {"1e1", "01", "+1", "1.0", ""}) EXPECT_FALSE(parse_index(text)) << text;
}

TEST(IsInfinite, KnowsWordsWithoutASign) {
  for (const char* text : {"inf", ".Inf", "Infinity"}) EXPECT_TRUE(is_infinite(text)) << text;
  for (const char* text : {"-inf", "info", ""}) EXPECT_FALSE(is_infinite(text)) << text;
}

TEST(ExplainNumber, TellsQuotesFromWords) {
  EXPECT_EQ(complaint_about("1", true), "`1` in quotes is text, not a number = without quotes: 1");
  EXPECT_EQ(complaint_about("red", true), "`red` is not a number = expected kg");
  EXPECT_EQ(complaint_about("red"), "`red` is not a number = expected kg");
}

TEST(ExplainNumber, NamesNumbersOfOtherLanguages) {
  EXPECT_EQ(complaint_about("-.inf"), "`-.inf` is not a finite number = expected kg");
  EXPECT_EQ(complaint_about("0x1F"), "`0x1F` is not a decimal number = expected kg");
  EXPECT_EQ(complaint_about("1_000"), "`1_000` is not a number = write 1000");
  EXPECT_EQ(complaint_about("1,5"), "`1,5` has a comma = the decimal point is a point: 1.5");
  EXPECT_EQ(complaint_about("-007.5"), "`-007.5` has a leading zero = write -7.5");
  EXPECT_EQ(complaint_about("00"), "`00` has a leading zero = write 0");
}

TEST(ExplainNumber, TellsLargeFromSmall) {
  EXPECT_EQ(complaint_about("1e999"), "`1e999` is too large for a double = expected kg; the largest is about 1.8e308");
  EXPECT_EQ(complaint_about("1e-999"),
            "`1e-999` is too small for a double = expected kg; the smallest is about 5e-324");
}

TEST(ExplainNumber, SaysWhetherAUnitIsTheRightOne) {
  EXPECT_EQ(complaint_about("2 kg"), "`2 kg` carries a unit = `mass` is always in kg: write 2");
  EXPECT_EQ(complaint_about("2 lb"), "`2 lb` carries a unit = `mass` is always in kg: write the number alone");
}

TEST(Shortest, ParsesToTheSameDouble) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(-0.0), "0");
  EXPECT_EQ(shortest(1e300), "1e+300");
  for (const double value : {0.1 + 0.2, 1.0 / 3, 5e-324, 1.7976931348623157e308})
    EXPECT_EQ(parse_number(shortest(value)), value);
}

TEST(IsName, BeginsWithALetter) {
  for (const char* text : {"a", "_", "Ball-2_b"}) EXPECT_TRUE(is_name(text)) << text;
  for (const char* text : {"", "2a", "-a", "a b", "a.b", "ö"}) EXPECT_FALSE(is_name(text)) << text;
  EXPECT_TRUE(is_name(string(200, 'a')));
  EXPECT_FALSE(is_name(string(201, 'a')));
}

}  // namespace
}  // namespace carom
