#pragma once
// Values of a scene file as JSON, for what describes the format to other programs.
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "yaml/document.h"

namespace carom {

/// Plain scalars become numbers, true or false where they are written so, text otherwise; null stays null.
nlohmann::ordered_json json_of(const Node& node);

/// The same of one line of YAML that has been read before: a default or an example of the table of fields, a value of a
/// sweep.
nlohmann::ordered_json json_of_yaml(std::string_view yaml);

/// Such a line as a table's cell: text without the quotes that YAML wants, all else as it stands.
std::string cell_text(std::string_view yaml);

/// A number without a fraction as JSON has it: 2, not 2.0.
nlohmann::ordered_json number_json(double value);

}  // namespace carom
