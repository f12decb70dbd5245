// Motion blur: the instants of a picture, and the mean of its drawings.
#include "overlay/shutter.h"

#include "overlay/light_mean.h"
#include "scene/scenes_in_text.h"
#include "std.h"

namespace carom {
namespace {

double linear(int byte) {
  const double x = byte / 255.0;
  return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4);
}

int encoded(double light) {
  return static_cast<int>(
      std::lround(255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1 / 2.4) - 0.055)));
}

TEST(LightMean, IsThatOfLinearLight) {
  LightMean mean;
  for (int a = 0; a < 256; a += 5) {
    for (const int b : {0, 3, 128, 255}) {
      const auto byte = [](int value) { return static_cast<uint8_t>(value); };
      mean.add({1, 1, {byte(a), byte(b), byte(a)}});
      mean.add({1, 1, {byte(b), byte(b), byte(a)}});
      const Image& image = mean.take();
      EXPECT_NEAR(image.pixels[0], encoded((linear(a) + linear(b)) / 2), 1) << a << ", " << b;
      EXPECT_EQ(image.pixels[1], b);
      EXPECT_EQ(image.pixels[2], a);
    }
  }
}

TEST(LightMean, OfBlackAndWhiteIs188) {
  LightMean mean;
  mean.add({1, 1, {0, 0, 0}});
  mean.add({1, 1, {255, 255, 255}});
  EXPECT_EQ(mean.take().pixels[0], 188);
}

TEST(LightMean, WeighsColoursByTheirOpacity) {
  LightMean mean;
  mean.add({1, 1, {200, 10, 0, 255}, 4});
  mean.add({1, 1, {0, 0, 0, 0}, 4});
  EXPECT_EQ(mean.take().pixels, (vector<uint8_t>{200, 10, 0, 128}));
}

TEST(Shutter, OpensForAPartOfTheIntervalUntilThePicture) {
  Shutter shutter(0.25);
  shutter.aim(1);
  EXPECT_EQ(shutter.next(), 0.75);
  EXPECT_TRUE(shutter.opens());
  shutter.open_for(4);
  vector<double> instants;
  for (; isfinite(shutter.next()); shutter.pass()) instants.push_back(shutter.next());
  // The fourth is the picture's own time.
  EXPECT_EQ(instants, (vector<double>{0.8125, 0.875, 0.9375}));
}

TEST(Shutter, OfOneInstantIsThePicturesOwn) {
  Shutter shutter(0.25);
  shutter.aim(1);
  shutter.open_for(1);
  EXPECT_EQ(shutter.next(), infinity);
}

TEST(Shutter, DoesNotOpenBeforeTheStartOrThePictureBefore) {
  Shutter shutter(0.25);
  shutter.aim(0);
  EXPECT_EQ(shutter.next(), infinity);
  shutter.aim(0.1);
  EXPECT_EQ(shutter.next(), 0);
  shutter.aim(0.3);
  EXPECT_EQ(shutter.next(), 0.1);
}

TEST(Shutter, OfASlowerFilmOpensForLess) {
  Shutter shutter(0.25);
  shutter.aim(1, 0.125);
  EXPECT_EQ(shutter.next(), 1 - 0.03125);
}

TEST(Shutter, ThatIsNotUsedHasNoInstants) {
  EXPECT_FALSE(Shutter(0).is_used());
  EXPECT_EQ(Shutter(0).next(), infinity);
}

TEST(Exposures, AreOneForEachPixelOfMotion) {
  Scene scene = load_text(
      "scene: 1\nsimulate: {duration: 1}\ncamera: {eye: [0, 0, 10], target: [0, 0, 0], fov: 90, near: 1}\n"
      "balls: {red: {mass: 1, radius: 0.1, position: [0, 0, 0]}}\n");
  // 20 m are 100 pixels high.
  const Eye eye(*scene.camera, {200, 100});
  const auto exposures = [&](const Vec3& x, const Vec3& v) {
    scene.initial.position[0] = x;
    scene.initial.velocity[0] = v;
    return exposures_of(scene, scene.initial, 0.1, eye, eye);
  };
  EXPECT_EQ(exposures({0, 0, 0}, {0, 0, 0}), 1);
  EXPECT_EQ(exposures({0, 0, 0}, {1.9, 0, 0}), 1);   // 0.95 pixels
  EXPECT_EQ(exposures({0, 0, 0}, {0, 14.2, 0}), 8);  // 7.1 pixels
  EXPECT_EQ(exposures({0, 0, 0}, {500, 0, 0}), most_exposures);
  EXPECT_EQ(exposures({90, 0, 0}, {500, 0, 0}), 1);  // outside of the picture
  EXPECT_EQ(exposures({0, 0, 20}, {500, 0, 0}), 1);  // behind the camera
}

}  // namespace
}  // namespace carom
