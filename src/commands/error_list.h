#pragma once
// Errors as members of the documents of --json.
#include <exception>
#include <nlohmann/json.hpp>

#include "std.h"
#include "yaml/diagnostics.h"

namespace carom {

/// A list of objects with the members `file`, `line`, `column`, `message`, `remedy` and `near`. What is unknown is
/// null.
nlohmann::ordered_json errors_json(const vector<ErrorRecord>& errors);

/// The reason of a failure, with a line on what to do where that is known: on a full disk.
string with_remedy(const string& why);

/// What a failure says for itself.
string reason_of(const std::exception& error);

/// The list of one error without a place: the text's first line is the message, the lines below it are the remedy.
vector<ErrorRecord> error_of_text(string_view text, string_view file = {});

}  // namespace carom
