// manifest.json with any content: it is read, or counts as missing.
#include "files/manifest.h"

#include <fcntl.h>

#include "export/export_testing.h"
#include "files/folder_writer.h"
#include "std.h"

namespace carom {
namespace {

using namespace testing_export;

optional<Manifest> read_back(const string& text) {
  const TempFolder folder;
  write(folder / manifest_name, text);
  return read_manifest(open_folder(AT_FDCWD, folder.path(), true).get(), manifest_name);
}

string with(const string& members) {
  return R"({"tool": "carom", "version": "0.1.0", "outputs": {}, "files": [], )" + members + "}";
}

TEST(Manifest, HasTheNumberOfCollisions) {
  EXPECT_EQ(read_back(with(R"("counts": {"collisions": 7})"))->collisions, 7u);
}

TEST(Manifest, HasNoCollisionsWhereTheirNumberIsNoWholeNumber) {
  for (const char* odd : {R"({"collisions": "7"})", R"({"collisions": -7})", R"({"collisions": 1e300})",
                          R"({"collisions": null})", R"({"collisions": [7]})", "7", "[]"})
    EXPECT_EQ(read_back(with(R"("counts": )" + string(odd)))->collisions, 0u) << odd;
}

TEST(Manifest, OfBracketsWithinBracketsWithoutEndIsNone) {
  const string open(200'000, '['), close(200'000, ']');
  EXPECT_FALSE(read_back(R"({"tool": "carom", "version": "0.1.0", "files": [], "outputs": )" + open + close + "}"));
  EXPECT_TRUE(
      read_back(with(R"("version": "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[\"[[[[")")));
}

}  // namespace
}  // namespace carom
