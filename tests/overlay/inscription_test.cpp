// Text on pictures: captions against glyphs rendered by FreeType, legends by their pixels.
#include "overlay/inscription.h"

#include <freetype/freetype.h>
#include <freetype/ftoutln.h>

#include <cstdlib>

#include "overlay/text_notes.h"
#include "render/renderer.h"
#include "scene/scenes_in_text.h"
#include "std.h"

namespace carom {
namespace {

const string two_balls =
    "scene: 1\ntitle: Balls\nsimulate: {duration: 1}\ngravity: [0, 0, 0]\noutput: {frames: true}\nballs:\n"
    "  red: {mass: 1, radius: 0.1, position: [0, 1, 0], velocity: [3, 0, 0], color: {by: speed, min: -1, max: 2.5}}\n"
    "  blue: {mass: 1, radius: 0.1, position: [1, 1, 0], color: {by: speed, min: -1, max: 2.5}}\n";

/// A picture in which neighbouring pixels differ.
Image noise(Size size) {
  Image image{size.width, size.height, {}};
  image.pixels.resize(static_cast<size_t>(size.width * size.height) * 3);
  unsigned value = 1;
  for (uint8_t& byte : image.pixels) {
    value = value * 1664525 + 1013904223;
    byte = static_cast<uint8_t>(value >> 24);
  }
  return image;
}

/// The coverage of a text, glyph by glyph, its base line starting at (x, y).
Coverage by_freetype(const string& text, double size, double x, double y, Size picture) {
  Coverage all(picture.width, picture.height);
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  EXPECT_EQ(FT_Init_FreeType(&library), 0);
  EXPECT_EQ(FT_New_Face(library, find_font().c_str(), 0, &face), 0);
  FT_Set_Char_Size(face, 0, std::lround(size * 64), 72, 72);

  FT_UInt before = 0;
  for (const char c : text) {
    const FT_UInt glyph = FT_Get_Char_Index(face, static_cast<unsigned char>(c));
    FT_Vector kerning{};
    FT_Get_Kerning(face, before, glyph, FT_KERNING_UNFITTED, &kerning);
    x += kerning.x / 64.0;

    FT_Load_Glyph(face, glyph, FT_LOAD_NO_HINTING);
    FT_Outline_Translate(&face->glyph->outline, std::lround((x - floor(x)) * 64), -std::lround((y - floor(y)) * 64));
    FT_Render_Glyph(face->glyph, FT_RENDER_MODE_NORMAL);

    const FT_Bitmap& bitmap = face->glyph->bitmap;
    for (unsigned row = 0; row < bitmap.rows; ++row)
      for (unsigned column = 0; column < bitmap.width; ++column) {
        uint8_t& pixel = all.at(static_cast<int>(floor(x)) + face->glyph->bitmap_left + static_cast<int>(column),
                                static_cast<int>(floor(y)) - face->glyph->bitmap_top + static_cast<int>(row));
        pixel = static_cast<uint8_t>(
            std::min(255, pixel + bitmap.buffer[row * static_cast<unsigned>(bitmap.pitch) + column]));
      }

    x += face->glyph->linearHoriAdvance / 65536.0;
    before = glyph;
  }

  FT_Done_Face(face);
  FT_Done_FreeType(library);
  return all;
}

TEST(Caption, HasThePixelsOfItsGlyphsAtItsPlace) {
  const Scene scene = load_text(start + "title: Balls\ncaption: \"{title}, t = {time} s\"\noutput: {frames: true}\n");
  const Size size{1280, 720};
  Inscription inscription(scene, size);
  const Image ground = noise(size);
  Image image = ground;
  inscription.write({"AVAST Balls", "0.25", "run", "7"}, image);

  const double letters = 720.0 / 28, padding = TextBlock::padding_of(letters);
  const Font font(find_font(), letters);
  const Coverage glyphs = by_freetype("AVAST Balls, t = 0.25 s", letters, inscription.margin() + padding,
                                      inscription.margin() + padding + font.ascent(), size);

  int covered = 0, bare = 0;
  const int left = inscription.margin() + static_cast<int>(padding) + 1;
  const int right = left + static_cast<int>(font.width("AVAST Balls, t = 0.25 s")) - 2;
  const int top = left, bottom = top + static_cast<int>(font.ascent() + font.descent()) - 2;

  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const double part = glyphs.at(x, y) / 255.0;
      for (int c = 0; c < 3; ++c) {
        const double below = 0.4 * ground.row(y)[3 * x + c];  // behind a plate of opacity 0.6
        EXPECT_NEAR(image.row(y)[3 * x + c], part * 255 + (1 - part) * below, 2) << x << ", " << y;
      }
      covered += glyphs.at(x, y) == 255;
      bare += glyphs.at(x, y) == 0;
    }
  }

  EXPECT_GT(covered, 50);
  EXPECT_GT(bare, 500);
}

TEST(Caption, HasAContrastOfFiveToOneOnAnyGround) {
  // Relative luminance by WCAG 2; the ground is white below a plate of opacity 0.6.
  const double grey = 0.4, luminance = pow((grey + 0.055) / 1.055, 2.4);
  EXPECT_GT(1.05 / (luminance + 0.05), 5);  // 5.74
}

TEST(Caption, LeavesTheRestOfThePictureAlone) {
  const Scene scene = load_text(start + "caption: \"{time}\"\noutput: {frames: true}\n");
  const Size size{200, 100};
  Inscription inscription(scene, size);
  const Image ground = noise(size);
  Image image = ground;
  inscription.write({"", "1.5", "", ""}, image);
  EXPECT_NE(image.pixels, ground.pixels);
  for (int y = 40; y < 100; ++y)
    for (int x = 0; x < 600; ++x) ASSERT_EQ(image.row(y)[x], ground.row(y)[x]);
}

TEST(Caption, NeverLeavesThePicture) {
  Font font(find_font());
  string text = "a";
  for (int i = 0; i < 60; ++i) text += i % 7 == 0 ? " Donaudampfschifffahrt" : " bounces of a ball";

  for (const auto& [width, height] :
       {pair(16, 16), {32, 18}, {64, 36}, {480, 20}, {20, 480}, {640, 360}, {1280, 720}}) {
    for (const string& its : {text, string(500, 'W'), string("x")}) {
      const TextBlock block(font, its, std::max(height / 28.0, 10.0), width, height);
      if (block.canvas() == nullptr) continue;
      EXPECT_LE(block.canvas()->width(), width) << width << " x " << height;
      EXPECT_LE(block.canvas()->height(), height) << width << " x " << height;
    }

    Inscription inscription(load_text(start + "output: {frames: true}\n"), {width, height});
    EXPECT_FALSE(inscription.any());
  }
}

TEST(Caption, BreaksAtSpacesAndShrinksBeforeItIsCutOff) {
  const Font font(find_font(), 20);
  Font other(find_font());
  EXPECT_EQ(wrapped(font, "one two", 1000).lines, vector<string>{"one two"});
  EXPECT_EQ(wrapped(font, "one   two", font.width("one  t")).lines, (vector<string>{"one", "two"}));
  EXPECT_EQ(TextBlock(other, "one two", 20, 1000, 100).size(), 20);
  const TextBlock small(other, string(40, 'm'), 20, 400, 100);
  EXPECT_LT(small.size(), 20);
  EXPECT_GT(small.size(), TextBlock::least_size);
  EXPECT_EQ(TextBlock(other, string(400, 'm'), 20, 400, 100).size(), TextBlock::least_size);
  EXPECT_EQ(shortened(font, "abc", 1000), "abc");
  EXPECT_EQ(shortened(font, "abcdef", font.width("ab\u2026")), "ab\u2026");
}

TEST(Caption, IsOpaqueWhereAPictureIsTransparent) {
  Image image{60, 30, vector<uint8_t>(60 * 30 * 4, 0), 4};
  Canvas canvas(10, 10);
  canvas.add(3, 4, Color{1, 1, 1});
  canvas.add(5, 4, Color{0, 0, 0}, 153);
  canvas.lay_onto(image, 2, 2);
  const auto pixel = [&](int x, int y) {
    const uint8_t* p = image.row(y) + 4 * x;
    return vector<int>(p, p + 4);
  };
  EXPECT_EQ(pixel(5, 6), (vector<int>{255, 255, 255, 255}));
  EXPECT_EQ(pixel(7, 6), (vector<int>{0, 0, 0, 153}));
  EXPECT_EQ(pixel(0, 0), (vector<int>{0, 0, 0, 0}));
}

/// Runs some work in a system whose only fonts are in the test's folder.
template <typename Work>
void with_fonts_of(const string& folder, const Work& work) {
  const char* names[] = {"HOME", "XDG_DATA_HOME", "XDG_DATA_DIRS"};
  vector<string> kept;
  for (const char* name : names) {
    kept.emplace_back(std::getenv(name) != nullptr ? std::getenv(name) : "");
    setenv(name, folder.c_str(), 1);
  }
  work();
  for (size_t i = 0; i < 3; ++i) setenv(names[i], kept[i].c_str(), 1);
}

/// A folder with a font under a name.
string folder_with(const string& font, const string& name) {
  const string folder = test_folder() + "_fonts";
  std::filesystem::create_directories(folder + "/fonts");
  std::filesystem::copy_file(font, folder + "/fonts/" + name, std::filesystem::copy_options::overwrite_existing);
  return folder;
}

TEST(Letters, ThatTheFontLacksComeFromAnotherFont) {
  // DejaVu Sans Mono has no Hebrew letters, and DejaVu Sans does.
  const string sans = find_font();
  const string mono = std::filesystem::path(sans).parent_path() / "DejaVuSansMono.ttf";
  const string alef = "\u05d0";
  with_fonts_of(folder_with(sans, "Other.ttf"), [&] {
    const Font font(mono, 40), other(sans, 40);
    EXPECT_EQ(font.lacking("a" + alef), std::u32string());
    EXPECT_EQ(font.lacking("a" + alef, true), std::u32string(U"\u05d0"));
    EXPECT_EQ(font.width(alef), other.width(alef));

    Coverage mixed(120, 60), alone(120, 60);
    font.draw("ab" + alef, 5, 45, mixed);
    font.draw("ab", 5, 45, alone);
    other.draw(alef, 5 + font.width("ab"), 45, alone);
    EXPECT_EQ(mixed.values, alone.values);
  });
  std::filesystem::remove_all(test_folder() + "_fonts");
}

TEST(Letters, ThatNoFontHasAreSaid) {
  with_fonts_of(folder_with(find_font(), "DejaVuSans.ttf"), [&] {
    const auto notes = [](const string& title) {
      return text_notes(load_text(start + "title: \"" + title + "\"\ncaption: true\noutput: {frames: true}\n"));
    };
    EXPECT_EQ(notes("Größe 5 µm, Ωμέγα, Привет, 3 × 4 ≤ 12 …"), vector<string>());
    ASSERT_EQ(notes("球と球 🎱").size(), 1u);
    EXPECT_EQ(
        notes("球と球 🎱")[0],
        "pictures show a box in place of each of the letters 球と🎱, which no installed font has: install one that "
        "has them (on Debian: apt install fonts-noto-cjk fonts-symbola)");
    // DejaVu Sans has Arabic letters, but they would have to be joined.
    ASSERT_EQ(notes("كرة").size(), 1u);
    EXPECT_NE(notes("كرة")[0].find("one by one from left to right"), string::npos);
    // Marks that are not seen need no font.
    EXPECT_EQ(notes("a\u200db\ufe0f"), vector<string>());
    EXPECT_EQ(text_notes(load_text(start + "title: 球\noutput: {frames: true}\n")), vector<string>());
    EXPECT_EQ(text_notes(load_text(start + "title: 球\ncaption: true\n")), vector<string>());
    EXPECT_EQ(text_notes(load_text(start + "title: 球\noutput: {video: {title: true}}\n")).size(), 1u);
    EXPECT_EQ(text_notes("the labels of the film", {"球"}, true)[0],
              "the labels of the film show a box in place of each of the letters 球, which DejaVu Sans lacks");
  });
  std::filesystem::remove_all(test_folder() + "_fonts");
}

TEST(Caption, WithoutItsFontIsAnErrorWithARemedy) {
  const Scene scene = load_text(start + "caption: true\noutput: {frames: true}\n");
  const Scene without = load_text(start + "output: {frames: true}\n");

  const string folder = test_folder();
  const char* names[] = {"HOME", "XDG_DATA_HOME", "XDG_DATA_DIRS"};
  vector<string> kept;
  for (const char* name : names) {
    kept.emplace_back(std::getenv(name) != nullptr ? std::getenv(name) : "");
    setenv(name, folder.c_str(), 1);
  }

  string error;
  try {
    check_font(scene);
  } catch (const RenderError& thrown) {
    error = thrown.what();
  }
  EXPECT_NO_THROW(check_font(without));

  for (size_t i = 0; i < 3; ++i) setenv(names[i], kept[i].c_str(), 1);
  EXPECT_EQ(
      error,
      "text in pictures needs the typeface DejaVu Sans, and no folder of fonts has DejaVuSans.ttf\n  install it "
      "(on Debian: apt install fonts-dejavu-core), or leave out `caption`, `labels`, `scale_bar`, `arrows`, `color: "
      "{by: ...}`, and `title` and `beside` of `video`");
  EXPECT_NO_THROW(check_font(scene));
}

TEST(Legend, HasTheEndsOfItsMapAtTheEndsOfItsStrip) {
  const Size size{640, 360};
  for (const char* map : {"viridis", "cividis", "magma", "plasma", "inferno"}) {
    string text = two_balls;
    for (size_t i = text.find("max: 2.5"); i != string::npos; i = text.find("max: 2.5", i + 20))
      text.insert(i, string("map: ") + map + ", ");

    const Scene scene = load_text(text);
    Inscription inscription(scene, size);
    Image image = noise(size);
    inscription.write({}, image);

    ASSERT_EQ(inscription.legends()->strips().size(), 1u);
    const PixelBox strip = inscription.legends()->strips()[0];
    const ColorMap its = scene.roster.bodies[0].coloring->map;
    const auto color_at = [&](int column) {
      const uint8_t* p = image.row(inscription.legends_top() + strip.top + strip.height / 2) +
                         3 * (inscription.margin() + strip.left + column);
      return hex_text({p[0] / 255.0, p[1] / 255.0, p[2] / 255.0});
    };

    EXPECT_EQ(color_at(0), hex_text(color_in(its, 0))) << map;
    EXPECT_EQ(color_at(strip.width - 1), hex_text(color_in(its, 1))) << map;
    EXPECT_GT(strip.width, 80);
  }
}

TEST(Legend, OfEqualColouringsIsOneAndHasItsNumbersAndUnit) {
  const vector<Legend> legends = legends_of(load_text(two_balls));
  ASSERT_EQ(legends.size(), 1u);
  EXPECT_EQ(legends[0].title, "speed (m/s)");
  EXPECT_EQ(legends[0].min, "-1");
  EXPECT_EQ(legends[0].max, "2.5");
  EXPECT_TRUE(legends[0].entries.empty());
}

TEST(Legend, OfGroupsListsTheirNamesAndColours) {
  const Scene scene = load_text(start +
                                "defaults: {ball: {mass: 1, radius: 0.1, color: {by: group}}}\n"
                                "balls: {red: {position: [9, 0, 0]}}\n"
                                "groups: {gas: {count: 3, in: {min: [0, 0, 0], max: [2, 2, 2]}, ball: {}}}\n");
  const vector<Legend> legends = legends_of(scene);
  ASSERT_EQ(legends.size(), 1u);
  ASSERT_EQ(legends[0].entries.size(), 2u);
  EXPECT_EQ(legends[0].entries[0].name, "red");
  EXPECT_EQ(legends[0].entries[0].color, color_in(ColorMap::viridis, 0));
  EXPECT_EQ(legends[0].entries[1].name, "gas");
  EXPECT_EQ(legends[0].entries[1].color, color_in(ColorMap::viridis, 1));
}

TEST(Legend, OfManyNamesEndsWithTheNumberOfTheOthers) {
  string text = start + "defaults: {ball: {mass: 1, radius: 0.1, color: {by: group}}}\nballs:\n";
  for (int i = 0; i < 20; ++i) text += "  b" + to_string(i) + ": {position: [" + to_string(i) + ", 0, 0]}\n";
  const vector<Legend> legends = legends_of(load_text(text));
  ASSERT_EQ(legends[0].entries.size(), 12u);
  EXPECT_EQ(legends[0].entries.back().name, "9 more");
}

TEST(Legend, NeverLeavesThePicture) {
  const vector<Legend> legends(4, {"kinetic energy (J)", ColorMap::magma, "0", "1200", {}});
  Font font(find_font());
  for (const auto& [width, height] : {pair(16, 16), {64, 36}, {100, 200}, {640, 360}}) {
    const LegendBlock block(font, legends, 20, width, height);
    if (block.canvas() == nullptr) continue;
    EXPECT_LE(block.canvas()->width(), width);
    EXPECT_LE(block.canvas()->height(), height);
    for (const PixelBox& strip : block.strips()) {
      EXPECT_LE(strip.left + strip.width, block.canvas()->width());
      EXPECT_LE(strip.top + strip.height, block.canvas()->height());
    }
  }
}

}  // namespace
}  // namespace carom
