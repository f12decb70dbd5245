// Each buffer view starts at a multiple of four bytes, as its numbers and the chunks of the file require.
#include "render/glb_file.h"

#include <type_traits>

#include "render/renderer.h"
#include "std.h"
#include "yaml/value_json.h"

namespace carom {
namespace {

using Json = nlohmann::ordered_json;

void put_word(string& file, size_t value) {
  const auto word = uint32_t(value);
  file.append(reinterpret_cast<const char*>(&word), sizeof word);
}

void fill_up(string& bytes, char with) {
  bytes.resize((bytes.size() + 3) / 4 * 4, with);
}

}  // namespace

size_t GlbFile::add(const string& list, Json item) {
  json_[list].push_back(std::move(item));
  return json_[list].size() - 1;
}

size_t GlbFile::add_once(const string& list, Json item) {
  const auto [known, is_new] = known_.try_emplace(list + text_of_json(item));
  if (is_new) known->second = add(list, std::move(item));
  return known->second;
}

size_t GlbFile::add_bytes(string_view bytes, Use use) {
  fill_up(binary_, '\0');
  Json view{{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}};
  if (use != Use::data) view["target"] = int(use);
  binary_ += bytes;
  return add("bufferViews", std::move(view));
}

template <typename Number>
size_t GlbFile::add_numbers(span<const Number> numbers, size_t width, Use use) {
  constexpr int unsigned_int = 5125, float_number = 5126;
  constexpr const char* types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  vector<Number> least(numbers.begin(), numbers.begin() + ptrdiff_t(width)), most = least;
  for (size_t i = 0; i < numbers.size(); ++i) {
    least[i % width] = min(least[i % width], numbers[i]);
    most[i % width] = max(most[i % width], numbers[i]);
  }

  const size_t view = add_bytes({reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()}, use);
  return add("accessors", {{"bufferView", view},
                           {"componentType", std::is_same_v<Number, float> ? float_number : unsigned_int},
                           {"count", numbers.size() / width},
                           {"type", types[width - 1]},
                           {"min", least},
                           {"max", most}});
}

template size_t GlbFile::add_numbers(span<const float>, size_t, Use);
template size_t GlbFile::add_numbers(span<const uint32_t>, size_t, Use);

string GlbFile::finished() {
  fill_up(binary_, '\0');
  add("buffers", {{"byteLength", binary_.size()}});
  string text = text_of_json(json_);
  fill_up(text, ' ');

  // The largest size that the format can represent, in bytes.
  constexpr size_t largest = 0xFFFFFFFF, heads = 28;
  const size_t size = heads + text.size() + binary_.size();
  if (size > largest) throw RenderError("animation.glb would be larger than 4 GB: use fewer keyframes a second");

  string out = "glTF";
  out.reserve(size);
  put_word(out, 2);
  put_word(out, size);
  put_word(out, text.size());
  out += "JSON" + text;
  put_word(out, binary_.size());
  return out.append("BIN\0", 4) += binary_;
}

}  // namespace carom
