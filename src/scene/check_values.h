#pragma once
// Checks one value against its row of the table of fields.

#include "scene/field.h"
#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/document.h"

namespace carom {

/// The words that a value may have in place of numbers.
enum class ColorWords : uint8_t { colors, colors_and_none };

/// Each check that fails marks the value bad and adds an error. A value that is already bad adds no further error.
/// `name`: the value's name in messages.
class ValueChecker {
 public:
  explicit ValueChecker(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

 protected:
  void refuse(Node& node, string message, string remedy);
  void wrong_type(Node& node, const string& name, const string& required);

  /// `limits`: the limits of a run's arithmetic (fields.h), beyond the field's own range.
  bool number(Node& value, const Field& field, const string& name, const Range& limits);
  bool whole(Node& value, const Field& field, const string& name);
  /// As many as the field's type has components.
  bool numbers(Node& value, const Field& field, const string& name);
  void choice(Node& value, const Field& field, const string& name);
  void color(Node& value, const string& name, ColorWords words = ColorWords::colors);

  Diagnostics& diagnostics_;
};

}  // namespace carom
