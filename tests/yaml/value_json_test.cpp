// Values of a scene file as JSON, and as cells of a table.
#include "yaml/value_json.h"

#include "std.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

string json_text(string_view yaml) {
  return text_of_json(json_of_yaml(yaml));
}

TEST(ValueJson, HasTheTypeThatTheLoaderGivesAScalar) {
  EXPECT_EQ(json_text("[1, 2.0, 0.5, 1e3]"), "[1,2,0.5,1000]");
  EXPECT_EQ(json_text("[true, false, yes, 'true']"), R"([true,false,"yes","true"])");
  EXPECT_EQ(json_text("['1', word, 007]"), R"(["1","word","007"])");
}

TEST(ValueJson, KeepsTheOrderOfMapsAndNull) {
  EXPECT_EQ(json_text("{b: 1, a: {c: [x]}}"), R"({"b":1,"a":{"c":["x"]}})");
  EXPECT_EQ(json_text("{a: }"), R"({"a":null})");
}

TEST(ValueJson, OfAWholeNumberHasNoFraction) {
  EXPECT_EQ(text_of_json(number_json(2.0)), "2");
  EXPECT_EQ(text_of_json(number_json(-0.5)), "-0.5");
  EXPECT_EQ(text_of_json(number_json(1e300)), "1e+300");
}

TEST(JsonText, ReplacesBytesThatAreNotUtf8) {
  EXPECT_EQ(text_of_json("a\xff"), "\"a\ufffd\"");
  EXPECT_EQ(text_of_json({{"a", 1}}, 2), "{\n  \"a\": 1\n}");
}

TEST(JsonText, ThatIsNoneIsDiscarded) {
  EXPECT_TRUE(json_of_text("{").is_discarded());
  EXPECT_EQ(json_of_text("[1]")[0], 1);
}

TEST(CellText, HasNoQuotesOfYaml) {
  EXPECT_EQ(cell_text("\"#ff0000\""), "#ff0000");
  EXPECT_EQ(cell_text("'it''s'"), "it's");
  EXPECT_EQ(cell_text("[1, 2]"), "[1, 2]");
  EXPECT_EQ(cell_text("0.50"), "0.50");
}

TEST(CellText, HasNoPlusSign) {
  EXPECT_EQ(cell_text("+1.50"), "1.5");
  EXPECT_EQ(cell_text("+x"), "+x");
}

}  // namespace
}  // namespace carom
