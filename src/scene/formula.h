#pragma once
// An expression of a scene file, such as `r * sin(a) + 0.1`, and its value. Only formula.cpp includes muParser.
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// What is wrong with an expression, and where: bytes from its start.
struct FormulaError {
  std::size_t offset = 0, length = 1;
  std::string message, remedy;
};

/// Bytes of an expression at most.
inline constexpr std::size_t longest_formula = 1000;

/// Numbers, names, `pi`, + - * / ^ %, parentheses, and the functions below. Angles are in degrees.
/// -2^2 is -4, and 2^3^2 is 2^9. a % b is a - b floor(a / b): it has the sign of b.
/// A formula has the same value on every machine.
class Formula {
 public:
  /// Throws FormulaError. `names`: the names that may stand in it, distinct from functions and `pi`.
  /// `hint`: the remedy for a name that is none of them and near none of them.
  Formula(std::string_view text, std::span<const std::string> names, std::string_view hint = {});
  ~Formula();
  Formula(Formula&&) noexcept;

  /// The names in it: indices into the names of the constructor, each once, in the order of the text.
  const std::vector<std::size_t>& used() const;
  /// The place of a name's first use.
  FormulaError at_name(std::size_t name, std::string message, std::string remedy) const;

  /// `values`: by name. Throws FormulaError where a division by zero, a root of a negative number or the like occurs,
  /// or a number too large for a double.
  double value(std::span<const double> values) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// "sqrt", "abs", ...
std::vector<std::string_view> formula_functions();
/// Whether expressions use this word for a function or a constant.
bool is_formula_word(std::string_view name);

}  // namespace carom
