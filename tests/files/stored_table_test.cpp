// Tables read back: from the start with quotes, from the end without the middle.
#include "files/stored_table.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include "files/csv.h"
#include "std.h"

namespace carom {
namespace {

Descriptor table_file(const string& text) {
  Descriptor file(memfd_create("table", 0));
  EXPECT_EQ(::write(file.get(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
  lseek(file.get(), 0, SEEK_SET);
  return file;
}

vector<vector<string>> all_rows(const string& text) {
  StoredTable table(table_file(text));
  vector<vector<string>> rows = {table.columns()};
  while (const auto* cells = table.next()) rows.emplace_back(cells->begin(), cells->end());
  return rows;
}

vector<string> from_end(const string& text, size_t most) {
  const Descriptor file = table_file(text);
  vector<string> lines;
  lines_from_end(file.get(), [&](string_view line) {
    lines.emplace_back(line);
    return lines.size() < most;
  });
  return lines;
}

using Rows = vector<vector<string>>;

TEST(StoredTable, GivesBackWhatACellHeld) {
  for (const string text : {"plain", "a, b", "say \"so\"", "two\nlines", "\"", ""})
    EXPECT_EQ(all_rows("x,y,z\n1," + text_cell(text) + ",3\n"), (Rows{{"x", "y", "z"}, {"1", text, "3"}})) << text;
}

TEST(StoredTable, TakesMissingEndsAndEmptyFiles) {
  EXPECT_EQ(all_rows(""), (Rows{{}}));
  EXPECT_EQ(all_rows("a,b"), (Rows{{"a", "b"}}));
  EXPECT_EQ(all_rows("a,b\n1,2"), (Rows{{"a", "b"}, {"1", "2"}}));
  EXPECT_EQ(all_rows("a\n\"1"), (Rows{{"a"}, {"1"}}));
  EXPECT_EQ(all_rows("a,b\n,\n"), (Rows{{"a", "b"}, {"", ""}}));
}

TEST(StoredTable, ReadsRowsThatArePiecesApart) {
  string text = "n,text\n";
  for (int i = 0; i < 30'000; ++i) text += to_string(i) + ",row\n";
  text += "last," + string(200'000, 'x') + "\n";
  const Rows rows = all_rows(text);
  ASSERT_EQ(rows.size(), 30'002u);
  for (int i = 0; i < 30'000; ++i) ASSERT_EQ(rows[static_cast<size_t>(i + 1)][0], to_string(i));
  EXPECT_EQ(rows.back()[1].size(), 200'000u);
}

TEST(LinesFromEnd, AreTheLastOnesWithoutTheFirst) {
  EXPECT_EQ(from_end("head\n1\n2\n3\n", 9), (vector<string>{"3", "2", "1"}));
  EXPECT_EQ(from_end("head\n1\n2\n3", 2), (vector<string>{"3", "2"}));
  EXPECT_TRUE(from_end("head\n", 9).empty());
  EXPECT_TRUE(from_end("", 9).empty());
  string text = "head\n";
  for (int i = 0; i < 30'000; ++i) text += "line " + to_string(i) + "\n";
  const auto lines = from_end(text, 40'000);
  ASSERT_EQ(lines.size(), 30'000u);
  for (int i = 0; i < 30'000; ++i) ASSERT_EQ(lines[static_cast<size_t>(29'999 - i)], "line " + to_string(i));
}

/// A dialect of its own, as a German spreadsheet has it.
CsvDialect semicolons() {
  CsvDialect dialect;
  dialect.separator = ';';
  dialect.decimal = ',';
  return dialect;
}

TEST(StoredTable, TakesTheSeparatorFromTheHeadAndGivesPointsForDecimalCommas) {
  EXPECT_EQ(all_rows("time_s;body;x_m\n0,5;red;-1,25e-07\n1;;\n"),
            (Rows{{"time_s", "body", "x_m"}, {"0.5", "red", "-1.25e-07"}, {"1", "", ""}}));
  EXPECT_EQ(all_rows("time_s\tx_m\n0.5\t3,675\n"), (Rows{{"time_s", "x_m"}, {"0.5", "3.675"}}));
  EXPECT_EQ(all_rows("time_s,a;b\n3,675\n"), (Rows{{"time_s", "a;b"}, {"3", "675"}}));
  EXPECT_EQ(all_rows("\"a,b\";c\n1,5;2\n"), (Rows{{"a,b", "c"}, {"1.5", "2"}}));
  EXPECT_EQ(all_rows("run\nr1\n"), (Rows{{"run"}, {"r1"}}));
}

TEST(StoredTable, GivesBackWhatACellOfADialectHeld) {
  for (const string text : {"plain", "1,5", "a; b", "say \"so\"", "two\nlines", "gas.3", "\t", ""})
    EXPECT_EQ(all_rows("x;y;z\n1,5;" + text_cell(text, semicolons()) + ";3\n"),
              (Rows{{"x", "y", "z"}, {"1.5", text == "\t" ? "'\t" : text, "3"}}))
        << text;
}

TEST(StoredTable, NumbersOfADialectAreTheSameDoubles) {
  char text[number_size];
  for (const double value : {0.1, -2.5, 1e-7, 0.1 + 0.2, 5e-324, -1.7976931348623157e308, 3.0, 3.675}) {
    const string cell(text, put_number(text, value, semicolons()));
    EXPECT_EQ(cell.find('.'), string::npos);
    EXPECT_EQ(number_in(all_rows("x;y\n" + cell + ";\n")[1][0]), value) << cell;
  }
}

}  // namespace
}  // namespace carom
