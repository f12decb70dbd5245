#pragma once
// Values of a scene file as JSON, for descriptions of the format in other programs.
#include <nlohmann/json.hpp>

#include "std.h"
#include "yaml/document.h"

namespace carom {

/// Plain scalars that are written as numbers, true or false become these.
/// Other scalars become text, and null stays null.
nlohmann::ordered_json json_of(const Node& node);

/// The same of one line of YAML: a default or an example of the table of fields, or a value of a sweep.
/// The line has been parsed successfully before.
nlohmann::ordered_json json_of_yaml(string_view yaml);

/// Such a line as a cell of a table: text without the quotes that YAML requires, any other value unchanged.
string cell_text(string_view yaml);

/// A JSON text as a value. Discarded (is_discarded()): it is no JSON text.
/// A function of its own, since each source that calls the library's parser would compile it.
nlohmann::ordered_json json_of_text(string_view text);

/// A value as a JSON text; indent: spaces a level, -1: all on one line. Bytes that are not UTF-8 are replaced.
/// A function of its own, since each source that calls the library's serializer would compile it.
string text_of_json(const nlohmann::ordered_json& value, int indent = -1);

/// A number as JSON. A whole one has no fraction: 2, not 2.0.
nlohmann::ordered_json number_json(double value);

}  // namespace carom
