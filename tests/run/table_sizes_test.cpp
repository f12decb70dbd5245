// How many rows and columns are foreseen, beside those that a run writes.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "export/forecast.h"
#include "run/run_scene.h"
#include "run/run_testing.h"
#include "std.h"

namespace carom {
namespace {

const string three =
    "balls:\n  a: {mass: 1, radius: 0.1, position: [0, 1, 0]}\n"
    "  b: {mass: 1, radius: 0.1, position: [1, 1, 0], velocity: [-1, 0, 0]}\n"
    "  c: {mass: 1, radius: 0.1, position: [3, 1, 0]}\n";
const string later =
    "balls:\n  a: {mass: 1, radius: 0.1, position: [0, 1, 0]}\n"
    "  b: {mass: 1, radius: 0.1, position: [1, 1, 0], appear: 0.35}\n";

struct SizeCase {
  string scene, simulate, output;
  bool is_bound = false;  // there are fewer rows
};

const SizeCase cases[] = {
    {three, "duration: 1", "trajectory: {every: 0.1}"},
    {three, "duration: 1", "trajectory: {every: 0.3}, energy: {every: 0.07}"},
    {three, "duration: 1", "trajectory: {every: 3}, energy: {every: 1}"},
    {three, "duration: 0", "trajectory: {every: 0.1}, energy: {every: 0.1}"},
    {three, "duration: 1", "trajectory: {every: 0.1, layout: wide}"},
    {three, "duration: 1", "trajectory: {every: 0.1, on: [b]}"},
    {three, "duration: 1", "trajectory: {every: 0.1, on: [c, a], layout: wide}"},
    {three, "duration: 1, engine: stepped, step: 0.01", "trajectory: {every: 0.03}, energy: {every: 0.03}"},
    {three, "duration: 1, engine: book", "trajectory: {every: 0.03}"},
    {three, "duration: 1", "trajectory: {every: 0.1}, tables: csv.gz"},
    {three, "duration: 2, contact: merge", "trajectory: {every: 0.1}", true},
    {three, "duration: 2, contact: merge", "trajectory: {every: 0.1, layout: wide}"},
    {later, "duration: 1", "trajectory: {every: 0.1}", true},
    {later, "duration: 1", "trajectory: {every: 0.1, layout: wide}"},
    {three + "regions: {low: {plane: {point: [0, 0.5, 0], normal: [0, -1, 0]}, on: [a], action: remove}}\n",
     "duration: 1", "trajectory: {every: 0.1}", true},
    {three, "duration: 9, stop: [{collisions: 1}]", "trajectory: {every: 0.1}, energy: {every: 0.1}", true},
};

string first_line(const string& text) {
  return text.substr(0, text.find('\n'));
}

/// The table in a folder, which may be compressed: by gzip itself.
string table_in(const string& folder, const string& name) {
  const string out = folder + "/" + name + ".text";
  const string command = std::filesystem::exists(folder + "/" + name) ? "cat " : "gzip -dc ";
  EXPECT_EQ(std::system((command + folder + "/" + name + (command == "cat " ? "" : ".gz") + " > " + out).c_str()), 0);
  std::ifstream file(out, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(TableSizes, AreThoseThatARunWrites) {
  for (const SizeCase& of : cases) {
    const RunPlace place;
    const Scene scene =
        place.scene("scene: 1\n" + of.scene + "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n" +
                    "simulate: {" + of.simulate + "}\noutput: {" + of.output + "}\n");
    const vector<TableSize> foreseen = forecast(scene).tables;
    const RunResult result = run_scene({&scene, place / "run"}, choose_engine(scene),
                                       {.durability = Durability::deferred}, {[] {}, [](const auto&) {}});
    ASSERT_EQ(foreseen.size(), result.facts.tables.size()) << of.output;

    for (size_t i = 0; i < foreseen.size(); ++i) {
      const string text = table_in(place / "run", foreseen[i].name + ".csv");
      const auto rows = static_cast<uint64_t>(ranges::count(text, '\n') - 1);
      const auto columns = static_cast<uint64_t>(ranges::count(first_line(text), ',') + 1);
      const TableSize& written = result.facts.tables[i];
      EXPECT_EQ(written.name, foreseen[i].name);
      EXPECT_EQ(written.rows, rows) << of.simulate << of.output;
      EXPECT_EQ(written.columns, columns) << of.output;
      EXPECT_EQ(foreseen[i].columns, columns) << of.output;

      EXPECT_EQ(foreseen[i].is_bound, of.is_bound) << of.simulate << of.output;
      if (of.is_bound)
        EXPECT_GT(foreseen[i].rows, rows) << of.simulate << of.output;
      else
        EXPECT_EQ(foreseen[i].rows, rows) << of.simulate << of.output;
    }
  }
}

}  // namespace
}  // namespace carom
