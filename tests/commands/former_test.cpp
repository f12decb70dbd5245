// Scenes of format 1 as version 0.1.0 had them on 22 November 2026, with rows of the tables that it wrote.
// data/format_1/ has a table where the motion was right then.
#include <gtest/gtest.h>

#include <charconv>
#include <filesystem>
#include <sstream>

#include "commands/program.h"
#include "paths.h"
#include "std.h"

namespace carom::testing {
namespace {

namespace fs = std::filesystem;

const fs::path data = DATA_DIR "/format_1";

vector<string> parts_of(const string& text, char separator) {
  vector<string> parts;
  std::istringstream in(text);
  for (string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

vector<string> scenes() {
  vector<string> names;
  for (const auto& entry : fs::directory_iterator(data))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem());
  ranges::sort(names);
  return names;
}

/// None: it is a text.
optional<double> number_in(const string& cell) {
  double number = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  return error == std::errc() && end == cell.data() + cell.size() ? optional(number) : nullopt;
}

/// Whether a row begins with these cells. Numbers may differ by rounding.
bool begins_with(const vector<string>& row, const vector<string>& cells) {
  if (row.size() < cells.size()) return false;
  return std::equal(cells.begin(), cells.end(), row.begin(), [](const string& former, const string& now) {
    const auto a = number_in(former), b = number_in(now);
    return a && b ? std::abs(*a - *b) <= 1e-12 * max(1.0, std::abs(*a)) : former == now;  // measured: 2e-13
  });
}

class FormerScene : public ::testing::TestWithParam<string> {};

TEST_P(FormerScene, RunsAndItsTablesBeginAsTheyDid) {
  const string scene = GetParam();
  const Workplace here;
  fs::copy(data / (scene + ".yaml"), here.path("."));
  fs::create_directory(here.path("meshes"));
  fs::copy(SCENES_DIR "/meshes/pin.obj", here.path("meshes"));
  const Finished run = here.carom({"run", scene + ".yaml", "--only", "trajectory,collisions,energy,contacts", "-q"});
  ASSERT_EQ(run.code, 0) << run.err;

  int tables = 0;
  for (const string table : {"summary", "trajectory", "collisions", "energy", "contacts"}) {
    const string former = scene + "." + table + ".csv";
    if (!fs::exists(data / former)) continue;
    ++tables;
    fs::copy(data / former, here.path("."));

    const vector<string> then = parts_of(here.read(former), '\n');
    const vector<string> now = parts_of(here.read("output/" + scene + "/" + table + ".csv"), '\n');
    ASSERT_FALSE(now.empty()) << table;
    EXPECT_TRUE((now[0] + ",").starts_with(then[0] + ",")) << table << ": " << now[0];

    // All former rows, in their order.
    auto next = now.begin();
    for (const string& row : then) {
      const vector<string> cells = parts_of(row, ',');
      next = std::find_if(next, now.end(), [&](const string& line) { return begins_with(parts_of(line, ','), cells); });
      ASSERT_NE(next, now.end()) << table << " has no " << row;
      ++next;
    }
  }
  EXPECT_GE(tables, 2);
}

INSTANTIATE_TEST_SUITE_P(Ten, FormerScene, ::testing::ValuesIn(scenes()), [](const auto& one) { return one.param; });

TEST(FormerScenes, AreTen) {
  EXPECT_EQ(scenes().size(), 10u);
}

}  // namespace
}  // namespace carom::testing
