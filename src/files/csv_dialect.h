#pragma once
// The characters of a CSV file. By default they are those of RFC 4180 and of most programs. Where a comma is the
// decimal mark, spreadsheets expect another separator.

#include "scene/output.h"
#include "std.h"

namespace carom {

struct CsvDialect {
  char separator = ',', decimal = '.';

  CsvDialect() = default;
  explicit CsvDialect(const TablesOutput& tables)
      : separator(tables.separator_mark()), decimal(tables.decimal_mark()) {}
  friend bool operator==(const CsvDialect&, const CsvDialect&) = default;
};

}  // namespace carom
