// Most texts are of letters that DejaVu Sans certainly has. Then no font is opened.
#include "overlay/text_notes.h"

#include <fmt/format.h>

#include "overlay/font.h"
#include "overlay/legend.h"
#include "render/render_error.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/letters.h"

namespace carom {
namespace {

constexpr size_t most_shown = 12;  // letters in a sentence

struct Script {
  char32_t first, last;
  const char* package;  // of Debian, with its letters
  bool shaped = false;  // letters are joined, reordered, or run from right to left
};

// Those not named here are in fonts-noto-core.
constexpr Script scripts[] = {{0x0590, 0x08ff, "fonts-noto-core", true},  // Hebrew, Arabic, Syriac
                              {0x0900, 0x0dff, "fonts-noto-core", true},  // of India
                              {0x0f00, 0x109f, "fonts-noto-core", true},  // Tibetan, Burmese
                              {0x1780, 0x18af, "fonts-noto-core", true},  // Khmer, Mongolian
                              {0x1100, 0x11ff, "fonts-noto-cjk"},         // Hangul
                              {0x2600, 0x27bf, "fonts-symbola"},          // symbols
                              {0x2e80, 0xa4cf, "fonts-noto-cjk"},         // Chinese, Japanese
                              {0xac00, 0xd7af, "fonts-noto-cjk"},         // Hangul
                              {0xf900, 0xfaff, "fonts-noto-cjk"},         // Chinese
                              {0xfb1d, 0xfdff, "fonts-noto-core", true},  // Hebrew, Arabic
                              {0xff00, 0xffef, "fonts-noto-cjk"},         // wide letters
                              {0x1f000, 0x1faff, "fonts-symbola"},        // emoji
                              {0x20000, 0x3ffff, "fonts-noto-cjk"}};      // Chinese

const Script* script_of(char32_t letter) {
  const auto found =
      ranges::find_if(scripts, [&](const Script& script) { return letter >= script.first && letter <= script.last; });
  return found == std::end(scripts) ? nullptr : &*found;
}

/// Latin with its accents, Greek and Cyrillic, and their punctuation.
bool is_usual(char32_t letter) {
  return letter < 0x0530 || (letter >= 0x1e00 && letter <= 0x20cf);
}

string utf8_of(char32_t letter) {
  const auto byte = [](char32_t bits) { return char(static_cast<unsigned char>(bits)); };
  const auto rest = [&](int shift) { return byte(0x80 | ((letter >> shift) & 0x3f)); };
  if (letter < 0x80) return {byte(letter)};
  if (letter < 0x800) return {byte(0xc0 | (letter >> 6)), rest(0)};
  if (letter < 0x10000) return {byte(0xe0 | (letter >> 12)), rest(6), rest(0)};
  return {byte(0xf0 | (letter >> 18)), rest(12), rest(6), rest(0)};
}

string listed(const std::u32string& letters) {
  string text;
  for (size_t i = 0; i < min(letters.size(), most_shown); ++i) text += utf8_of(letters[i]);
  return letters.size() > most_shown ? fmt::format("{} and {} more", text, letters.size() - most_shown) : text;
}

std::u32string unusual_letters(const vector<string>& texts) {
  std::u32string letters;
  for (const string& text : texts) {
    for (size_t i = 0; i < text.size();) {
      char32_t code = 0;
      i += size_t(max(utf8_length(text, i, code), 1));
      if (!is_usual(code) && letters.find(code) == std::u32string::npos) letters += code;
    }
  }
  return letters;
}

/// Those of Debian that have these letters.
string packages_of(const std::u32string& letters) {
  vector<string_view> packages;
  for (const char32_t letter : letters) {
    const Script* script = script_of(letter);
    const string_view package = script != nullptr ? script->package : "fonts-noto-core";
    if (!contains(packages, package)) packages.push_back(package);
  }
  string names;
  for (const string_view package : packages) names += (names.empty() ? "" : " ") + string(package);
  return names;
}

}  // namespace

vector<string> text_notes(string_view where, const vector<string>& texts, bool alone) {
  const std::u32string unusual = unusual_letters(texts);
  if (unusual.empty()) return {};
  string all;
  for (const char32_t letter : unusual) all += utf8_of(letter);

  std::u32string lacking;
  try {
    lacking = Font(find_font()).lacking(all, alone);
  } catch (const RenderError&) {
    // The pictures are refused with the remedy.
    return {};
  }

  vector<string> notes;
  if (!lacking.empty())
    notes.push_back(alone
                        ? fmt::format("{} show a box in place of each of the letters {}, which DejaVu Sans lacks",
                                      where, listed(lacking))
                        : fmt::format("{} show a box in place of each of the letters {}, which no installed font has: "
                                      "install one that has them (on Debian: apt install {})",
                                      where, listed(lacking), packages_of(lacking)));

  std::u32string shaped;
  for (const char32_t letter : unusual)
    if (const Script* script = script_of(letter); script != nullptr && script->shaped) shaped += letter;
  if (!shaped.empty())
    notes.push_back(
        fmt::format("{} show the letters {} one by one from left to right, as no font shapes them: their "
                    "scripts join letters or run from right to left",
                    where, listed(shaped)));
  return notes;
}

vector<string> text_notes(const Scene& scene) {
  const Output& output = scene.output;
  if (!output.pictures()) return {};
  vector<string> texts = {scene.overlay.caption};
  if (!scene.overlay.caption.empty() || (output.video && output.video->title)) texts.push_back(scene.title);
  for (const Legend& legend : legends_of(scene))
    for (const Legend::Entry& entry : legend.entries) texts.push_back(entry.name);
  return text_notes("pictures", texts);
}

}  // namespace carom
