#pragma once
// Errors as members of the documents of --json.
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "yaml/diagnostics.h"

namespace carom {

/// A list of objects with the members `file`, `line`, `column`, `message`, `remedy` and `near`. What is unknown is
/// null.
nlohmann::ordered_json errors_json(const std::vector<ErrorRecord>& errors);

/// The reason of a failure, with a line on what to do where that is known: on a full disk.
std::string with_remedy(const std::string& why);

/// The list of one error without a place: the text's first line is the message, the lines below it are the remedy.
std::vector<ErrorRecord> error_of_text(std::string_view text, std::string_view file = {});

}  // namespace carom
