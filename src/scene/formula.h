#pragma once
// An expression of a scene file, such as `r * sin(a) + 0.1`, and its value.

#include "std.h"

namespace carom {

/// What is wrong with an expression, and where: bytes from its start.
struct FormulaError {
  size_t offset = 0, length = 1;
  string message, remedy;
};

/// Bytes of an expression at most.
inline constexpr size_t longest_formula = 1000;

/// Numbers, names, `pi`, + - * / ^ %, parentheses, and the functions below. Angles are in degrees.
/// -2^2 is -4, and 2^3^2 is 2^9. a % b is a - b floor(a / b): it has the sign of b.
/// if(a < b, x, y) evaluates x or y and not the other. rand(i) depends on the seed and on i alone, a whole number.
/// A formula has the same value on every machine.
class Formula {
 public:
  /// Throws FormulaError. `names`: the names that may stand in it, distinct from functions and `pi`.
  /// `hint`: the remedy for a name that is none of them and near none of them.
  Formula(string_view text, span<const string> names, string_view hint = {});

  /// The names in it: indices into the names of the constructor, each once, in the order of the text.
  const vector<size_t>& used() const { return used_; }
  /// The place of a name's first use.
  FormulaError at_name(size_t name, string message, string remedy) const;

  /// Whether it draws numbers by the seed.
  bool draws() const;

  /// `values`: by name. `seed`: of rand(i). Throws FormulaError where a division by zero, a root of a negative number
  /// or the like occurs, a number too large for a double, or a rand without a seed.
  double value(span<const double> values, optional<uint64_t> seed = {}) const;

  struct Operation;

  /// Adds a number to the end of a list, or replaces the last numbers by their result, or skips steps.
  struct Step {
    size_t at, length;  // in the text
    double number = 0;  // of neither a name nor an operation
    optional<size_t> name = {};
    const Operation* operation = nullptr;
    size_t arguments = 0;  // of the operation
    size_t skips = 0;      // steps, if it is no operand and no operation
    /// It takes the last number, and skips only if that is 0: a condition that does not hold.
    bool is_condition = false;
  };

 private:
  vector<size_t> used_;
  vector<Step> steps_;
};

/// "sqrt", "abs", ..., "if"
vector<string_view> formula_functions();
/// Whether expressions use this word for a function or a constant.
bool is_formula_word(string_view name);

}  // namespace carom
