#pragma once
// How the numbers of a column are shown: about five digits, the same decimals in all rows. Cells keep every digit.

#include "std.h"

namespace carom {

class NumberLook {
 public:
  /// Numbers that are not finite do not count.
  void add(double number);

  /// The number format of a spreadsheet: "0.000", "#,##0", "0.0000E+00". "General": there are no numbers.
  string format() const;
  /// A number in that format, without groups of digits. Empty: it is not finite.
  string text(double number) const;
  /// The characters that the longest number takes.
  size_t width() const;

 private:
  struct Form {
    bool power = false;  // of ten
    int decimals = 0;
    int digits = 1;  // before the point
  };
  Form form() const;

  static constexpr int least_decade = -330, decades = 640;
  array<bool, decades> has_{};  // by power of ten: whether there is such a number
  int decimals_ = 0;            // that any number has
  bool any_ = false, negative_ = false;
};

}  // namespace carom
