#pragma once
// A binary glTF 2 file in the making: its JSON, and one binary chunk with its numbers and pictures.
#include <nlohmann/json.hpp>

#include "std.h"
#include "version.h"

namespace carom {

class GlbFile {
 public:
  /// Adds an item to one of the lists, such as "nodes". Returns its number.
  size_t add(const string& list, nlohmann::ordered_json item);
  /// The same. An item that is there already is not added again.
  size_t add_once(const string& list, nlohmann::ordered_json item);

  /// What a buffer view is for, as glTF numbers it.
  enum class Use { data = 0, vertices = 34962, corners = 34963 };
  /// These return the number of an accessor. There is at least one row, and one corner.
  template <size_t width>
  size_t add_rows(const vector<array<float, width>>& rows, Use use) {
    return add_numbers<float>({rows.front().data(), width * rows.size()}, width, use);
  }
  size_t add_corners(const vector<uint32_t>& corners) { return add_numbers<uint32_t>(corners, 1, Use::corners); }
  /// A buffer view. Returns its number.
  size_t add_bytes(string_view bytes, Use use = Use::data);

  nlohmann::ordered_json& json() { return json_; }
  /// The file. Throws RenderError if it is too large for the format. Call it once, at the end.
  string finished();

 private:
  template <typename Number>
  size_t add_numbers(span<const Number> numbers, size_t width, Use use);

  nlohmann::ordered_json json_ = {{"asset", {{"version", "2.0"}, {"generator", program_and_version}}}};
  string binary_;
  map<string, size_t> known_;  // by list and item
};

}  // namespace carom
