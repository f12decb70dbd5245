// Glyphs are rendered at fractions of a pixel, so that letters keep their distances. Kerning is the font's own.
#include "overlay/font.h"

#include <fmt/format.h>
#include <freetype/freetype.h>
#include <freetype/ftoutln.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <tuple>

#include "program_file.h"
#include "render/render_error.h"
#include "std.h"
#include "yaml/letters.h"

namespace carom {
namespace {

namespace fs = std::filesystem;

constexpr const char* font_file = "DejaVuSans.ttf";
constexpr int deepest = 4;  // folders below a folder of fonts

string variable_or(const char* name, const string& usual) {
  const char* text = std::getenv(name);
  return text != nullptr && *text != '\0' ? text : usual;
}

/// The folders of fonts of the XDG base directories, the older one of a user, and that of the prefix which the program
/// is in: an archive brings its own.
vector<fs::path> font_folders() {
  vector<fs::path> folders;
  const string home = variable_or("HOME", "");
  const string own = variable_or("XDG_DATA_HOME", home.empty() ? "" : home + "/.local/share");
  if (!own.empty()) folders.push_back(fs::path(own) / "fonts");
  if (!home.empty()) folders.push_back(fs::path(home) / ".fonts");

  const string prefix = program_prefix();
  if (!prefix.empty()) folders.push_back(fs::path(prefix) / "share/fonts");

  const string shared = variable_or("XDG_DATA_DIRS", "/usr/local/share:/usr/share");
  for (size_t i = 0; i <= shared.size();) {
    const size_t end = min(shared.find(':', i), shared.size());
    if (end > i) folders.push_back(fs::path(shared.substr(i, end - i)) / "fonts");
    i = end + 1;
  }
  return folders;
}

string found_in(const fs::path& folder) {
  std::error_code error;
  fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error), end;
  for (; !error && entry != end; entry.increment(error)) {
    if (entry->path().filename() == font_file && entry->is_regular_file(error)) return entry->path().string();
    if (entry.depth() >= deepest) entry.disable_recursion_pending();
  }
  return {};
}

/// Whether a character is never seen: marks of direction, joiners and selectors of variants.
bool is_unseen(char32_t code) {
  return (code >= 0x200b && code <= 0x200f) || (code >= 0x202a && code <= 0x202e) ||
         (code >= 0x2060 && code <= 0x2064) || (code >= 0xfe00 && code <= 0xfe0f) || code == 0xfeff;
}

/// The characters of UTF-8 that are seen. Bytes that are not part of one are left out.
vector<char32_t> characters(string_view text) {
  vector<char32_t> codes;
  for (size_t i = 0; i < text.size();) {
    char32_t code = 0;
    const int length = utf8_length(text, i, code);
    if (length > 0 && !is_unseen(code)) codes.push_back(code);
    i += size_t(max(length, 1));
  }
  return codes;
}

/// Upright sans serif before all else, of the families with the most letters.
int rank_of(const string& name) {
  const auto has = [&](const char* part) { return name.find(part) != string::npos; };
  const bool plain = !has("Bold") && !has("Italic") && !has("Oblique") && !has("Mono") && !has("Serif");
  if (name.starts_with("NotoSans") && plain) return 0;
  if (name.starts_with("DroidSansFallback") || name.starts_with("Symbola")) return 1;
  return plain ? 2 : 3;
}

/// All other fonts of the system, in the order in which letters are sought in them.
vector<fs::path> other_fonts() {
  vector<fs::path> files;
  for (const fs::path& folder : font_folders()) {
    std::error_code error;
    fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error), end;
    for (; !error && entry != end; entry.increment(error)) {
      const string ending = entry->path().extension().string();
      const bool is_font = ending == ".ttf" || ending == ".otf" || ending == ".ttc";
      if (is_font && entry->path().filename() != font_file && entry->is_regular_file(error))
        files.push_back(entry->path());
      if (entry.depth() >= deepest) entry.disable_recursion_pending();
    }
  }

  ranges::sort(files, {}, [](const fs::path& file) {
    const string name = file.filename().string();
    return std::tuple(rank_of(name), name, file.string());
  });
  return files;
}

double pixels(FT_Pos units) {
  return double(units) / 64;
}

}  // namespace

string find_font(string_view user, string_view instead) {
  for (const fs::path& folder : font_folders()) {
    const string found = found_in(folder);
    if (!found.empty()) return found;
  }
  throw RenderError(fmt::format(
      "{} needs the typeface DejaVu Sans, and no folder of fonts has {}\n  install it (on Debian: apt install "
      "fonts-dejavu-core), or {}",
      user, font_file, instead));
}

string find_font() {
  return find_font(
      "text in pictures",
      "leave out `caption`, `labels`, `scale_bar`, `arrows`, `color: {by: ...}`, and `title` and `beside` of `video`");
}

/// DejaVu Sans, and the other fonts that letters were found in.
struct Font::Face {
  Face() = default;
  ~Face() {
    for (FT_Face other : others) FT_Done_Face(other);
    if (face != nullptr) FT_Done_Face(face);
    if (library != nullptr) FT_Done_FreeType(library);
  }
  Face(const Face&) = delete;
  Face& operator=(const Face&) = delete;

  /// The face that has a letter; null: none has it.
  FT_Face with(char32_t code) const {
    if (FT_Get_Char_Index(face, code) != 0) return face;
    const auto known = found.find(code);
    return known != found.end() ? known->second : found[code] = sought(code);
  }

  FT_Face sought(char32_t code) const {
    for (FT_Face other : others)
      if (FT_Get_Char_Index(other, code) != 0) return other;
    if (!files) files = other_fonts();
    for (const fs::path& file : *files) {
      FT_Face other = nullptr;
      if (FT_New_Face(library, file.c_str(), 0, &other) != 0) continue;
      // Fonts of fixed sizes, such as coloured emoji, have no outlines.
      if (FT_IS_SCALABLE(other) && FT_Get_Char_Index(other, code) != 0 && set_size(other)) {
        others.push_back(other);
        return other;
      }
      FT_Done_Face(other);
    }
    return nullptr;
  }

  bool set_size(FT_Face of) const { return FT_Set_Char_Size(of, 0, std::lround(size * 64), 72, 72) == 0; }

  /// Calls `use` with each glyph, unhinted, and the place of its origin in pixels from the start of the text.
  /// Returns the width of the text.
  template <typename Use>
  double each_glyph(string_view text, const Use& use) const {
    double x = 0;
    FT_UInt before = 0;
    FT_Face face_before = nullptr;
    for (const char32_t code : characters(text)) {
      FT_Face const its = with(code) != nullptr ? with(code) : face;
      const FT_UInt glyph = FT_Get_Char_Index(its, code);
      FT_Vector kerning{};
      if (before != 0 && its == face_before && FT_Get_Kerning(its, before, glyph, FT_KERNING_UNFITTED, &kerning) == 0)
        x += pixels(kerning.x);

      if (FT_Load_Glyph(its, glyph, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) != 0) continue;
      use(its->glyph, x);
      // 16.16
      x += double(its->glyph->linearHoriAdvance) / 65536;
      before = glyph;
      face_before = its;
    }
    return x;
  }

  FT_Library library = nullptr;
  FT_Face face = nullptr;
  double size = 0;  // pixels
  mutable vector<FT_Face> others;
  mutable map<char32_t, FT_Face> found;      // null: no font has the letter
  mutable optional<vector<fs::path>> files;  // none: no letter was sought yet
};

Font::Font(const string& file, double size) : face_(make_unique<Face>()) {
  if (FT_Init_FreeType(&face_->library) != 0 || FT_New_Face(face_->library, file.c_str(), 0, &face_->face) != 0)
    throw RenderError(fmt::format("cannot read the font {}: install fonts-dejavu-core again", file));
  resize(size);
}

void Font::resize(double size) {
  face_->size = size;
  bool good = face_->set_size(face_->face);
  for (FT_Face other : face_->others) good = face_->set_size(other) && good;
  if (!good)
    throw RenderError(fmt::format("the font has no letters of {} pixels: install fonts-dejavu-core again", size));
  size_ = size;
}

Font::~Font() = default;

double Font::ascent() const {
  return size_ * face_->face->ascender / face_->face->units_per_EM;
}

double Font::descent() const {
  return -size_ * face_->face->descender / face_->face->units_per_EM;
}

double Font::width(string_view text) const {
  return face_->each_glyph(text, [](FT_GlyphSlot, double) {});
}

std::u32string Font::lacking(string_view text, bool alone) const {
  std::u32string letters;
  for (const char32_t code : characters(text))
    if ((alone ? FT_Get_Char_Index(face_->face, code) == 0 : face_->with(code) == nullptr) &&
        letters.find(code) == std::u32string::npos)
      letters += code;
  return letters;
}

void Font::draw(string_view text, double x, double y, Coverage& to) const {
  const auto add = [&](FT_GlyphSlot glyph, double place) {
    const double left = x + place, whole_x = floor(left), whole_y = floor(y);
    // The outline's y axis points upwards.
    FT_Outline_Translate(&glyph->outline, std::lround((left - whole_x) * 64), -std::lround((y - whole_y) * 64));
    if (FT_Render_Glyph(glyph, FT_RENDER_MODE_NORMAL) != 0) return;

    // Add its coverage to what is there.
    const FT_Bitmap& bitmap = glyph->bitmap;
    for (int row = 0; row < int(bitmap.rows); ++row) {
      for (int column = 0; column < int(bitmap.width); ++column) {
        const int px = int(whole_x) + glyph->bitmap_left + column;
        const int py = int(whole_y) - glyph->bitmap_top + row;
        if (px < 0 || py < 0 || px >= to.width || py >= to.height) continue;
        uint8_t& covered = to.at(px, py);
        covered = uint8_t(min(255, covered + bitmap.buffer[row * bitmap.pitch + column]));
      }
    }
  };
  face_->each_glyph(text, add);
}

}  // namespace carom
