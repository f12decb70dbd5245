// Text to a tree of values with their places, and what is refused on the way.
#include "yaml/document.h"

#include "std.h"
#include "yaml/parsed.h"

namespace carom {
namespace {

TEST(Document, KeepsTheOrderOfKeysAndTheTextsOfScalars) {
  const Parsed file("b: 1e0\na: [x, 0.50]\n");
  ASSERT_TRUE(file.root && file.diagnostics.empty()) << file.errors();

  ASSERT_EQ(file.root->keys.size(), 2u);
  EXPECT_EQ(file.root->keys[0].text, "b");
  EXPECT_EQ(file.root->keys[1].text, "a");
  EXPECT_EQ(file.root->items[0].text, "1e0");
  EXPECT_EQ(file.root->items[1].items[1].text, "0.50");
}

TEST(Document, TellsTheKindsOfValuesApart) {
  const Parsed file("n:\ns: word\nl: [1]\nm: {a: 1}\n");
  ASSERT_TRUE(file.root);
  EXPECT_TRUE(file.root->find("n")->is_null());
  EXPECT_TRUE(file.root->find("s")->is_scalar());
  EXPECT_TRUE(file.root->find("l")->is_sequence());
  EXPECT_TRUE(file.root->find("m")->is_map());
}

TEST(Document, KeepsQuotedTextApartFromPlainText) {
  const Parsed file("a: 1\nb: '1'\nc: \"1\"\nd: |\n  1\n");
  ASSERT_TRUE(file.root);
  EXPECT_FALSE(file.root->find("a")->quoted);
  for (const char* key : {"b", "c", "d"}) EXPECT_TRUE(file.root->find(key)->quoted) << key;
}

TEST(Document, FindsAKeyOnlyInAMap) {
  const Parsed file("a: 1\nb: [a]\n");
  ASSERT_TRUE(file.root);
  EXPECT_EQ(file.root->find("a")->text, "1");
  EXPECT_EQ(file.root->find("c"), nullptr);
  EXPECT_EQ(file.root->find("b")->find("a"), nullptr);
}

TEST(Places, OfAScalarAreItsBytesWithItsQuotes) {
  const Parsed file("a: word\nb: 'in quotes'\nc: \"double\"\n");
  ASSERT_TRUE(file.root);
  EXPECT_EQ(file.marked(*file.root->find("a")), "word");
  EXPECT_EQ(file.marked(*file.root->find("b")), "'in quotes'");
  EXPECT_EQ(file.marked(*file.root->find("c")), "\"double\"");
}

TEST(Places, OfAnEscapedTextAreItsFirstCharacter) {
  const Parsed file("a: \"x\\x41\"\n");
  ASSERT_TRUE(file.root);
  EXPECT_EQ(file.root->find("a")->text, "xA");
  EXPECT_EQ(file.marked(*file.root->find("a")), "\"");
}

TEST(Places, OfABlockBelowItsKeyAndOfNullAreThoseOfTheKey) {
  const Parsed file("block:\n  - 1\nnothing:\nflow: {a: 1}\n");
  ASSERT_TRUE(file.root);
  EXPECT_EQ(file.marked(*file.root->find("block")), "block");
  EXPECT_EQ(file.marked(*file.root->find("nothing")), "nothing");
  EXPECT_EQ(file.marked(*file.root->find("flow")), "{");
}

TEST(Places, CountBytesAlsoAfterWideCharacters) {
  const Parsed file("t: größe\nb: word\n");
  ASSERT_TRUE(file.root);
  EXPECT_EQ(file.marked(*file.root->find("t")), "größe");
  EXPECT_EQ(file.marked(*file.root->find("b")), "word");
}

TEST(Refusal, OfAnAnchorIsAtTheAnchor) {
  EXPECT_EQ(Parsed("a: &name 1\n").error(), "1:4 an anchor = remove it: scenes have no anchors and aliases");
}

TEST(Refusal, OfAnAliasLeavesABadValue) {
  const Parsed file("a: &x 1\nb: *x\n");
  ASSERT_TRUE(file.root);
  EXPECT_EQ(file.diagnostics.count(), 2u);
  EXPECT_TRUE(file.root->find("b")->bad);
  EXPECT_FALSE(file.root->find("a")->bad);
}

TEST(Refusal, OfAnUnknownAliasIsThatOfAnAlias) {
  EXPECT_EQ(Parsed("a: *x\n").error(), "1:4 an alias = expected the value itself: scenes have no anchors and aliases");
}

TEST(Refusal, OfTagsNamesTheKeyAsTheReason) {
  EXPECT_EQ(Parsed("a: !!int 1\n").error(), "1:4 a tag = remove it: the key determines the type of its value");
}

TEST(Refusal, OfMergeKeysLeavesThemOut) {
  const Parsed file("a: 1\n<<: {b: 2}\n");
  ASSERT_TRUE(file.root);
  EXPECT_EQ(file.error(),
            "2:1 `<<` merges maps in some YAML dialects, not in a scene = write the keys out, or use `defaults`");
  EXPECT_EQ(file.root->keys.size(), 1u);
}

TEST(Refusal, DoesNotMeanMergeKeysInQuotes) {
  const Parsed file("'<<': 1\n");
  EXPECT_TRUE(file.diagnostics.empty()) << file.errors();
}

TEST(Refusal, OfARepeatedKeyKeepsTheFirstAndNamesItsLine) {
  const Parsed file("a: 1\nb: 2\na: 3\n");
  ASSERT_TRUE(file.root);
  EXPECT_EQ(file.error(), "3:1 `a` is repeated = it is in line 1 already");
  EXPECT_EQ(file.root->find("a")->text, "1");
  EXPECT_EQ(file.root->items.size(), 2u);
}

TEST(Refusal, FindsARepeatedKeyAmongMany) {
  string text;
  for (int i = 0; i < 100; ++i) text += "k" + to_string(i) + ": 1\n";
  EXPECT_EQ(Parsed(text + "k7: 2\n").error(), "101:1 `k7` is repeated = it is in line 8 already");
  EXPECT_EQ(Parsed(text + "k99: 2\n").error(), "101:1 `k99` is repeated = it is in line 100 already");
}

TEST(Refusal, OfEmptyAndComplexKeysAndOfValuesWithoutAKey) {
  EXPECT_EQ(Parsed("'': 1\n").error(), "1:1 an empty key = expected a name");
  EXPECT_EQ(Parsed("{[a]: 1}\n").error(), "1:2 a list or map as a key = expected a name");
  EXPECT_EQ(Parsed(": 1\n").error(), "1:1 a value without a key = expected `key: value`");
}

TEST(Refusal, OfDeepNestingComesBeforeMemoryIsSpent) {
  const string deep = "a: " + string(40, '[') + string(40, ']') + "\n";
  const Parsed file(deep);
  EXPECT_FALSE(file.root);
  EXPECT_EQ(file.error(), "1:35 values are nested more than 32 deep = expected a scene");
}

TEST(Refusal, OfALongTextGivesItsLength) {
  EXPECT_EQ(Parsed("a: " + string(10'001, 'x') + "\n").error(), "1:4 a text of 10001 bytes = expected at most 10000");
}

TEST(Refusal, OfControlCharactersCoversEscapedOnes) {
  EXPECT_EQ(Parsed("a: \"\\x07\"\n").error(), "1:4 this text holds a control character = expected plain text");
  EXPECT_TRUE(Parsed("a: \"one\\ntwo\"\n").diagnostics.empty());
}

TEST(Refusal, OfASecondDocumentIsAtItsBeginning) {
  EXPECT_EQ(Parsed("a: 1\n---\nb: 2\n").error(), "2:1 a second document begins here = expected one scene a file");
}

TEST(Refusal, StopsAfterTwoHundredErrors) {
  string text;
  for (int i = 0; i < 300; ++i) text += "k" + to_string(i) + ": &a 1\n";
  const Parsed file(text);
  EXPECT_FALSE(file.root);
  EXPECT_EQ(file.diagnostics.count(), 201u);
}

TEST(Document, OfAnEmptyTextIsNull) {
  const Parsed file("# only a comment\n");
  ASSERT_TRUE(file.root);
  EXPECT_TRUE(file.root->is_null());
}

TEST(Document, OfAnOptionBeginsAtItsOffset) {
  const vector<Source> sources = {{"a.yaml", ""}, {"--set x=[1, 2]", "x=[1, 2]", true}};
  Diagnostics diagnostics(sources);
  const optional<Node> value = parse_document(sources, 1, 2, diagnostics);
  ASSERT_TRUE(value && diagnostics.empty());
  EXPECT_EQ(value->items.size(), 2u);
  EXPECT_EQ(value->place.source, 1u);
  EXPECT_EQ(value->place.offset, 2u);
}

}  // namespace
}  // namespace carom
