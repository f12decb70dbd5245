// Glyphs are rendered at fractions of a pixel, so that letters keep their distances. Kerning is the font's own.
#include "overlay/font.h"

#include <fmt/format.h>
#include <freetype/freetype.h>
#include <freetype/ftoutln.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

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

/// The folders of fonts of the XDG base directories, and the older one of a user.
vector<fs::path> font_folders() {
  vector<fs::path> folders;
  const string home = variable_or("HOME", "");
  const string own = variable_or("XDG_DATA_HOME", home.empty() ? "" : home + "/.local/share");
  if (!own.empty()) folders.push_back(fs::path(own) / "fonts");
  if (!home.empty()) folders.push_back(fs::path(home) / ".fonts");
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

/// The characters of UTF-8. Bytes that are not part of one are left out.
vector<char32_t> characters(string_view text) {
  vector<char32_t> codes;
  for (size_t i = 0; i < text.size();) {
    char32_t code = 0;
    const int length = utf8_length(text, i, code);
    if (length > 0) codes.push_back(code);
    i += size_t(max(length, 1));
  }
  return codes;
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

struct Font::Face {
  Face() = default;
  ~Face() {
    if (face != nullptr) FT_Done_Face(face);
    if (library != nullptr) FT_Done_FreeType(library);
  }
  Face(const Face&) = delete;
  Face& operator=(const Face&) = delete;

  /// Calls `use` with each glyph, unhinted, and the place of its origin in pixels from the start of the text.
  /// Returns the width of the text.
  template <typename Use>
  double each_glyph(string_view text, const Use& use) const {
    double x = 0;
    FT_UInt before = 0;
    for (const char32_t code : characters(text)) {
      const FT_UInt glyph = FT_Get_Char_Index(face, code);
      FT_Vector kerning{};
      if (before != 0 && FT_Get_Kerning(face, before, glyph, FT_KERNING_UNFITTED, &kerning) == 0)
        x += pixels(kerning.x);

      if (FT_Load_Glyph(face, glyph, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP) != 0) continue;
      use(face->glyph, x);
      // 16.16
      x += double(face->glyph->linearHoriAdvance) / 65536;
      before = glyph;
    }
    return x;
  }

  FT_Library library = nullptr;
  FT_Face face = nullptr;
};

Font::Font(const string& file, double size) : face_(make_unique<Face>()) {
  if (FT_Init_FreeType(&face_->library) != 0 || FT_New_Face(face_->library, file.c_str(), 0, &face_->face) != 0)
    throw RenderError(fmt::format("cannot read the font {}: install fonts-dejavu-core again", file));
  resize(size);
}

void Font::resize(double size) {
  if (FT_Set_Char_Size(face_->face, 0, std::lround(size * 64), 72, 72) != 0)
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
