// Opens files for the import of a mesh. Links are resolved before the comparison with the folder, so that a link does
// not lead out of it. Texts of Wavefront files are changed on the way to assimp: it looks each name of a group up among
// all others, which takes minutes for tens of thousands, and takes grey for a colour that a material does not give.
#include "render/mesh_files.h"

#include <assimp/MemoryIOWrapper.h>
#include <fmt/format.h>

#include <charconv>
#include <fstream>

#include "std.h"
#include "yaml/other_case.h"

namespace carom {
namespace {

constexpr size_t most_changes = 1000;

string remedy(const char* way) {
  return fmt::format("Remedy: {}, or give the body a `color`", way);
}

/// Calls `use` with the place of each line's first word and the line from there on.
template <typename Use>
void for_lines(string_view text, Use use) {
  for (size_t i = 0; i < text.size();) {
    while (i < text.size() && (text[i] == ' ' || text[i] == '\t')) ++i;
    size_t end = i;
    while (end < text.size() && text[end] != '\n' && text[end] != '\r') ++end;
    use(i, text.substr(i, end - i));
    i = end;
    while (i < text.size() && (text[i] == '\n' || text[i] == '\r')) ++i;
  }
}

/// Whether this is the first word of the line.
bool opens(string_view line, string_view word) {
  return line.starts_with(word) && (line.size() == word.size() || line[word.size()] <= ' ');
}

string after(string_view line, string_view word) {
  line.remove_prefix(word.size());
  while (!line.empty() && line.front() <= ' ') line.remove_prefix(1);
  while (!line.empty() && line.back() <= ' ') line.remove_suffix(1);
  return string(line);
}

size_t words(string_view line) {
  size_t count = 0;
  for (size_t i = 0; i < line.size(); ++i) count += line[i] > ' ' && (i == 0 || line[i - 1] <= ' ');
  return count;
}

WavefrontNames names_of(string_view text) {
  WavefrontNames names;
  for_lines(text, [&](size_t, string_view line) {
    if (opens(line, "mtllib")) names.libraries.push_back(after(line, "mtllib"));
    if (opens(line, "usemtl")) ++names.changes;
    if (!names.vertex_colors && opens(line, "v")) names.vertex_colors = words(line) == 7;
  });
  return names;
}

/// Turns lines that name groups, and materials unless `painted`, into comments. They have no effect on the shape.
void drop_names(string& text, bool painted) {
  for_lines(text, [&](size_t at, string_view line) {
    if (opens(line, "g") || opens(line, "o") || (!painted && (opens(line, "usemtl") || opens(line, "mtllib"))))
      text[at] = '#';
  });
}

vector<string_view> split(string_view line) {
  vector<string_view> parts;
  for (size_t i = 0; i < line.size();) {
    const size_t end = min(line.find_first_of(" \t", i), line.size());
    if (end > i) parts.push_back(line.substr(i, end - i));
    i = end + 1;
  }
  return parts;
}

optional<float> number_in(string_view word) {
  float x = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), x);
  return error == std::errc() && end == word.data() + word.size() ? optional(x) : nullopt;
}

/// A line `map_Kd -s 2 2 1 -clamp on wood.png` in parts.
struct TextureLine {
  string file;
  bool clamp = false;
  WavefrontPlacement placement;
  string unused;  // the first option that is not used, and would change the picture
};

TextureLine texture_line(string_view line) {
  TextureLine out;
  const vector<string_view> parts = split(line);
  size_t i = 1;
  while (i < parts.size() && parts[i].size() > 1 && parts[i][0] == '-' && !number_in(parts[i])) {
    const string_view option = parts[i++];
    const size_t first = i;
    // One to three numbers, or a word.
    array<float, 3> numbers = option == "-s" ? array<float, 3>{1, 1, 1} : array<float, 3>{};
    for (; i + 1 < parts.size() && i - first < 3 && number_in(parts[i]); ++i) numbers[i - first] = *number_in(parts[i]);
    const string_view word = i == first && i + 1 < parts.size() ? parts[i++] : string_view();

    if (option == "-s") out.placement.scale = {numbers[0], numbers[1]};
    if (option == "-o") out.placement.offset = {numbers[0], numbers[1]};
    if (option == "-clamp") out.clamp = word == "on";

    // These do not change the colours.
    static constexpr string_view harmless[] = {"-s", "-o", "-clamp", "-blendu", "-blendv", "-boost", "-texres", "-bm"};
    const bool is_known = std::find(std::begin(harmless), std::end(harmless), option) != std::end(harmless);
    if (!is_known && out.unused.empty()) out.unused = option;
  }

  // A name may contain spaces.
  if (i < parts.size()) out.file = after(line.substr(size_t(parts[i].data() - line.data())), "");
  return out;
}

/// Makes materials white that give no colour: a texture alone then has its own. Options of textures become placements.
string with_white(const string& text, set<string>& defined, map<string, WavefrontPlacement>& placements) {
  string out, material;
  for_lines(text, [&](size_t, string_view line) {
    if (opens(line, "map_Kd")) {
      const TextureLine texture = texture_line(line);
      placements[material] = texture.placement;
      out += fmt::format("map_Kd {}{}\n", texture.clamp ? "-clamp on " : "", texture.file);
      return;
    }

    out.append(line) += '\n';
    if (!opens(line, "newmtl")) return;

    // The next lines describe this material.
    out += "Kd 1 1 1\n";
    material = after(line, "newmtl");
    defined.insert(material);
  });

  return out;
}

/// Throws runtime_error if a texture has an option that is not used.
void check_options(const string& name, const string& text) {
  size_t number = 1, counted = 0;
  for_lines(text, [&](size_t at, string_view line) {
    number += size_t(std::count(text.begin() + ptrdiff_t(counted), text.begin() + ptrdiff_t(at), '\n'));
    counted = at;
    const string unused = opens(line, "map_Kd") ? texture_line(line).unused : "";
    if (!unused.empty())
      throw runtime_error(fmt::format("line {} of its material file {}: the option {} of map_Kd is not used. {}",
                                      number, name, unused, remedy("remove the option")));
  });
}

string whole(Assimp::IOStream& stream) {
  string text(stream.FileSize(), '\0');
  text.resize(stream.Read(text.data(), 1, text.size()));
  return text;
}

string whole(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Assimp::IOStream* stream_of(const string& text) {
  auto bytes = make_unique<uint8_t[]>(text.size());
  ranges::copy(text, bytes.get());
  return new Assimp::MemoryIOStream(bytes.release(), text.size(), true);
}

int hex_digit(char c) {
  return c >= '0' && c <= '9'   ? c - '0'
         : c >= 'a' && c <= 'f' ? c - 'a' + 10
         : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                : -1;
}

/// The file name in a URI ("my%20wood.png"), with the separators of this system.
string name_in(const string& uri) {
  string name;
  for (size_t i = 0; i < uri.size(); ++i) {
    const int high = i + 2 < uri.size() ? hex_digit(uri[i + 1]) : -1, low = high < 0 ? -1 : hex_digit(uri[i + 2]);
    if (uri[i] == '%' && low >= 0 && 16 * high + low > 0) {
      name += char(16 * high + low);
      i += 2;
    } else {
      name += uri[i] == '\\' ? '/' : uri[i];
    }
  }
  return name;
}

std::filesystem::path folder_of(const string& file) {
  const std::filesystem::path folder = std::filesystem::path(file).lexically_normal().parent_path();
  return folder.empty() ? "." : folder;
}

}  // namespace

MeshFiles::MeshFiles(const string& file, const string& ending, bool painted)
    : file_(file), ending_(ending), painted_(painted), folder_(folder_of(file)) {}

bool MeshFiles::within(const std::filesystem::path& file) const {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::canonical(folder_, error);
  if (error) return false;
  const std::filesystem::path real = std::filesystem::canonical(file, error);
  if (error || std::mismatch(folder.begin(), folder.end(), real.begin(), real.end()).first != folder.end())
    return false;
  return std::filesystem::is_regular_file(real, error);
}

bool MeshFiles::Exists(const char* file) const {
  return (file == file_ || within(file)) && Assimp::DefaultIOSystem::Exists(file);
}

Assimp::IOStream* MeshFiles::Open(const char* file, const char* mode) {
  const bool reads = string_view(mode).find_first_of("wa+") == string_view::npos;
  if (!reads) return nullptr;
  if (file != file_ && !within(file)) {
    if (unopened_.empty()) unopened_ = std::filesystem::path(file).lexically_relative(folder_).string();
    return nullptr;
  }
  unique_ptr<Assimp::IOStream> stream(Assimp::DefaultIOSystem::Open(file, mode));
  if (!stream || ending_ != "obj") return stream.release();
  string text = whole(*stream);
  if (file != file_) return stream_of(with_white(text, defined_, placements_));
  drop_names(text, painted_);
  return stream_of(text);
}

bool MeshFiles::mentions_colors() const {
  const string text = whole(file_);
  if (ending_ != "obj") return text.find("\"materials\"") != string::npos || text.find("\"COLOR_0\"") != string::npos;
  const WavefrontNames names = names_of(text);
  if (names.changes == 0 || names.libraries.empty()) return names.vertex_colors;
  if (names.changes > most_changes)
    throw runtime_error(fmt::format("it changes its material more than {} times. {}", most_changes,
                                    remedy("sort its faces by material")));
  for (const string& name : names.libraries) check_options(name, whole(found("material file", name)));
  return true;
}

void MeshFiles::check_opened() const {
  if (!unopened_.empty()) found("file", unopened_, "");
}

std::filesystem::path MeshFiles::found(const string& what, const string& name, string_view instead) const {
  for (const string& way : {name, name_in(name)}) {
    const std::filesystem::path file = folder_ / way;
    if (within(file)) return file;
  }

  string fault = "is not there", way = "put it beside the mesh";
  std::error_code error;
  const string other = name_in_other_case(folder_, name_in(name));

  if (std::filesystem::exists(folder_ / name_in(name), error)) {
    fault = "is not a file in the mesh's folder";
    way = "copy it into that folder and name the copy";
  } else if (!other.empty() && within(folder_ / other)) {
    fault += fmt::format(", but {} is", other);
    way = "write its name as on the disk";
  }

  throw runtime_error(fmt::format("its {} {} {}. Remedy: {}{}", what, name, fault, way, instead));
}

string MeshFiles::read(const string& what, const string& name, uint64_t most_bytes) const {
  const std::filesystem::path file = found(what, name);
  const uint64_t size = std::filesystem::file_size(file);
  if (size > most_bytes)
    throw runtime_error(fmt::format("its {} {} has {} bytes; at most {} are read", what, name, size, most_bytes));
  return whole(file);
}

}  // namespace carom
