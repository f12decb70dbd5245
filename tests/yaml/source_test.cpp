// The bytes of a file, read and checked before any parsing.
#include "yaml/source.h"

#include "paths.h"
#include "std.h"
#include "yaml/parsed.h"

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace carom {
namespace {

/// A file with these bytes, read.
struct Read {
  explicit Read(const string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    good = read_source(path, source[0], diagnostics);
    std::filesystem::remove(path);
  }
  Read(const Read&) = delete;

  string path = testing::TempDir() + "carom_source_" + to_string(getpid()) + ".yaml";
  vector<Source> source = vector<Source>(1);
  Diagnostics diagnostics{source};
  bool good = false;
};

/// Why a path cannot be read.
string fault_of_path(const string& path) {
  vector<Source> source(1);
  Diagnostics diagnostics(source);
  EXPECT_FALSE(read_source(path, source[0], diagnostics));
  return diagnostics.records()[0].message;
}

TEST(ReadSource, RemovesTheByteOrderMarkAndCarriageReturns) {
  EXPECT_EQ(Read("\xEF\xBB\xBF"
                 "a: 1\r\nb: 2\r\n")
                .source[0]
                .text,
            "a: 1\nb: 2\n");
  EXPECT_EQ(Read("a\rb").source[0].text, "a\rb");
}

TEST(ReadSource, RefusesOtherEncodings) {
  EXPECT_FALSE(Read("\xFF\xFE"
                    "a")
                   .good);
  EXPECT_FALSE(Read(string("a\0:\0", 4)).good);
  EXPECT_TRUE(Read("").good);
}

TEST(ReadSource, SaysWhatAPathIsThatIsNoFile) {
  const string folder = testing::TempDir();
  EXPECT_EQ(fault_of_path(folder), "this is a folder, not a scene file");
  EXPECT_EQ(fault_of_path(folder + "/carom_nowhere.yaml"), "no such file");
  EXPECT_EQ(fault_of_path(string("a\0b", 3)), "no such file");
}

TEST(ReadSource, DoesNotWaitForAPipe) {
  const string pipe = testing::TempDir() + "carom_pipe_" + to_string(getpid());
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(fault_of_path(pipe), "this is not a regular file");
  EXPECT_EQ(why_no_file(pipe), "this is not a regular file:");
  unlink(pipe.c_str());
}

TEST(WhyNoFile, IsEmptyForAFile) {
  EXPECT_EQ(why_no_file(SCENES_DIR "/two_bowling_balls.yaml"), "");
  EXPECT_EQ(why_no_file(SCENES_DIR "/nothing.yaml"), "there is no file");
}

TEST(CheckText, FindsTheByteThatIsNotUtf8) {
  EXPECT_EQ(Parsed("a: 1\nb: \xff\n").error(), "2:4 byte 0xFF is not valid UTF-8 = save the file as UTF-8");
}

TEST(CheckText, RefusesControlCharacters) {
  EXPECT_EQ(Parsed("a: x\x07\n").error(), "1:5 control character U+0007 = remove it");
  EXPECT_EQ(Parsed("a: \u2028\n").error(), "1:4 control character U+2028 = remove it");
}

TEST(CheckText, GoesOnAfterTabsBetweenWordsButNotInIndentation) {
  const Parsed between("a:\t1\n"), indentation("a:\n\tb: 1\n");
  EXPECT_EQ(between.diagnostics.count(), 1u);
  EXPECT_TRUE(between.root);
  EXPECT_EQ(indentation.diagnostics.count(), 1u);
  EXPECT_FALSE(indentation.root);
}

TEST(CheckText, CountsTheTabsThatItDoesNotShow) {
  string text;
  for (int i = 0; i < 13; ++i) text += "k" + to_string(i) + ":\t1\n";
  const Parsed file(text);
  EXPECT_EQ(file.diagnostics.count(), 11u);
  EXPECT_TRUE(file.errors().starts_with("a.yaml: error: tabs in 3 more lines\n")) << file.errors();
}

TEST(CheckText, RefusesMoreOpenBracketsThanAnySceneHas) {
  EXPECT_EQ(Parsed(string(1001, '[')).error(), "1:1001 1001 brackets are open here = expected a scene");
}

}  // namespace
}  // namespace carom
