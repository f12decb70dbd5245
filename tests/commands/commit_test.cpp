// What --version says of the tree: src/commit.cmake in clones, in archives and outside of git.
#include <gtest/gtest.h>

#include "commands/program.h"
#include "paths.h"
#include "std.h"

namespace carom::testing {
namespace {

/// A clone with one commit, and what the script finds in it.
class Tree {
 public:
  /// False: there is no git, no cmake, or another command has failed.
  bool made() const {
    return run(
        "git init -q tree && cd tree && git config user.name a && git config user.email a@b &&"
        "mkdir src && echo a > src/a.cpp && echo a > src/a.md && echo a > CMakeLists.txt &&"
        "cp '" SOURCE_DIR
        "/src/commit.cmake' src && echo 'src/commit.cmake export-subst' > .gitattributes &&"
        "git add . && git commit -qm first");
  }
  bool run(const string& command) const { return place_.shell(command).code == 0; }
  /// Ten digits, as of a commit in full.
  string head() const { return place_.shell("git -C tree rev-parse HEAD").out.substr(0, 10); }

  /// The text between the quotes of the source that the script writes.
  string found(const string& root = "tree") const {
    EXPECT_TRUE(run("cmake -D ROOT=$PWD/" + root + " -D SOURCE=$PWD/commit.cpp -P " + root + "/src/commit.cmake"));
    const string source = place_.read("commit.cpp");
    const size_t from = source.find("= \"") + 3;
    return source.substr(from, source.rfind('"') - from);
  }

 private:
  Workplace place_;
};

TEST(Commit, IsThatOfTheTreeWithAMarkWhereSourcesHaveChanged) {
  const Tree tree;
  if (!tree.made()) GTEST_SKIP() << "no git, or no cmake";
  const string first = tree.head();
  EXPECT_EQ(tree.found(), first);
  EXPECT_TRUE(tree.run("echo b > tree/src/a.md && echo b > tree/b.cpp"));
  EXPECT_EQ(tree.found(), first) << "a page and what is not below src/ change no program";

  EXPECT_TRUE(tree.run("echo b > tree/src/a.cpp"));
  EXPECT_EQ(tree.found(), first + ", sources changed");
  EXPECT_TRUE(tree.run("cd tree && git commit -qam second"));
  EXPECT_NE(tree.head(), first);
  EXPECT_EQ(tree.found(), tree.head());
  EXPECT_TRUE(tree.run("echo a > tree/src/b.cpp"));
  EXPECT_EQ(tree.found(), tree.head() + ", sources changed") << "a new source is compiled, too";
}

TEST(Commit, IsInAnArchiveAndOtherwiseUnknown) {
  const Tree tree;
  if (!tree.made()) GTEST_SKIP() << "no git, or no cmake";
  const string first = tree.head();
  EXPECT_TRUE(tree.run("git -C tree archive --prefix=archive/ HEAD | tar x"));
  EXPECT_EQ(tree.found("archive"), first);

  // Copied without .git, in a folder of another repository, whose commit is none of it.
  EXPECT_TRUE(tree.run("mkdir tree/copy && cp -r tree/src tree/CMakeLists.txt tree/copy"));
  EXPECT_EQ(tree.found("tree/copy"), "");
}

TEST(Commit, ThatIsTheSameLeavesItsSourceAsItIs) {
  const Tree tree;
  if (!tree.made()) GTEST_SKIP() << "no git, or no cmake";
  tree.found();
  EXPECT_TRUE(tree.run("touch -d 2000-01-01 commit.cpp tree/mark"));
  tree.found();
  EXPECT_TRUE(tree.run("test ! commit.cpp -nt tree/mark"));
}

}  // namespace
}  // namespace carom::testing
