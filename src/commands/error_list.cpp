// All commands have the same members, so that a reader of one can read every other.
#include "commands/error_list.h"

#include <new>

#include "files/failed_run.h"
#include "std.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

Json text_or_null(const string& text) {
  return text.empty() ? Json() : Json(text);
}

Json positive_or_null(size_t number) {
  return number == 0 ? Json() : Json(number);
}

string_view trimmed(string_view text) {
  const size_t first = text.find_first_not_of(" \n");
  if (first == string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \n") - first + 1);
}

}  // namespace

Json errors_json(const vector<ErrorRecord>& errors) {
  Json list = Json::array();
  for (const ErrorRecord& error : errors)
    list.push_back({{"file", text_or_null(error.file)},
                    {"line", positive_or_null(error.line)},
                    {"column", positive_or_null(error.column)},
                    {"message", error.message},
                    {"remedy", text_or_null(error.remedy)},
                    {"near", text_or_null(error.near)}});
  return list;
}

string with_remedy(const string& why) {
  return names_full_disk(why)
             ? why + "\n  make room, then the same command runs what is missing, or write elsewhere with -o"
             : why;
}

string reason_of(const std::exception& error) {
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ? "not enough memory" : error.what();
}

vector<ErrorRecord> error_of_text(string_view text, string_view file) {
  text = trimmed(text);
  const size_t end = min(text.find('\n'), text.size());
  ErrorRecord error{string(file), 0, 0, string(text.substr(0, end)), {}, suggestion_in(text)};
  for (text.remove_prefix(end); !(text = trimmed(text)).empty();) {
    const size_t stop = min(text.find('\n'), text.size());
    if (!error.remedy.empty()) error.remedy += '\n';
    error.remedy += text.substr(0, stop);
    text.remove_prefix(stop);
  }
  return {error};
}

}  // namespace carom
