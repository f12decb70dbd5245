#pragma once
// Text as coverage of pixels, by FreeType, in the typeface DejaVu Sans. Letters that it lacks come from another font of
// the system, the first in a fixed order that has them. Each letter stands alone, from left to right: scripts that join
// letters or run from right to left would need a shaper, which is a library of its own (text_notes.h warns of them).

#include "std.h"

namespace carom {

/// How much of each pixel is covered, 0 to 255, top row first.
struct Coverage {
  Coverage(int w, int h) : width(w), height(h), values(size_t(w) * size_t(h)) {}
  uint8_t& at(int x, int y) { return values[size_t(y) * size_t(width) + size_t(x)]; }
  uint8_t at(int x, int y) const { return values[size_t(y) * size_t(width) + size_t(x)]; }

  int width, height;  // pixels
  vector<uint8_t> values;
};

/// The file of the typeface, from the system's folders of fonts. Throws RenderError with the remedy.
/// `user` needs it, and `instead` can be done without it.
string find_font(string_view user, string_view instead);
/// For the text of a scene's pictures.
string find_font();

class Font {
 public:
  /// Letters without hinting, so that the same text has the same pixels everywhere. `file`: that of find_font().
  /// `size`: pixels (em). Throws RenderError.
  explicit Font(const string& file, double size = 12);
  ~Font();
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  double size() const { return size_; }
  void resize(double size);  // pixels. Throws RenderError.
  // Pixels, of any letter of Latin script: above and below the base line.
  double ascent() const;
  double descent() const;
  double line() const { return 1.2 * (ascent() + descent()); }  // pixels from line to line
  double width(string_view text) const;                         // pixels; text: UTF-8
  /// The letters of the text that no font has, each once. They are drawn as boxes. `alone`: that DejaVu Sans lacks.
  std::u32string lacking(string_view text, bool alone = false) const;
  /// Adds the text. Its base line starts at (x, y), in pixels from the upper left corner. What lies outside is left
  /// out.
  void draw(string_view text, double x, double y, Coverage& to) const;

 private:
  struct Face;
  double size_ = 0;
  unique_ptr<Face> face_;
};

}  // namespace carom
