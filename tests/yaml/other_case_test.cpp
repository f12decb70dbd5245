#include "yaml/other_case.h"
#include "std.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace carom {
namespace {

namespace fs = std::filesystem;

TEST(OtherCase, OfEachPartOfANameIsFound) {
  const fs::path folder = ::testing::TempDir() + "carom_case_" + to_string(getpid());
  fs::create_directories(folder / "Textures");
  for (const char* name : {"Textures/wood.png", "Textures/Wood.png", "a.png"}) std::ofstream(folder / name) << "x";
  EXPECT_EQ(name_in_other_case(folder, "textures/WOOD.PNG"), "Textures/Wood.png");
  EXPECT_EQ(name_in_other_case(folder, "Textures/wood.PNG"), "Textures/Wood.png");
  EXPECT_EQ(name_in_other_case(folder, "Textures/../A.png"), "Textures/../a.png");
  EXPECT_EQ(name_in_other_case(folder, folder / "A.png"), (folder / "a.png").string());
  for (const char* name : {"a.png", "b.png", "none/a.png", "a.png/b"}) EXPECT_EQ(name_in_other_case(folder, name), "");
  fs::remove_all(folder);
}

}  // namespace
}  // namespace carom
