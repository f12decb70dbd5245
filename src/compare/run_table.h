#pragma once
// The table of runs of a page: a row for each run, with links into its folder.

#include "compare/compared_run.h"
#include "std.h"
#include "workbook/number_look.h"
#include "workbook/workbook.h"

namespace carom {

class RunTable {
 public:
  /// The runs after so many are left out.
  static constexpr size_t most = 5000;

  /// `place`: the folder of the page. `unrelated`: parameters are no columns.
  RunTable(const FilePlace& place, const ComparisonPlan& plan, const vector<Measure>& measures, bool unrelated);
  /// Takes the run's values and measures, and looks into its folder for a film and a picture.
  void add(const RunRecord& run);

  /// The whole `<table>`. Columns with one value are left out.
  string html() const;
  /// "collisions: 1; ended by: rest": the columns that are left out, as text. Empty: none.
  string constants() const;
  size_t rows() const { return rows_.size(); }

  /// `<a href="#n12">r0012</a>` to the run's row, or its id as text if it has none.
  string link(string_view id) const;
  /// "#n12". Empty: it has none.
  string anchor(string_view id) const;

 private:
  struct Column {
    string head, title;
    bool is_number = true, is_varied = false, is_constant = true;
    NumberLook look{};
  };
  /// Relative to the page. Empty: there is none.
  struct Media {
    string folder, film, picture;
  };
  struct Row {
    string id, status, error;
    vector<Cell> cells;
    Media media;
  };
  string path_from_page(const string& folder) const;
  Media media_of(const RunRecord& run) const;
  string cell_html(const Column& column, const Cell& cell) const;
  static string media_html(const Media& media);
  string row_html(size_t number) const;
  vector<size_t> shown() const;

  string page_path_;  // of its folder
  bool has_parameters_;
  size_t status_;
  vector<Column> columns_;  // parameters, then measures
  vector<Row> rows_;
  map<string, size_t, std::less<>> numbers_;  // by id
  bool has_media_ = false, has_other_status_ = false;
};

}  // namespace carom
