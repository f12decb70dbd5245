// Functions are written in blocks: at most 14 lines in a row are neither blank nor a comment.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "architecture/cpp_declarations.h"
#include "architecture/source_tree.h"

namespace carom::testing {
namespace {

constexpr std::size_t lines_too_many = 15;

/// Whether a line ends a block: it is blank, or a comment alone.
bool ends_block(const std::string& line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first == std::string::npos || line.compare(first, 2, "//") == 0;
}

/// The blocks that are too long, with their first lines. A function's first line and its closing brace count.
std::vector<std::string> long_blocks(const std::vector<SourceFile>& files) {
  std::vector<std::string> found;
  for (const SourceFile& file : files) {
    const std::vector<std::string> lines = file.lines();
    for (const FunctionDefinition& function : declarations_of(file.text).functions) {
      const std::size_t end = std::min(function.line - 1 + function.lines, lines.size());
      std::size_t start = function.line - 1;
      for (std::size_t k = start; k <= end; ++k) {
        if (k < end && !ends_block(lines[k])) {
          continue;
        }

        if (k - start >= lines_too_many) {
          const std::string scope = function.class_name.empty() ? "" : function.class_name + "::";
          found.push_back(file.path + ":" + std::to_string(start + 1) + ": " + scope + function.name + " has " +
                          std::to_string(k - start) + " lines in a row");
        }
        start = k + 1;
      }
    }
  }
  return found;
}

/// The files of the simulators and of the contact solver, except those that do not keep the rule yet.
std::vector<SourceFile> files_in_blocks() {
  const std::set<std::string> not_yet = {"time_stepping.cpp", "simultaneous_impacts.cpp",
                                         "contact_projected_gradients.cpp"};
  std::vector<SourceFile> files;
  for (const SourceFile& file : program_files()) {
    const bool counts = file.path.starts_with("src/simulate/") || file.path.starts_with("src/solver/");
    if (counts && !not_yet.contains(file.path.substr(file.path.rfind('/') + 1))) {
      files.push_back(file);
    }
  }
  return files;
}

using Found = std::vector<std::string>;

std::string statements(std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    text += "  f();\n";
  }
  return text;
}

TEST(LongBlocks, AreFoundFrom15LinesOn) {
  EXPECT_EQ(long_blocks({{"a.cpp", "void g() {\n" + statements(12) + "}\n"}}), Found{});
  EXPECT_EQ(long_blocks({{"a.cpp", "int x;\nvoid g() {\n" + statements(13) + "}\n"}}),
            Found{"a.cpp:2: g has 15 lines in a row"});
  EXPECT_EQ(long_blocks({{"a.h", "class C {\n  void g(int a,\n         int b) {\n" + statements(12) + "  }\n};\n"}}),
            Found{"a.h:2: C::g has 15 lines in a row"});
}

TEST(LongBlocks, EndAtABlankLine) {
  EXPECT_EQ(long_blocks({{"a.cpp", "void g() {\n" + statements(13) + "\n" + statements(13) + "}\n"}}), Found{});
  EXPECT_EQ(long_blocks({{"a.cpp", "void g() {\n" + statements(13) + "  \n" + statements(13) + "}\n"}}), Found{});
  EXPECT_EQ(long_blocks({{"a.cpp", "void g() {\n" + statements(14) + "\n" + statements(14) + "}\n"}}),
            (Found{"a.cpp:1: g has 15 lines in a row", "a.cpp:17: g has 15 lines in a row"}));
}

TEST(LongBlocks, EndAtALineWithACommentAlone) {
  EXPECT_EQ(long_blocks({{"a.cpp", "void g() {\n" + statements(13) + "  // Why.\n" + statements(13) + "}\n"}}),
            Found{});
  EXPECT_EQ(long_blocks({{"a.cpp", "void g() {\n" + statements(13) + "  f();  // Why.\n" + "}\n"}}),
            Found{"a.cpp:1: g has 16 lines in a row"});
}

TEST(LongBlocks, CountTheLinesOfLambdas) {
  EXPECT_EQ(long_blocks({{"a.cpp", "void g() {\n  const auto h = [] {\n" + statements(11) + "  };\n}\n"}}),
            Found{"a.cpp:1: g has 15 lines in a row"});
  EXPECT_EQ(long_blocks({{"a.cpp", "void g() {\n  const auto h = [] {\n" + statements(10) + "  };\n}\n"}}), Found{});
}

TEST(LongBlocks, AreThoseOfFunctionsAlone) {
  const std::string members = "  int a;\n  int b;\n  int c;\n  int d;\n  int e;\n  int f;\n  int g;\n  int h;\n";
  EXPECT_EQ(long_blocks({{"a.h", "struct C {\n" + members + members + "  void f() {}\n};\n"}}), Found{});
  EXPECT_EQ(long_blocks({{"a.cpp", "void g() {\n" + statements(6) + "}\nvoid h() {\n" + statements(6) + "}\n"}}),
            Found{});
}

TEST(Paragraphs, NoFunctionOfSimulateOrSolverButThreeFilesHas15LinesInARow) {
  EXPECT_EQ(long_blocks(files_in_blocks()), Found{});
}

}  // namespace
}  // namespace carom::testing
