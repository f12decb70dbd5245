#include "export/png.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cstring>
#include <random>

#include "export/export_testing.h"
#include "export/frame_files.h"
#include "export/picture_streams.h"
#include "export/sheet.h"
#include "files/hash.h"
#include "processor.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

using namespace testing_export;

/// Reads a PNG back with libpng's own simple reader.
Image decode(const string& bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  EXPECT_TRUE(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size())) << png.message;
  EXPECT_TRUE(png.format == PNG_FORMAT_RGB || png.format == PNG_FORMAT_RGBA);
  Image image{static_cast<int>(png.width), static_cast<int>(png.height), {}, png.format == PNG_FORMAT_RGBA ? 4 : 3};
  image.pixels.resize(PNG_IMAGE_SIZE(png));
  EXPECT_TRUE(png_image_finish_read(&png, nullptr, image.pixels.data(), 0, nullptr)) << png.message;
  return image;
}

/// The picture with an opacity that goes from 0 to 255 from left to right.
Image with_opacity(const Image& rgb) {
  Image image{rgb.width, rgb.height, {}, 4};
  for (size_t i = 0; i < rgb.pixels.size(); i += 3) {
    image.pixels.insert(image.pixels.end(), rgb.pixels.begin() + static_cast<ptrdiff_t>(i),
                        rgb.pixels.begin() + static_cast<ptrdiff_t>(i) + 3);
    image.pixels.push_back(static_cast<uint8_t>(i / 3 % static_cast<size_t>(rgb.width) * 255 /
                                                static_cast<size_t>(std::max(rgb.width - 1, 1))));
  }
  return image;
}

TEST(Png, ReadsBackPixelForPixelWithAndWithoutOpacity) {
  for (const Size size : {Size{1, 1}, Size{3, 2}, Size{64, 48}, Size{1279, 3}, Size{2, 701}})
    for (const Image& image : {picture(size, 5), with_opacity(picture(size, 5))}) {
      const Image back = decode(encode_png(image));
      EXPECT_EQ(back.width, image.width);
      EXPECT_EQ(back.height, image.height);
      EXPECT_EQ(back.channels, image.channels);
      EXPECT_TRUE(back.pixels == image.pixels) << size.width << " x " << size.height;
    }
}

/// A picture that cannot be compressed.
Image noise(Size size) {
  Image image{size.width, size.height, {}};
  std::mt19937 random(7);
  image.pixels.resize(static_cast<size_t>(size.height) * image.row_size());
  for (uint8_t& value : image.pixels) value = static_cast<uint8_t>(random());
  return image;
}

TEST(Png, OfNoiseReadsBackAndGrowsByLittle) {
  // 21845 pixels are 65535 bytes, as many as a stored block can have.
  for (const Size size : {Size{1, 1}, Size{5, 1}, Size{300, 72}, Size{21'844, 1}, Size{21'845, 1}, Size{640, 360}}) {
    const Image image = noise(size);
    const string bytes = encode_png(image);
    EXPECT_TRUE(decode(bytes).pixels == image.pixels) << size.width << " x " << size.height;
    EXPECT_LT(bytes.size(), 1.01 * static_cast<double>(image.pixels.size()) + 100)
        << size.width << " x " << size.height;
  }
}

TEST(Png, IsMarkedAsSrgb) {
  const string bytes = encode_png(picture({4, 4}, 0));
  EXPECT_NE(bytes.find("sRGB"), string::npos);
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
}

TEST(Png, AnEncoderIsUsedAgainForPicturesOfOtherSizes) {
  PngEncoder encoder;
  for (const Size size : {Size{320, 180}, Size{5, 7}, Size{320, 180}}) {
    encoder.take(picture(size, 3));
    EXPECT_EQ(encoder.encode(), encode_png(picture(size, 3)));
    EXPECT_EQ(encoder.file(), encode_png(picture(size, 3)));
    encoder.take(noise({64, 48}));  // less than the memory that a larger picture has left
    EXPECT_EQ(encoder.encode(), encode_png(noise({64, 48})));
  }
}

TEST(Png, HasTheSameBytesOnEveryProcessorWithSse42) {
  if (!packs_by_sse42()) GTEST_SKIP() << "another processor";
  EXPECT_EQ(sha256(encode_png(picture({640, 360}, 3))),
            "98a85237bc0fdc5443cf26e456f08f1e4cf53e0e2711f3fb53b75a1d664c6888");
  EXPECT_EQ(sha256(encode_png(with_opacity(picture({640, 360}, 3)))),
            "152f44c76b418777546cd02b972ff4a36d622eef39a2dc18fc93a6025960ba36");
}

/// Leaves such numbers where the next calls have their variables.
[[gnu::noinline]] void fill_stack(uint32_t number) {
  volatile uint32_t numbers[65536];
  for (volatile uint32_t& place : numbers) place = number;
}

TEST(Png, HasTheSameBytesWhateverMemoryHeld) {
  const Image image = picture({48, 32}, 3);
  const string bytes = encode_png(image);
  for (uint32_t bits = 1; bits < 15; ++bits) {
    fill_stack(bits << 16 | bits);
    EXPECT_EQ(encode_png(image), bytes) << bits;
  }
}

/// The bytes of the picture, encoded so many times 64 KiB further down the stack.
[[gnu::noinline]] string encoded_below(const Image& image, int depth) {
  volatile char room[65536];
  room[0] = 0;
  return depth == room[0] ? encode_png(image) : encoded_below(image, depth - 1);
}

TEST(Png, HasTheSameBytesWhereverTheStackIs) {
  for (int width = 6; width < 10; ++width) {
    Image image{width, 1, {}};
    image.pixels.assign(image.row_size(), 0);
    for (size_t i = 2; i < image.pixels.size(); i += 5) image.pixels[i] = 128;
    const string bytes = encode_png(image);
    for (int depth = 0; depth < 64; ++depth) EXPECT_EQ(encoded_below(image, depth), bytes) << width << ", " << depth;
  }
}

TEST(Png, AnImageThatIsNoneIsRefused) {
  EXPECT_THROW(encode_png({0, 0, {}}), ExportError);
  EXPECT_THROW(encode_png({2, 2, vector<uint8_t>(11)}), ExportError);
  EXPECT_THROW(encode_png({-1, -1, vector<uint8_t>(3)}), ExportError);
  EXPECT_THROW(encode_png({1, 1, vector<uint8_t>(2), 2}), ExportError);
}

TEST(Frames, FrameIIsTickIAndKeepsItsNumber) {
  TempFolder temp;
  Scene scene = small_scene();
  scene.simulate.duration = 1;
  scene.output.frames = FramesOutput{10, {32, 18}, 1, 0.3, 0.5};
  run(scene, temp / "run");
  EXPECT_EQ(names_in(temp / "run"),
            (vector<string>{"frames", "frames/frame_00003.png", "frames/frame_00004.png", "frames/frame_00005.png",
                            "manifest.json", "scene.yaml", "summary.csv"}));
  for (int i = 3; i <= 5; ++i)
    EXPECT_TRUE(decode(read(temp / "run/frames/frame_0000" + to_string(i) + ".png")).pixels ==
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
      ASSERT_EQ(std::memcmp(sheet.row(top + y) + 3 * left, one.row(y), static_cast<size_t>(one.width) * 3), 0)
          << "picture " << number << ", row " << y;
  }

  // Between them is the ground.
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

TEST(Sheet, OfAGivenSizeHasThatSizeAndFillsIt) {
  TempFolder temp;
  Scene scene = small_scene();
  scene.output.sheet = SheetOutput{3, 2, Size{1000, 500}, 0.05, 0.15};
  Exports exports(scene, temp / "run");
  const Size size = exports.pictures()[0].size;
  EXPECT_EQ(size.width, (1000 - 4 * 8) / 3);
  EXPECT_EQ(size.height, (500 - 3 * 8) / 2);
  play(scene, exports);
  exports.finish(some_summary(scene), {});
  const Image sheet = decode(read(temp / "run/sheet.png"));
  EXPECT_EQ(sheet.width, 1000);
  EXPECT_EQ(sheet.height, 500);
  const Image last = picture(size, 5);
  // 1000 leaves 2 pixels over, one for each side.
  const int left = 9 + 2 * (size.width + 8), top = 8 + size.height + 8;
  EXPECT_EQ(std::memcmp(sheet.row(top) + 3 * left, last.row(0), last.row_size()), 0);
}

TEST(Sheet, ShowsItsOwnWindow) {
  Scene scene = small_scene();
  scene.output.sheet = SheetOutput{3, 1, {}, 0.05, 0.15};
  scene.output.frames = FramesOutput{10, {32, 18}, 1, 0.1, 0.1};
  const Ticks ticks = plan_pictures(scene).ticks[1];
  EXPECT_EQ(ticks.at(0), 0.05);
  EXPECT_EQ(ticks.at(1), 0.1);
  EXPECT_EQ(ticks.at(2), 0.15);
}

TEST(Sheet, OneTooLargeIsRefusedBeforeAnythingIsWritten) {
  TempFolder temp;
  Scene scene = small_scene();
  for (const SheetOutput sheet : {SheetOutput{2'000'000'000, 2'000'000'000}, SheetOutput{1000, 1000}, SheetOutput{0, 1},
                                  SheetOutput{40, 2, Size{1280, 720}, 0, {}}}) {
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
  exports.begin_drawings();
  Timeline& timeline = exports.drawings().timeline();
  while (timeline.advance()) {
    if (!timeline.due(exports.pictures()[0].timeline_stream)) continue;
    // Another picture comes with the second one: it is not read, so it need not be encoded.
    exports.picture(0, picture({32, 18}, number), number == 1);
    ++number;
  }
  EXPECT_EQ(number, 5);
  exports.finish(some_summary(scene), {});
  const string first = read(temp / "run/frames/frame_00000.png");
  EXPECT_EQ(first, encode_png(picture({32, 18}, 0)));
  EXPECT_EQ(read(temp / "run/frames/frame_00001.png"), first);
  EXPECT_EQ(read(temp / "run/frames/frame_00002.png"), encode_png(picture({32, 18}, 2)));
}

/// Writes 40 frames with so many threads, and gives the records.
vector<FileRecord> frames_by(size_t threads, const string& path) {
  FolderWriter folder(path, Durability::deferred);
  FrameFiles frames(folder, threads);
  for (int i = 0; i < 40; ++i) frames.put(i, picture({64, 36}, i / 3), i % 3 > 0);
  frames.finish();
  folder.keep();
  return frames.records();
}

TEST(Frames, AnyNumberOfThreadsWritesTheSameFiles) {
  TempFolder temp;
  const vector<FileRecord> one = frames_by(1, temp / "one");
  ASSERT_EQ(one.size(), 40U);

  for (const size_t threads : {2U, 5U}) {
    const string path = temp / to_string(threads);
    const vector<FileRecord> several = frames_by(threads, path);
    ASSERT_EQ(several.size(), one.size());
    for (size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(several[i].name, one[i].name);
      EXPECT_EQ(several[i].sha256, one[i].sha256);
      EXPECT_EQ(read(path + "/" + one[i].name), read(temp / "one/" + one[i].name));
    }
  }
}

TEST(Frames, AFrameThatCannotBeWrittenIsNamedWhateverTheThreads) {
  for (const size_t threads : {1U, 4U}) {
    TempFolder temp;
    fs::create_directories(temp / "run/frames/frame_00007.png/in_the_way");
    FolderWriter folder(temp / "run", Durability::deferred);
    const string error = error_of([&] {
      FrameFiles frames(folder, threads);
      for (int i = 0; i < 40; ++i) frames.put(i, picture({64, 36}, i), false);
      frames.finish();
    });
    EXPECT_TRUE(error.starts_with("cannot write " + (temp / "run/frames/frame_00007.png") + ": ")) << error;
    for (const string& name : names_in(temp / "run")) EXPECT_EQ(name.find(".part"), string::npos) << name;
    // All frames before it are there, and whole.
    for (int i = 0; i < 7; ++i)
      EXPECT_TRUE(decode(read(temp / "run/" + frame_files.folder.data() + ("/" + frame_files.name(i)))).pixels ==
                  picture({64, 36}, i).pixels);
  }
}

TEST(Sheet, OfTransparentPicturesIsTransparentBetweenThem) {
  Sheet sheet({2, 1}, {48, 32});
  Image clear{sheet.picture_size().width, sheet.picture_size().height, {}, 4};
  clear.pixels.assign(static_cast<size_t>(clear.height) * clear.row_size(), 99);
  sheet.put(0, clear);
  sheet.put(1, clear);
  const Image& whole = sheet.image();
  ASSERT_EQ(whole.channels, 4);
  EXPECT_EQ(whole.row(0)[3], 0);
  EXPECT_EQ(whole.row(8)[4 * 8 + 3], 99);
}

TEST(Film, OfTransparentPicturesIsNoMp4) {
  TempFolder temp;
  Scene scene = small_scene();
  scene.background.transparent = true;
  scene.output.video.emplace();
  EXPECT_EQ(error_of([&] { Exports(scene, temp / "run"); }),
            "cannot make animation.mp4: an MP4 has no transparency, and `background` is `none`; write frames, a .gif "
            "or a .webp, or give the background a colour");
  EXPECT_EQ(names_in(temp.path()), vector<string>());
  scene.output.video->file = "animation.webp";
  EXPECT_NO_THROW(plan_pictures(scene));
}

TEST(PictureStreams, OfFramesAndASlowFilmAreOneUnlessTheirFlashesDiffer) {
  Scene scene = small_scene();
  scene.simulate.duration = 1;
  scene.output.frames.emplace().fps = 240;
  scene.output.video.emplace().speed = 0.125;  // at 30 a second: the same times
  EXPECT_EQ(plan_pictures(scene).streams.size(), 1U);

  scene.overlay.shutter = 0.5;
  EXPECT_EQ(plan_pictures(scene).streams.size(), 1U);

  scene.overlay.flash = true;
  const PictureStreams plan = plan_pictures(scene);
  ASSERT_EQ(plan.streams.size(), 2U);
  EXPECT_EQ(plan.streams[0].interval, 1.0 / 240);
  EXPECT_EQ(plan.streams[1].interval, 0.125 / 30);
  EXPECT_EQ(plan.streams[1].clock.speed(), 0.125);
}

}  // namespace
}  // namespace carom
