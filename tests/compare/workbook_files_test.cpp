// The temporary files of libxlsxwriter are recorded, and the workbook is compared with them.
#include "workbook/workbook_files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <minizip/zip.h>
#include <sys/resource.h>
#include <unistd.h>
#include <xlsxwriter.h>

#include <csignal>

#include "compare/comparison_testing.h"
#include "files/run_folder.h"
#include "std.h"
#include "workbook/workbook.h"

namespace carom {
namespace {

using testing::Place;

string error_of(const function<void()>& action) {
  try {
    action();
  } catch (const ExportError& error) {
    return error.what();
  }
  return "no error";
}

/// An archive with these parts.
Descriptor archive(const Place& place, const vector<string>& parts) {
  const string path = place / "archive.zip";
  const zipFile zip = zipOpen(path.c_str(), APPEND_STATUS_CREATE);
  int number = 0;
  for (const string& part : parts) {
    zipOpenNewFileInZip(zip, to_string(number++).c_str(), nullptr, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED, 6);
    zipWriteInFileInZip(zip, part.data(), static_cast<unsigned>(part.size()));
    zipCloseFileInZip(zip);
  }
  zipClose(zip, nullptr);
  return Descriptor(open(path.c_str(), O_RDWR | O_CLOEXEC));
}

class WorkbookFilesTest : public ::testing::Test {
 protected:
  /// A temporary file of the library's with this text.
  static void put(const string& text) {
    FILE* const file = lxw_tmpfile(nullptr);
    ASSERT_NE(file, nullptr);
    std::fputs(text.c_str(), file);
    std::fclose(file);
  }
  string checked(const Descriptor& found) {
    return error_of([&] { files_.check_archive(found.get()); });
  }

  Place place_;
  Descriptor folder_{open_folder(AT_FDCWD, place_ / "", true)};
  WorkbookFiles files_{{folder_.get(), "out"}, "book.xlsx"};
};

TEST_F(WorkbookFilesTest, APartThatIsNotToTheByteWhatWasWrittenIsFound) {
  const string other = "cannot write out/book.xlsx: the workbook differs from what was written";
  put("rows");
  files_.begin_parts();
  put("<one/>");
  put("<two/>");

  EXPECT_EQ(checked(archive(place_, {"<one/>", "<two/>"})), "no error");
  EXPECT_EQ(checked(archive(place_, {"<two/>", "<one/>"})), "no error");  // their order does not matter
  EXPECT_EQ(checked(archive(place_, {"<one/>", "<two/"})), other);
  EXPECT_EQ(checked(archive(place_, {"<one/>", "<twi/>"})), other);
  EXPECT_EQ(checked(archive(place_, {"<one/>"})), other);
  EXPECT_EQ(checked(archive(place_, {"<one/>", "<two/>", "rows"})), other);

  const Descriptor cut = archive(place_, {"<one/>", "<two/>"});
  ASSERT_EQ(ftruncate(cut.get(), lseek(cut.get(), 0, SEEK_END) - 1), 0);
  EXPECT_EQ(checked(cut), other);
}

TEST_F(WorkbookFilesTest, AFailedWriteIsReportedAtTheEnd) {
  EXPECT_EQ(error_of([&] { files_.check(); }), "no error");
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit few{10, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &few);
  put("more than ten bytes");
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(error_of([&] { files_.check(); }), "cannot write out/book.xlsx: File too large");
}

TEST_F(WorkbookFilesTest, HaveNoNames) {
  put("rows");
  EXPECT_TRUE(std::filesystem::is_empty(place_ / ""));
}

struct Stopped {};

TEST(WorkbookThatIsGivenUp, ThrowsWhatTheCheckThrows) {
  const Place place;
  const Descriptor folder = open_folder(AT_FDCWD, place / "", true);
  const FilePlace at{folder.get(), "out"};
  const auto write = [&] {
    Workbook book(at, "book.xlsx", "Title");
    Worksheet& sheet = book.add("Rows", true);
    sheet.head(0, 0, "x_m");
    for (size_t row = 1; row < 100; ++row) sheet.exact_row(row, {"0.1"}, sheet.exact_columns({NumberLook()}));
    OutputFile file(at, "book.xlsx");
    book.write(file);
  };

  int checks = 0;
  check_while_packing([&] {
    if (++checks > 2) throw Stopped();
  });
  EXPECT_THROW(write(), Stopped);
  check_while_packing([&] { ++checks; });
  EXPECT_NO_THROW(write());
  EXPECT_GT(checks, 6);
  check_while_packing([] {});
}

}  // namespace
}  // namespace carom
