// The conversion to yuv420p against the formulas in exact arithmetic.
#include "export/yuv.h"
#include "std.h"

#include <gtest/gtest.h>

#include <random>

namespace carom {
namespace {

using Planes = vector<uint8_t>;

/// floor(a / b), b > 0.
int64_t quotient(int64_t a, int64_t b) {
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}

// The formulas of yuv.h in whole numbers: 0.2126 is 2126/10,000. Halves go upwards.
int64_t exact_luma(int64_t r, int64_t g, int64_t b) {
  const int64_t light = 2126 * r + 7152 * g + 722 * b, denominator = 255 * 10'000;
  return 16 + quotient(2 * 219 * light + denominator, 2 * denominator);
}
/// Of sums of `n` pixels. `weight`: of the channel in luma.
int64_t exact_chroma(int64_t channel, int64_t r, int64_t g, int64_t b, int64_t weight, int64_t n) {
  const int64_t difference = 10'000 * channel - (2126 * r + 7152 * g + 722 * b);
  const int64_t denominator = 255 * 2 * (10'000 - weight) * n;
  return 128 + quotient(2 * 224 * difference + denominator, 2 * denominator);
}

Planes planes_of(const Image& image) {
  Planes planes;
  to_yuv420p(image, planes);
  return planes;
}

TEST(Yuv, LumaOfEveryColourIsTheExactOneRounded) {
  Image image{256, 256, {}};
  Planes planes;
  for (int r = 0; r < 256; ++r) {
    image.pixels.clear();
    for (int g = 0; g < 256; ++g)
      for (int b = 0; b < 256; ++b)
        for (const int c : {r, g, b}) image.pixels.push_back(static_cast<uint8_t>(c));

    to_yuv420p(image, planes);
    size_t wrong = 0;
    for (int g = 0; g < 256; ++g)
      for (int b = 0; b < 256; ++b) wrong += planes[static_cast<size_t>(256 * g + b)] != exact_luma(r, g, b);
    ASSERT_EQ(wrong, 0U) << "red " << r;
  }
}

TEST(Yuv, ChromaIsThatOfTheMeanOfFourPixelsRoundedOnce) {
  std::mt19937 random(1);
  const int side = 512;
  Image image{side, side, {}};
  for (int i = 0; i < side * side * 3; ++i)
    // Extreme values, too, so that the largest and the smallest results occur.
    image.pixels.push_back(static_cast<uint8_t>(random() % 3 == 0 ? 255 * (random() % 2) : random() % 256));

  const Planes planes = planes_of(image);
  const uint8_t* const u = planes.data() + side * side;
  const uint8_t* const v = u + side * side / 4;

  for (int y = 0; y < side / 2; ++y)
    for (int x = 0; x < side / 2; ++x) {
      array<int64_t, 3> sum{};
      for (const int dy : {0, 1})
        for (const int dx : {0, 1})
          for (int c = 0; c < 3; ++c) sum[static_cast<size_t>(c)] += image.row(2 * y + dy)[3 * (2 * x + dx) + c];

      const auto [r, g, b] = sum;
      ASSERT_EQ(u[side / 2 * y + x], exact_chroma(b, r, g, b, 722, 4)) << x << ", " << y;
      ASSERT_EQ(v[side / 2 * y + x], exact_chroma(r, r, g, b, 2126, 4)) << x << ", " << y;
    }
}

Image of_one_colour(int width, int height, array<int, 3> colour) {
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i)
    for (const int c : colour) image.pixels.push_back(static_cast<uint8_t>(c));
  return image;
}

TEST(Yuv, PrimariesHaveTheValuesOfTheStandard) {
  // ITU-R BT.709-6, 3.2 to 3.5, for 8 bits: by hand.
  struct Row {
    array<int, 3> rgb, yuv;
  };
  for (const Row& row :
       {Row{{0, 0, 0}, {16, 128, 128}}, Row{{255, 255, 255}, {235, 128, 128}}, Row{{255, 0, 0}, {63, 102, 240}},
        Row{{0, 255, 0}, {173, 42, 26}}, Row{{0, 0, 255}, {32, 240, 118}}, Row{{128, 128, 128}, {126, 128, 128}}}) {
    const Planes planes = planes_of(of_one_colour(2, 2, row.rgb));
    EXPECT_EQ(planes, (Planes{static_cast<uint8_t>(row.yuv[0]), static_cast<uint8_t>(row.yuv[0]),
                              static_cast<uint8_t>(row.yuv[0]), static_cast<uint8_t>(row.yuv[0]),
                              static_cast<uint8_t>(row.yuv[1]), static_cast<uint8_t>(row.yuv[2])}))
        << row.rgb[0] << " " << row.rgb[1] << " " << row.rgb[2];
  }
}

TEST(Yuv, AnOddSideRepeatsItsLastPixel) {
  Image odd{3, 3, {}}, even{4, 4, {}};
  const auto value = [](int x, int y, int c) { return static_cast<uint8_t>(50 * x + 20 * y + 7 * c); };
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x)
      for (int c = 0; c < 3; ++c) odd.pixels.push_back(value(x, y, c));
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      for (int c = 0; c < 3; ++c) even.pixels.push_back(value(std::min(x, 2), std::min(y, 2), c));
  EXPECT_EQ(planes_of(odd), planes_of(even));
  EXPECT_EQ(planes_of(of_one_colour(1, 1, {9, 99, 199})), planes_of(of_one_colour(2, 2, {9, 99, 199})));
}

TEST(Yuv, APictureWithOpacityIsShownOnBlack) {
  Image clear = of_one_colour(4, 2, {0, 0, 0});
  Image image{4, 2, {}, 4};
  const array<int, 4> opacities = {0, 51, 128, 255};
  for (int i = 0; i < 8; ++i) {
    const int opacity = opacities[static_cast<size_t>(i % 4)];
    for (const int c : {200, 100, 50}) image.pixels.push_back(static_cast<uint8_t>(c));
    image.pixels.push_back(static_cast<uint8_t>(opacity));
    for (int c = 0; c < 3; ++c)
      clear.pixels[static_cast<size_t>(3 * i + c)] =
          static_cast<uint8_t>(std::lround(array{200, 100, 50}[static_cast<size_t>(c)] * opacity / 255.0));
  }
  EXPECT_EQ(planes_of(image), planes_of(clear));
}

}  // namespace
}  // namespace carom
