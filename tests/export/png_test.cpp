#include "export/png.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cstring>

#include "export/export_testing.h"
#include "export/sheet.h"
#include "scene/scene.h"

namespace carom {
namespace {

using namespace testing_export;

/// Reads a PNG back with libpng's own simple reader.
Image decode(const std::string& bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  EXPECT_TRUE(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size())) << png.message;
  EXPECT_EQ(png.format, PNG_FORMAT_RGB);
  Image image{static_cast<int>(png.width), static_cast<int>(png.height), {}};
  image.pixels.resize(PNG_IMAGE_SIZE(png));
  EXPECT_TRUE(png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr)) << png.message;
  return image;
}

TEST(Png, ReadsBackPixelForPixel) {
  for (const Size size : {Size{1, 1}, Size{3, 2}, Size{64, 48}, Size{1279, 3}, Size{2, 701}})
    for (const PngEffort effort : {PngEffort::fast, PngEffort::small}) {
      const Image image = picture(size, 5);
      const Image back = decode(encode_png(image, effort));
      EXPECT_EQ(back.width, image.width);
      EXPECT_EQ(back.height, image.height);
      EXPECT_TRUE(back.pixels == image.pixels) << size.width << " x " << size.height;
    }
}

TEST(Png, KeepsTheOpacityOfEachPixel) {
  Image image = picture({5, 3}, 5);
  for (int i = 0; i < 15; ++i) image.alpha.push_back(static_cast<std::uint8_t>(17 * i));
  const std::string bytes = encode_png(image, PngEffort::small);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()));
  EXPECT_EQ(png.format, PNG_FORMAT_RGBA);
  std::vector<std::uint8_t> rgba(PNG_IMAGE_SIZE(png));
  ASSERT_TRUE(png_image_finish_read(&png, nullptr, rgba.data(), 0, nullptr));
  for (std::size_t i = 0; i < 15; ++i) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(rgba[4 * i + c], image.pixels[3 * i + c]);
    EXPECT_EQ(rgba[4 * i + 3], image.alpha[i]);
  }
}

TEST(Png, IsMarkedAsSrgb) {
  const std::string bytes = encode_png(picture({4, 4}, 0), PngEffort::fast);
  EXPECT_NE(bytes.find("sRGB"), std::string::npos);
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
}

TEST(Png, TheSamePictureGivesTheSameBytes) {
  const Image image = picture({320, 180}, 3);
  EXPECT_EQ(encode_png(image, PngEffort::fast), encode_png(image, PngEffort::fast));
}

TEST(Png, AnImageThatIsNoneIsRefused) {
  EXPECT_THROW(encode_png({0, 0, {}}, PngEffort::fast), ExportError);
  EXPECT_THROW(encode_png({2, 2, std::vector<std::uint8_t>(11)}, PngEffort::fast), ExportError);
  EXPECT_THROW(encode_png({2, 1, std::vector<std::uint8_t>(6), std::vector<std::uint8_t>(1)}, PngEffort::fast),
               ExportError);
  EXPECT_THROW(encode_png({-1, -1, std::vector<std::uint8_t>(3)}, PngEffort::fast), ExportError);
}

TEST(Frames, FrameIIsTickIAndKeepsItsNumber) {
  TempFolder temp;
  Scene scene = small_scene();
  scene.simulate.duration = 1;
  scene.output.frames = FramesOutput{10, {32, 18}, 1, 0.3, 0.5};
  run(scene, temp / "run");
  EXPECT_EQ(names_in(temp / "run"),
            (std::vector<std::string>{"frames", "frames/frame_00003.png", "frames/frame_00004.png",
                                      "frames/frame_00005.png", "manifest.json", "scene.yaml", "summary.csv"}));
  for (int i = 3; i <= 5; ++i)
    EXPECT_TRUE(decode(read(temp / "run/frames/frame_0000" + std::to_string(i) + ".png")).pixels ==
                picture({32, 18}, i).pixels);
}

TEST(Sheet, ShowsThePicturesInOrderWithGaps) {
  TempFolder temp;
  Scene scene = small_scene();
  scene.output.sheet = SheetOutput{3, 2};
  scene.output.frames = FramesOutput{10, {400, 300}, 1, 0, {}};
  Exports exports(scene, temp / "run");
  ASSERT_EQ(exports.pictures().size(), 2u);
  const Size size = exports.pictures()[1].size;
  EXPECT_EQ(size.width, 480);
  EXPECT_EQ(size.height, 360);  // the frames' shape
  play(scene, exports);
  exports.finish(some_summary(scene), {});
  const Image sheet = decode(read(temp / "run/sheet.png"));
  ASSERT_EQ(sheet.width, 3 * 480 + 4 * 8);
  ASSERT_EQ(sheet.height, 2 * 360 + 3 * 8);
  for (int number = 0; number < 6; ++number) {
    const Image one = picture(size, number);
    const int left = 8 + number % 3 * 488, top = 8 + number / 3 * 368;
    for (int y = 0; y < one.height; ++y)
      ASSERT_EQ(std::memcmp(sheet.row(top + y) + 3 * left, one.row(y), static_cast<std::size_t>(one.width) * 3), 0)
          << "picture " << number << ", row " << y;
  }
  for (const int x : {0, 7, 488, 495, 1471}) EXPECT_EQ(sheet.row(20)[3 * x], 24) << x;
  for (const int y : {0, 7, 368, 375, 743}) EXPECT_EQ(sheet.row(y)[3 * 20], 24) << y;
  EXPECT_EQ(exports.frames(), 3u);  // the sheet's pictures are no frames
}

TEST(Sheet, ManyColumnsStayWithinAScreensWidth) {
  TempFolder temp;
  Scene scene = small_scene();
  for (const int columns : {1, 4, 6, 20}) {
    scene.output.sheet = SheetOutput{columns, 1};
    const Exports exports(scene, temp / "run");
    EXPECT_LE(columns * (exports.pictures()[0].size.width + 8) + 8, 1920) << columns;
    EXPECT_EQ(exports.pictures()[0].samples, 4);
  }
}

TEST(Sheet, OneTooLargeIsRefusedBeforeAnythingIsWritten) {
  TempFolder temp;
  Scene scene = small_scene();
  for (const SheetOutput sheet :
       {SheetOutput{2'000'000'000, 2'000'000'000}, SheetOutput{1000, 1000}, SheetOutput{0, 1}}) {
    scene.output.sheet = sheet;
    EXPECT_THROW(Exports(scene, temp / "run"), ExportError);
  }
  EXPECT_FALSE(fs::exists(temp / "run"));
}

TEST(Frames, APictureThatIsTheLastOneAgainIsNotEncodedAgain) {
  TempFolder temp;
  Scene scene = small_scene();
  scene.output.frames = FramesOutput{20, {32, 18}, 1, 0, {}};
  Exports exports(scene, temp / "run");
  int number = 0;
  while (exports.timeline().advance()) {
    if (!exports.needs_state()) continue;
    // Another picture comes with the second one: it is not read, so it need not be encoded.
    exports.picture(0, picture({32, 18}, number), number == 1);
    ++number;
  }
  EXPECT_EQ(number, 5);
  const std::string first = read(temp / "run/frames/frame_00000.png");
  EXPECT_EQ(first, encode_png(picture({32, 18}, 0), PngEffort::fast));
  EXPECT_EQ(read(temp / "run/frames/frame_00001.png"), first);
  EXPECT_EQ(read(temp / "run/frames/frame_00002.png"), encode_png(picture({32, 18}, 2), PngEffort::fast));
}

TEST(Sheet, OfTransparentPicturesIsTransparentBetweenThem) {
  Sheet sheet({2, 1}, {48, 32});
  Image opaque{sheet.picture_size().width, sheet.picture_size().height, {}};
  const auto pixels = static_cast<std::size_t>(opaque.width * opaque.height);
  opaque.pixels.assign(3 * pixels, 200);
  Image clear = opaque;
  clear.alpha.assign(pixels, 99);
  sheet.put(0, clear);
  sheet.put(1, clear);
  const Image& whole = sheet.image();
  ASSERT_EQ(whole.alpha.size() * 3, whole.pixels.size());
  EXPECT_EQ(whole.alpha[0], 0);
  EXPECT_EQ(whole.alpha[static_cast<std::size_t>(8 * whole.width + 8)], 99);
  Sheet plain({2, 1}, {48, 32});
  plain.put(0, opaque);
  EXPECT_TRUE(plain.image().alpha.empty());
}

TEST(Film, OfTransparentPicturesIsRefusedBeforeTheFolderIsChanged) {
  TempFolder temp;
  Scene scene = small_scene();
  scene.transparent = true;
  scene.output.video.emplace();
  EXPECT_EQ(error_of([&] { Exports(scene, temp / "run"); }),
            "cannot make animation.mp4: a film has no transparency, and `background` is `none`; write frames, or give "
            "the background a colour");
  EXPECT_EQ(names_in(temp.path()), std::vector<std::string>());
}

}  // namespace
}  // namespace carom
