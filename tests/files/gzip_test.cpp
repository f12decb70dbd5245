// Compressed files: their bytes, and what is read of damaged ones.
#include "files/gzip.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include "files/folders.h"
#include "files/hash.h"
#include "files/output_file.h"
#include "files/stored_file.h"
#include "files/stored_table.h"
#include "processor.h"
#include "std.h"

namespace carom {
namespace {

/// A table of this many bytes or a few more.
string table_of(size_t size) {
  string text = "time_s,x_m\n";
  for (uint64_t i = 0; text.size() < size; ++i) text += to_string(i) + "," + to_string(i * i * 2654435761U) + "\n";
  return text;
}

string packed(const string& text, size_t piece) {
  GzipMembers members;
  string out;
  const auto take = [&](string_view bytes) { out += bytes; };
  for (size_t at = 0; at < text.size(); at += piece) members.add(string_view(text).substr(at, piece), take);
  members.end(take);
  return out;
}

Descriptor memory(const string& bytes) {
  Descriptor file(memfd_create("file", 0));
  EXPECT_EQ(::write(file.get(), bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  lseek(file.get(), 0, SEEK_SET);
  return file;
}

string unpacked(const string& bytes) {
  const Descriptor from = memory(bytes), to = memory("");
  unpack_gzip(from.get(), to.get(), {-1, "run"}, "trajectory.csv.gz");
  string text(file_size(to.get()), '\0');
  EXPECT_EQ(pread(to.get(), text.data(), text.size(), 0), static_cast<ssize_t>(text.size()));
  return text;
}

TEST(Gzip, GivesBackTextsOfAnyLength) {
  for (const size_t size : {20UL, 262'143UL, 262'144UL, 262'145UL, 3'000'000UL}) {
    string text = table_of(size);
    text.resize(size, ' ');
    EXPECT_TRUE(unpacked(packed(text, 65'536)) == text) << size;
  }
}

TEST(Gzip, BytesDoNotDependOnThePiecesThatAreWritten) {
  const string text = table_of(1'500'000), whole = packed(text, text.size());
  for (const size_t piece : {1'000UL, 262'144UL, 300'001UL}) EXPECT_TRUE(packed(text, piece) == whole) << piece;
}

TEST(Gzip, HasTheSameBytesOnEveryProcessorWithSse42) {
  if (!packs_by_sse42()) GTEST_SKIP() << "another processor";
  EXPECT_EQ(sha256(packed(table_of(1'000'000), 65'536)),
            "3a7d999d6c5b126510c6a41af0550b1326a614027a9624a97c0ccc81e5977697");
}

TEST(Gzip, WhatDoesNotFillAMemberWaits) {
  const string text = table_of(1'000'000);
  const size_t half = 400'000;
  GzipMembers first, second;
  string out;
  const auto take = [&](string_view bytes) { out += bytes; };
  first.add(string_view(text).substr(0, half), take);
  EXPECT_EQ(first.rest().size(), half - 262'144);
  second.set_rest(first.rest());
  second.add(string_view(text).substr(half), take);
  second.end(take);
  EXPECT_TRUE(out == packed(text, text.size()));
}

string error_of(const string& bytes) {
  try {
    unpacked(bytes);
  } catch (const ExportError& error) {
    return error.what();
  }
  return "";
}

TEST(Gzip, AFileThatIsCutOffOrDamagedIsAnError) {
  const string bytes = packed(table_of(700'000), 65'536),
               text = "cannot read run/trajectory.csv.gz: it is damaged, or cut off";
  for (const size_t size : {size_t{0}, size_t{1}, size_t{9}, size_t{500}, bytes.size() / 2, bytes.size() - 1})
    EXPECT_EQ(error_of(bytes.substr(0, size)), text) << size;
  EXPECT_EQ(error_of("time_s,x_m\n0,1\n"), text);
  EXPECT_EQ(error_of(bytes + "tail"), text);

  // Any byte but those of the head that say nothing of the content.
  for (size_t at = 10; at < bytes.size(); at += bytes.size() / 97) {
    string wrong = bytes;
    wrong[at] = static_cast<char>(wrong[at] ^ 0x10);
    EXPECT_EQ(error_of(wrong), text) << at;
  }
}

TEST(Gzip, IsReadWhereTheTableIsNotThere) {
  string folder = ::testing::TempDir() + "carom_gzip_XXXXXX";
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const Descriptor opened = open_folder(AT_FDCWD, folder, true);
  const FilePlace place{opened.get(), folder};
  EXPECT_FALSE(open_stored_table(opened.get(), "energy.csv"));
  EXPECT_EQ(stored_table(opened.get(), "energy.csv"), nullopt);

  OutputFile file(place, "energy.csv.gz", CsvDialect());
  file.write("time_s,total_J\n0,5\n");
  file.publish();
  EXPECT_EQ(file.record().bytes, stored_size(opened.get(), "energy.csv.gz"));
  EXPECT_EQ(stored_table(opened.get(), "energy.csv"), "energy.csv.gz");
  StoredTable table(open_stored_table(opened.get(), "energy.csv"));
  EXPECT_EQ(table.columns(), (vector<string>{"time_s", "total_J"}));
  ASSERT_NE(table.next(), nullptr);
  EXPECT_EQ(table.cell(1), "5");

  // A plain one comes first.
  OutputFile plain(place, "energy.csv");
  plain.write("time_s\n");
  plain.publish();
  EXPECT_EQ(StoredTable(open_stored_table(opened.get(), "energy.csv")).columns(), vector<string>{"time_s"});
  for (const char* name : {"energy.csv", "energy.csv.gz"}) unlinkat(opened.get(), name, 0);
  rmdir(folder.c_str());
}

}  // namespace
}  // namespace carom
