#pragma once
// Expressions in the tree of a scene file: `let`, numbers that are texts beginning with `=`, and names with `{i}`.

#include "scene/formula.h"
#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/document.h"

namespace carom {

/// Numbers with names. A number without a value was reported as wrong.
struct NamedNumbers {
  vector<string> names;
  vector<double> values;
  vector<bool> known;
  /// Of numbers drawn by rand(i). None: it is not known yet.
  optional<uint64_t> seed = {};

  void add(string name, double value);
  bool has(string_view name) const;
};

/// Whether a value is an expression: it begins with `=`.
bool is_expression(const Node& node);
/// Whether a value is a name with expressions in braces: 'ball.{i}'.
bool has_braces(const Node& node);

/// Reads the map `let` and replaces its expressions by their numbers.
/// Adds errors for names that expressions cannot have, circles, and expressions without a value.
NamedNumbers read_let(Node& let, optional<uint64_t> seed, Diagnostics& diagnostics);

/// One value of the tree that holds expressions, and its expressions ready for evaluation.
class Slot {
 public:
  /// None: an error was added, and the value is marked bad. `node` must outlive the slot.
  static optional<Slot> of(Node& node, const NamedNumbers& numbers, Diagnostics& diagnostics);

  /// Writes the value into the node. Returns false after an error.
  bool fill(const NamedNumbers& numbers, Diagnostics& diagnostics);
  /// Bytes of its expressions.
  size_t length() const;

 private:
  explicit Slot(Node& node) : node_(&node), original_(node) {}

  /// A text, and the number after it.
  struct Piece {
    string before;
    size_t at;  // bytes from the start of the value's text to the expression
    optional<Formula> formula;
  };
  optional<double> evaluate(const Piece& piece, const NamedNumbers& numbers, Diagnostics& diagnostics);

  Node* node_;
  Node original_;
  bool is_name_ = false;
  vector<Piece> pieces_;
};

/// The place of an error inside a scalar whose expression begins `at` bytes after the start of its text.
Place place_in(const Node& node, size_t at, const FormulaError& error);

}  // namespace carom
