// The renderer: equal bytes, refused sizes, several renderers at a time.
#include "render/renderer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "paths.h"
#include "render/camera.h"
#include "render/scenes.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

uint64_t hash_of(const Image& image) {  // FNV-1a
  uint64_t hash = 14695981039346656037U;
  for (uint8_t byte : image.pixels) hash = (hash ^ byte) * 1099511628211U;
  return hash;
}

Image drawn(const Scene& scene, Size size, int samples = 4) {
  Renderer renderer(scene, size, samples);
  return renderer.draw(scene.initial);
}

TEST(Bytes, AreTheSameAtEveryDraw) {
  const Scene scene = test::gas(60);
  Renderer renderer(scene, {320, 180}, 4);
  const uint64_t first = hash_of(renderer.draw(scene.initial));
  State moved = scene.initial;
  for (Vec3& p : moved.position) p.y() += 0.5;
  EXPECT_NE(hash_of(renderer.draw(moved)), first);
  EXPECT_EQ(hash_of(renderer.draw(scene.initial)), first);
  EXPECT_EQ(hash_of(drawn(scene, {320, 180})), first);
}

TEST(Bytes, LeaveNothingToTheNextPicture) {
  // Between two equal pictures come others with everything that may be left behind.
  Scene scene = test::gas(200);
  for (int i = 0; i < 5; ++i)
    test::add_body(scene, Vec3(i - 2, 1, 0), i % 2 ? Volume::box(Vec3(1, 0.7, 0.5)) : Volume::cylinder(0.4, 1),
                   test::red);
  scene.roster.bodies.back().mesh = MeshUse{SCENES_DIR "/meshes/duck.obj", Vec3(0, 0.5, 0), 0.7};

  Renderer renderer(scene, {320, 180}, 4);
  const uint64_t first = hash_of(renderer.draw(scene.initial));

  Drawing drawing;
  drawing.camera = camera_of(scene);
  drawing.camera.eye += Vec3(1, 1, -1);
  drawing.body_colors.assign(205, test::blue);
  drawing.glow.assign(205, 1);
  drawing.strokes.push_back({Vec3(-3, -3, 0), Vec3(3, 3, 0), 0.1, 0.2, 1, test::green, 1, 0.5});

  State moved = scene.initial;
  for (Vec3& p : moved.position) p.y() += 0.7;

  EXPECT_NE(hash_of(renderer.draw(moved, drawing)), first);
  EXPECT_EQ(hash_of(renderer.draw(scene.initial)), first);
}

TEST(Strokes, AreSeenWhereTheyAreAndHiddenBehindBodies) {
  Scene scene = test::flat_scene(Vec3(0, 0, 5), Vec3::Zero());
  test::add_ball(scene, Vec3::Zero(), 0.5, test::red);
  Drawing drawing;
  drawing.camera = camera_of(scene);
  // One behind the ball, 0.2 m wide, and one before it, a pixel wide.
  drawing.strokes.push_back({Vec3(-2, 0, -1), Vec3(2, 0, -1), 0.1, 0.1, 1, test::green, 1, 1});
  drawing.strokes.push_back({Vec3(0, -2, 1), Vec3(0, 2, 1), 0, 0, 1, test::blue, 1, 1});
  Renderer renderer(scene, {201, 201}, 4);
  const Image& image = renderer.draw(scene.initial, drawing);
  const auto channel = [&](int x, int y, int c) { return int{image.row(y)[3 * x + c]}; };
  EXPECT_EQ(channel(20, 100, 1), 255);
  EXPECT_LT(channel(85, 100, 1), 100);   // behind the ball
  EXPECT_EQ(channel(100, 100, 2), 255);  // before it
  EXPECT_EQ(channel(100, 20, 2), 255);
  EXPECT_EQ(channel(103, 20, 2), 0);
  // 0.2 m at a distance of 6 m.
  int wide = 0;
  for (int y = 0; y < 201; ++y) wide += channel(20, y, 1) > 128;
  EXPECT_NEAR(wide, 0.2 / 6 * 100.5 / std::tan(22.5 * M_PI / 180), 1);
}

TEST(Strokes, ThatAreJoinedAreAsOpaqueAtTheirJointsAsBetweenThem) {
  Scene scene = test::flat_scene(Vec3(0, 0, 5), Vec3::Zero());
  Drawing drawing;
  drawing.camera = camera_of(scene);
  // Of one colour, then of a colour that changes.
  for (const Color& end : {test::green, Color{0, 0.9, 0}}) {
    drawing.strokes.clear();
    drawing.strokes.push_back({Vec3(-2, 0, 0), Vec3(0, 0, 0), 0.2, 0.2, 1, test::green, 0.5, 0.5});
    drawing.strokes.push_back({Vec3(0, 0, 0), Vec3(2, 0, 0), 0.2, 0.2, 1, end, 0.5, 0.5});
    Renderer renderer(scene, {201, 201}, 4);
    const Image& image = renderer.draw(scene.initial, drawing);
    const auto light = [&](int x) { return int{image.row(100)[3 * x + 1]}; };
    EXPECT_GT(light(60), 150);
    for (int x = 60; x <= 140; ++x) EXPECT_TRUE(light(x) == light(60) || light(x) == light(140)) << x;
  }
}

TEST(Bytes, WhatIsAsInTheLastPictureIsNotDrawnAgain) {
  Scene scene = test::gas(60);
  test::add_body(scene, Vec3(0, 0, 0), Volume::box(Vec3(1, 0.7, 0.5)), {0.8, 0.2, 0.5});
  Renderer renderer(scene, {320, 180}, 4);
  const uint64_t first = hash_of(renderer.draw(scene.initial));
  EXPECT_EQ(renderer.drawn(), 1U);
  State later = scene.initial;
  later.time = 1;
  for (Vec3& v : later.velocity) v.x() += 1;
  EXPECT_EQ(hash_of(renderer.draw(later)), first);
  EXPECT_EQ(renderer.drawn(), 1U);
  // Any body that moves, and however little.
  for (size_t i = 0; i < later.position.size(); ++i) {
    later.position[i].x() += 1e-12;
    renderer.draw(later);
    EXPECT_EQ(renderer.drawn(), 2 + i);
  }
  // One that has become part of another.
  later.part_of.resize(later.position.size());
  for (size_t i = 0; i < later.part_of.size(); ++i) later.part_of[i] = static_cast<Entity>(i);
  const uint64_t before = renderer.drawn();
  renderer.draw(later);
  EXPECT_EQ(renderer.drawn(), before);
  later.part_of.back() = 0;
  renderer.draw(later);
  EXPECT_EQ(renderer.drawn(), before + 1);
}

/// A helper: prints a picture's hash for the test below, which runs it in separate processes.
TEST(Bytes, Probe) {
  if (!std::getenv("CAROM_PRINT_HASH")) return;  // set only by the test below
  Scene scene = test::gas(60);
  for (int i = 0; i < 9; ++i)
    test::add_body(scene, Vec3(i - 4, 0.3 * i - 1, 0),
                   i % 2 ? Volume::box(Vec3(1, 0.7, 0.5)) : Volume::cylinder(0.4, 1), {0.8, 0.2, 0.5});
  scene.roster.bodies.back().mesh = MeshUse{SCENES_DIR "/meshes/duck.obj", Vec3(0, 0.5, 0), 0.7};
  std::printf("hash=%016llx\n", static_cast<unsigned long long>(hash_of(drawn(scene, {320, 180}))));
}

string hash_with_threads(const char* threads) {
  array<char, 4096> program{};
  if (readlink("/proc/self/exe", program.data(), program.size() - 1) < 0) return {};
  const string command = string("CAROM_PRINT_HASH=1 LP_NUM_THREADS=") + threads + " '" + program.data() +
                         "' --gtest_filter=Bytes.Probe 2>/dev/null";
  string text;
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return {};
  for (int c; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
  pclose(pipe);
  const size_t at = text.find("hash=");
  return at == string::npos ? string() : text.substr(at, 21);
}

TEST(Bytes, AreTheSameForAnyNumberOfThreads) {
  const string none = hash_with_threads("0");
  ASSERT_EQ(none.size(), 21U);
  EXPECT_EQ(hash_with_threads("1"), none);
  EXPECT_EQ(hash_with_threads("2"), none);
  EXPECT_EQ(hash_with_threads("7"), none);
}

TEST(Size, BeyondWhatCanBeDrawnIsRefused) {
  const Scene scene;
  for (const Size size : {Size{16385, 1}, Size{1, 16385}, Size{1000000000, 1}, Size{0, 5}, Size{5, -1}}) {
    try {
      Renderer renderer(scene, size, 4);
      ADD_FAILURE() << size.width << " x " << size.height;
    } catch (const RenderError& error) {
      EXPECT_EQ(string(error.what()), "a picture of " + to_string(size.width) + " x " + to_string(size.height) +
                                          " pixels cannot be drawn: each side can be 1 to 16384");
    }
  }
  EXPECT_THROW(Renderer(scene, {4, 4}, 0), RenderError);
}

TEST(Size, TheLongestSideIsPaintedToItsEnd) {
  Scene scene;
  scene.background.color = Color{1, 1, 1};
  for (const Size size : {Size{16384, 2}, Size{2, 16384}, Size{1, 1}}) {
    const Image image = drawn(scene, size);
    EXPECT_EQ(image.width, size.width);
    EXPECT_EQ(image.pixels.size(), 3U * static_cast<unsigned>(size.width) * static_cast<unsigned>(size.height));
    EXPECT_EQ(image.pixels.front(), 255);
    EXPECT_EQ(image.pixels.back(), 255);
  }
}

TEST(Renderers, OfDifferentSizesTakeTurns) {
  const Scene gas = test::gas(20), balls = test::bowling_balls();
  const uint64_t small_alone = hash_of(drawn(gas, {64, 48})), large_alone = hash_of(drawn(balls, {200, 100}));
  Renderer small(gas, {64, 48}, 4);
  auto large = make_unique<Renderer>(balls, Size{200, 100}, 4);
  EXPECT_EQ(hash_of(small.draw(gas.initial)), small_alone);
  EXPECT_EQ(hash_of(large->draw(balls.initial)), large_alone);
  EXPECT_EQ(hash_of(small.draw(gas.initial)), small_alone);
  large.reset();
  EXPECT_EQ(hash_of(small.draw(gas.initial)), small_alone);
}

TEST(Scenes, OfNothingAndOfExtremesAreDrawn) {
  Scene empty;
  EXPECT_EQ(drawn(empty, {32, 32}).pixels.size(), 3072U);
  for (double scale : {1e-6, 1.0, 1e6}) {  // the same scene in other units gives nearly the same picture
    Scene scene;
    test::add_ball(scene, Vec3(0, 2 * scale, 0), 0.5 * scale, {1, 0, 0});
    test::add_plane(scene, Vec3::Zero(), Vec3(0, 1, 0), {0.5, 0.5, 0.5});
    const Image image = drawn(scene, {100, 100});
    int red = 0;
    for (int i = 0; i < 10000; ++i)
      if (image.pixels[3U * static_cast<unsigned>(i)] > 2 * image.pixels[3U * static_cast<unsigned>(i) + 1]) ++red;
    EXPECT_NEAR(red, 1000, 600) << scale;
  }
}

TEST(Scenes, FarFromTheOriginLookTheSame) {
  // Camera and bodies 1e7 m away, where float steps by a metre: the disc must not move by a pixel.
  Scene near_scene;
  test::add_ball(near_scene, Vec3(0.3, 0.2, 0), 0.5, {1, 1, 1});
  Scene far_scene = near_scene;
  const Vec3 shift(1e7, 0, -1e7);
  far_scene.initial.position[0] += shift;
  const Image a = drawn(near_scene, {120, 90}), b = drawn(far_scene, {120, 90});
  int worst = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) worst = std::max(worst, std::abs(a.pixels[i] - b.pixels[i]));
  EXPECT_LE(worst, 2);  // measured: 1
}

TEST(Scenes, ThousandsOfBallsAreDrawn) {
  const Scene scene = test::gas(3000);
  EXPECT_EQ(drawn(scene, {320, 180}).width, 320);
}

}  // namespace
}  // namespace carom
