// Reads STL itself and not by assimp, which refuses words in capitals, empty solids and bytes behind the triangles, and
// takes 1,5 for 1. A text has no NUL byte, and the count of a binary file of at most 2^24 triangles has one.
#include "render/stl.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "std.h"

namespace carom {
namespace {

constexpr size_t header_bytes = 84, triangle_bytes = 50;

/// For a message: at most 40 bytes, and none that a terminal may obey.
string shown(string word) {
  for (char& c : word) c = c > ' ' && c <= '~' ? c : '?';
  return fmt::format("`{}`", word.substr(0, 40));
}

/// The words of a text STL, in order.
class StlText {
 public:
  explicit StlText(string_view text) : text_(text) {}

  vector<array<float, 3>> corners() {
    for (string word = next(); !word.empty(); word = next()) {
      if (word == "solid" || word == "endsolid") {
        skip_line();  // a name of any words
      } else if (word == "facet") {
        facet();
      } else {
        fail(fmt::format("{} is no word of an STL file", shown(word)));
      }
    }
    return std::move(corners_);
  }

 private:
  [[noreturn]] void fail(const string& why) const {
    throw runtime_error(fmt::format("line {}: {}. Remedy: export it again", line_, why));
  }

  static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  /// The next word in lower case. Empty: the text has ended.
  string next() {
    for (; at_ < text_.size() && is_blank(text_[at_]); ++at_) line_ += text_[at_] == '\n';
    string word;
    for (; at_ < text_.size() && !is_blank(text_[at_]); ++at_) {
      const char c = text_[at_];
      word += c >= 'A' && c <= 'Z' ? char(c + 32) : c;
    }
    return word;
  }

  void skip_line() { at_ = min(text_.find('\n', at_), text_.size()); }

  void expect(string_view wanted) {
    const string word = next();
    if (word.empty()) fail("it ends within a triangle: the file is cut off");
    if (word != wanted) fail(fmt::format("{} stands in place of `{}`", shown(word), wanted));
  }

  void facet() {
    expect("normal");
    for (int k = 0; k < 3; ++k) next();  // normals are made anew
    expect("outer");
    expect("loop");
    for (int corner = 0; corner < 3; ++corner) {
      expect("vertex");
      array<float, 3>& place = corners_.emplace_back();
      for (float& x : place) x = number();
    }
    expect("endloop");
    expect("endfacet");
  }

  float number() {
    const string word = next();
    if (word.empty()) fail("it ends within a triangle: the file is cut off");
    const size_t sign = word.starts_with('+') ? 1 : 0;
    float x = 0;
    const auto [end, error] = std::from_chars(word.data() + sign, word.data() + word.size(), x);
    // A number that is too small for a float is 0, and one that is too large not finite.
    const bool is_number = error != std::errc::invalid_argument && end == word.data() + word.size();
    if (!is_number) fail(fmt::format("{} is not a number", shown(word)));
    if (error == std::errc::result_out_of_range) x = float(std::strtod(word.c_str() + sign, nullptr));
    if (!isfinite(x)) fail(fmt::format("{} is not a finite number", shown(word)));
    return x;
  }

  string_view text_;
  size_t at_ = 0, line_ = 1;
  vector<array<float, 3>> corners_;
};

vector<array<float, 3>> binary_corners(string_view bytes) {
  uint32_t count = 0;
  if (bytes.size() >= header_bytes) std::memcpy(&count, bytes.data() + header_bytes - 4, 4);
  const size_t whole = bytes.size() < header_bytes ? 0 : (bytes.size() - header_bytes) / triangle_bytes;
  if (bytes.size() < header_bytes || whole < count)
    throw runtime_error(
        fmt::format("it holds {} of the {} triangles that its header counts, or it is no STL file. Remedy: export it "
                    "again",
                    whole, count));

  vector<array<float, 3>> corners(3 * size_t{count});
  for (size_t t = 0; t < count; ++t) {
    const char* const triangle = bytes.data() + header_bytes + t * triangle_bytes;
    std::memcpy(&corners[3 * t], triangle + 12, 36);  // behind the normal

    for (size_t k = 3 * t; k < 3 * t + 3; ++k)
      for (const float x : corners[k])
        if (!isfinite(x)) throw runtime_error(fmt::format("triangle {} has a corner that is not finite", t + 1));
  }
  return corners;
}

}  // namespace

vector<array<float, 3>> stl_corners(string_view bytes) {
  if (bytes.find('\0') != string_view::npos) return binary_corners(bytes);
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  return StlText(bytes).corners();
}

}  // namespace carom
