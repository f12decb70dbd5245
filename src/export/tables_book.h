#pragma once
// tables.xlsx: a run's tables as sheets of a workbook, made from its complete CSV files.

#include "files/output_file.h"
#include "files/summary.h"
#include "std.h"

namespace carom {

struct TablesOutput;

/// "1,500,000 rows", "18,001 columns": what of a table is beyond a sheet of a spreadsheet. Empty: it fits.
string beyond_sheets(const TableSize& size);

/// Writes the workbook, complete, if `tables` requests it. Null: it does not. `open`: a CSV file of the run, or none if
/// the run has no such file. Of a table that is larger than a sheet, the sheet has the first rows and columns, below a
/// sentence that says so. Throws ExportError.
unique_ptr<OutputFile> write_tables_workbook(const FilePlace& place, const TablesOutput& tables, const string& title,
                                             const function<Descriptor(const string& name)>& open);

}  // namespace carom
