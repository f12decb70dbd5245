#pragma once
// One value against its row of the table of fields.
#include <string>

#include "scene/fields.h"
#include "yaml/diagnostics.h"
#include "yaml/document.h"

namespace carom {

/// Each check marks a value bad and adds an error if it fails; a value that is bad already says no more.
/// `name` is the value in messages.
class ValueChecker {
 public:
  explicit ValueChecker(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

 protected:
  void refuse(Node& node, std::string message, std::string remedy);
  void wrong_type(Node& node, const std::string& name, const std::string& wanted);

  /// `limits`: beyond the field's range, what a run can compute with (fields.h).
  bool number(Node& value, const Field& field, const std::string& name, const Range& limits);
  bool whole(Node& value, const Field& field, const std::string& name);
  bool numbers(Node& value, const Field& field, const std::string& name, std::size_t count);
  void choice(Node& value, const Field& field, const std::string& name);
  void color(Node& value, const std::string& name);

  Diagnostics& diagnostics_;
};

}  // namespace carom
