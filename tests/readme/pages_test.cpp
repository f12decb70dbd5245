// The pages: their size, the files, folders and tests that they name, and their links.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include "paths.h"
#include "readme/pages.h"
#include "std.h"

namespace carom::testing {
namespace {

namespace fs = std::filesystem;

const fs::path root = SOURCE_DIR;

vector<string> matches(const string& text, const std::regex& what, int group = 0) {
  return {std::sregex_token_iterator(text.begin(), text.end(), what, group), {}};
}

TEST(Pages, TheFirstOneHasAtMost140Lines) {
  const string& text = page_at("README.md").text;
  EXPECT_LE(ranges::count(text, '\n'), 140);
}

TEST(Pages, NameOnlyFilesThatAreThere) {
  const std::regex path("(?:scenes|src|tests)/[A-Za-z0-9_/.]+");
  for (const Page& page : pages()) {
    for (string name : matches(page.text, path)) {
      while (name.ends_with('.')) name.pop_back();
      // A link on a page of src/ or tests/ goes from there.
      EXPECT_TRUE(fs::exists(root / name) || fs::exists(root / page.folder() / name)) << page.path << ": " << name;
    }
  }
}

/// Path of each source file: "src/physics/world.h" for "world.h".
std::multimap<string, string> source_files() {
  std::multimap<string, string> found;
  for (const auto& entry : fs::recursive_directory_iterator(root / "src"))
    found.emplace(entry.path().filename(), fs::relative(entry.path(), root).generic_string());
  return found;
}

TEST(Pages, NameOnlySourcesThatAreThereAndOfAFolderItsOwn) {
  const auto sources = source_files();
  const std::regex source("`([a-z0-9_/]+\\.(?:h|cpp))`");

  for (const Page& page : pages()) {
    const bool of_a_folder = page.folder().starts_with("src/");
    for (const string& name : matches(page.text, source, 1)) {
      if (name.find('/') != string::npos)
        EXPECT_TRUE(fs::exists(root / page.folder() / name) || fs::exists(root / name)) << page.path << ": " << name;
      else if (of_a_folder)
        EXPECT_TRUE(fs::exists(root / page.folder() / name)) << page.path << ": " << name;
      else
        EXPECT_TRUE(sources.contains(name)) << page.path << ": " << name;
    }
  }
}

TEST(Pages, LinksReachPagesFilesAndHeadings) {
  const std::regex link("\\]\\(([^)#]*)(#[^)]*)?\\)");
  size_t links = 0;
  for (const Page& page : pages()) {
    for (std::sregex_iterator i(page.text.begin(), page.text.end(), link), end; i != end; ++i, ++links) {
      const string target = (*i)[1], anchor = (*i)[2];
      if (target.starts_with("http")) continue;

      const string path =
          target.empty() ? page.path : (fs::path(page.folder()) / target).lexically_normal().generic_string();
      EXPECT_TRUE(fs::exists(root / path)) << page.path << ": " << i->str();
      if (anchor.empty()) continue;

      const auto there =
          std::find_if(pages().begin(), pages().end(), [&](const Page& other) { return other.path == path; });
      ASSERT_NE(there, pages().end()) << page.path << ": " << i->str();
      const auto anchors = there->anchors();
      EXPECT_TRUE(ranges::count(anchors, anchor.substr(1))) << page.path << ": " << i->str();
    }
  }

  EXPECT_GT(links, 50u);
}

TEST(Pages, OfTheReadmeAllCanBeReached) {
  const string& text = page_at("README.md").text;
  for (const Page& other : pages()) {
    const bool of_a_folder = other.folder().starts_with("src/");  // src/README.md has these
    const string& from = of_a_folder ? page_at("src/README.md").text : text;
    const string path = of_a_folder ? other.path.substr(4) : other.path;
    EXPECT_TRUE(other.path == "README.md" || from.find("](" + path) != string::npos) << other.path;
  }
}

/// The first paragraph under a page's title, in one line.
string first_paragraph(const Page& page) {
  const size_t start = page.text.find("\n\n") + 2;
  return one_line(page.text.substr(start, page.text.find("\n\n", start) - start));
}

TEST(Pages, OfEachSourceFolderBeginWithItsSentenceInTheTable) {
  const std::regex row("\\| \\[(\\w+)/\\]\\(\\w+/README.md\\) \\| ([^|\n]+) \\|\n");
  map<string, string> sentences;

  const string& text = page_at("src/README.md").text;
  for (std::sregex_iterator i(text.begin(), text.end(), row), end; i != end; ++i) sentences[(*i)[1]] = (*i)[2];

  set<string> folders;
  for (const auto& entry : fs::directory_iterator(root / "src"))
    if (entry.is_directory()) folders.insert(entry.path().filename());
  for (const string& folder : folders) EXPECT_TRUE(sentences.contains(folder)) << folder;

  for (const auto& [folder, sentence] : sentences) {
    ASSERT_TRUE(folders.contains(folder)) << folder;
    string paragraph = first_paragraph(page_at("src/" + folder + "/README.md"));
    while (paragraph.ends_with(' ')) paragraph.pop_back();
    EXPECT_EQ(paragraph, sentence) << folder;
    EXPECT_EQ(sentence.find(". "), string::npos) << folder << " has more than one sentence";
  }
}

/// The suite and the name of every test in the sources, as "Suite.Name".
set<string> all_tests() {
  static const std::regex test(R"(TEST(?:_[PF])?\(\s*(\w+),\s*(\w+)\s*\))");
  set<string> found;
  for (const auto& entry : fs::recursive_directory_iterator(root / "tests")) {
    if (entry.path().extension() != ".cpp") continue;
    const string text = read_file(entry.path());
    for (std::sregex_iterator it(text.begin(), text.end(), test), end; it != end; ++it)
      found.insert((*it)[1].str() + "." + (*it)[2].str());
  }
  return found;
}

TEST(PageOfPromises, NamesTestsThatAreThere) {
  const string& text = page_at("output/README.md").text;
  const set<string> tests = all_tests();
  static const std::regex name(R"(`(?:\w+/)?([A-Z]\w*\.)(\w*)(\*?)`)");
  size_t named = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), name), end; it != end; ++it, ++named) {
    const string start = (*it)[1].str() + (*it)[2].str();
    const auto found = tests.lower_bound(start);
    EXPECT_TRUE(found != tests.end() && ((*it)[3].length() > 0 ? found->starts_with(start) : *found == start))
        << it->str();
  }
  EXPECT_GT(named, 20u);
}

}  // namespace
}  // namespace carom::testing
