// Values beside bodies, bars of known length and sums of momenta: their numbers by closed forms, and where they stand.
#include "overlay/marks.h"

#include <fmt/format.h>

#include <numbers>

#include "overlay/drawing_maker.h"
#include "overlay/inscription.h"
#include "overlay/mark_painter.h"
#include "overlay/pen.h"
#include "render/renderer.h"
#include "scene/label_size.h"
#include "scene/scenes_in_text.h"
#include "std.h"

namespace carom {
namespace {

constexpr Size picture{640, 360};

Marks marks_at_start(const Scene& scene, Size size = picture) {
  const History history(scene, picture_needs(scene));
  return DrawingMaker(scene, history, size).marks(scene.initial, *scene.camera);
}

/// Balls of 0.1 m seen along -z from 4 m.
string balls_scene(const string& balls, const string& more) {
  return "scene: 1\nsimulate: {duration: 1}\ngravity: [0, 0, 0]\noutput: {frames: {size: [640, 360]}}\n"
         "camera: {eye: [0, 0, 4], target: [0, 0, 0]}\ndefaults: {ball: {mass: 2, radius: 0.1}}\nballs:\n" +
         balls + more;
}

double sum_of(const Coverage& covered) {
  double sum = 0;
  for (const uint8_t value : covered.values) sum += value / 255.0;
  return sum;
}

TEST(Marks, HaveThreeDigits) {
  const pair<double, const char*> texts[] = {
      {2.4, "2.40"},    {0.031249, "0.0312"}, {9.996, "10.0"},       {99.96, "100"}, {1234, "1230"},
      {-0.5, "-0.500"}, {2e6, "2.00e6"},      {3.456e-5, "3.46e-5"}, {1e-9, "0"},    {0, "0"}};
  for (const auto& [value, text] : texts) EXPECT_EQ(three_digits(value, 1), text);
  EXPECT_EQ(three_digits(1e-9, 1e-8), "1.00e-9");
}

TEST(Marks, NameLengthsByTheirUnits) {
  const pair<double, const char*> texts[] = {{0.2, "20 cm"}, {0.005, "5 mm"}, {2000, "2 km"},  {1, "1 m"},
                                             {0.01, "1 cm"}, {50, "50 m"},    {2e-5, "20 µm"}, {5e8, "500000 km"}};
  for (const auto& [length, text] : texts) EXPECT_EQ(length_text(length), text);
}

TEST(ScaleBar, IsAsLongAsABodyOfItsLengthAtTheTargetsDepth) {
  // Thin boxes, which have no other depth. The bar is the longest of 1, 2, 5 that is not above a fifth of the width.
  struct Case {
    double distance, length;
    const char* text;
  };
  // A fifth of the width at 3 m is 2 x 3 tan(25 degrees) x 16/9 / 5 = 0.995 m.
  for (const auto& [distance, length, text] :
       {Case{3, 0.5, "50 cm"}, {4.7, 1, "1 m"}, {9, 2, "2 m"}, {0.2, 0.05, "5 cm"}}) {
    const Scene scene = load_text(
        "scene: 1\nsimulate: {duration: 1}\nscale_bar: true\noutput: {frames: true}\nbackground: black\n"
        "lights: {ambient: white}\n"
        "camera: {target: [1, 2, 0], fov: 50, eye: [1, 2, " +
        to_string(distance) + "]}\nbodies: {red: {mass: 1, box: [" + to_string(length) + ", " + to_string(length / 4) +
        ", 0.0001], position: [1, 2, 0], color: white}}\n");
    const Size size{1280, 720};
    const Marks marks = marks_at_start(scene, size);
    ASSERT_TRUE(marks.scale_bar);
    EXPECT_EQ(marks.scale_bar->text, text);

    Renderer renderer(scene, size, 4);
    Image image = renderer.draw(scene.initial);
    // 188: half of white as light.
    const auto width_in = [&](int row, int from, double threshold) {
      double sum = 0;
      for (int x = from; x < size.width; ++x) sum += image.row(row)[3 * x] > threshold;
      return sum;
    };
    const double body = width_in(360, 0, 188 / 255.0 * image.row(360)[3 * 640]);
    EXPECT_NEAR(marks.scale_bar->pixels, body, 1.01);

    // The bar itself is the longest row of white in the corner.
    Inscription(scene, size).write({}, image, marks);
    double bar = 0;
    for (int row = 600; row < 720; ++row) bar = std::max(bar, width_in(row, 700, 188));
    EXPECT_NEAR(bar, body, 1.01) << text;
  }
}

TEST(Labels, AreTheSpeedAndTheMomentumOfBodiesInView) {
  const Scene scene = load_text(balls_scene(
      "  red: {position: [-0.5, 0, 0], velocity: [0, 3, 4]}\n  still: {position: [0.5, 0, 0]}\n"
      "  beside: {position: [9, 0, 0]}\n  behind: {position: [0, 0, 9]}\n  hidden: {position: [-1, 0, -4]}\n",
      "labels: [name, momentum, speed]\n"));
  const Marks marks = marks_at_start(scene);
  ASSERT_EQ(marks.labels.size(), 2u);
  EXPECT_EQ(marks.labels[0].lines, (vector<string>{"red", "5.00 m/s", "10.0 kg m/s"}));
  EXPECT_EQ(marks.labels[1].lines, (vector<string>{"still", "0 m/s", "0 kg m/s"}));
  // 0.1 m at 4 m, where 360 pixels are 2 x 4 tan(22.5 degrees) = 3.314 m.
  EXPECT_NEAR(marks.labels[1].body.right - marks.labels[1].body.left, 0.2 * 360 / 3.3137, 1e-3);
}

TEST(Labels, AreNotOfBodiesBehindWallsObstaclesAndBoxes) {
  const string ball = "  red: {position: [0, 0, 0]}\n";
  const auto count = [&](const string& more) {
    return marks_at_start(load_text(balls_scene(ball, "labels: {show: [speed], on: [red]}\n" + more))).labels.size();
  };
  EXPECT_EQ(count(""), 1u);
  EXPECT_EQ(count("walls: {w: {center: [0, 0, 1], normal: [0, 0, 1], size: [1, 1]}}\n"), 0u);
  EXPECT_EQ(count("walls: {w: {center: [0, 0, 1], normal: [0, 0, 1], size: [1, 1], visible: false}}\n"), 1u);
  EXPECT_EQ(count("walls: {w: {center: [0.6, 0, 1], normal: [0, 0, 1], size: [1, 1]}}\n"), 1u);
  EXPECT_EQ(count("walls: {w: {center: [0, 0, -1], normal: [0, 0, 1], size: [1, 1]}}\n"), 1u);

  EXPECT_EQ(count("obstacles: {o: {cylinder: {radius: 0.2, height: 1}, position: [0, 0, 1]}}\n"), 0u);
  EXPECT_EQ(count("obstacles: {o: {cylinder: {radius: 0.2, height: 1}, position: [0, 0.6, 1]}}\n"), 1u);
  EXPECT_EQ(count("bodies: {b: {mass: 1, box: [1, 0.1, 0.1], position: [0.4, 0, 1]}}\n"), 0u);
  EXPECT_EQ(count("bodies: {b: {mass: 1, box: [1, 0.1, 0.1], position: [0.4, 0, 5]}}\n"), 1u);
}

TEST(Labels, CoverNeitherTheirBodiesNorOneAnother) {
  // Two lines of balls that touch: each label has to find a place of its own.
  string balls;
  for (int i = 0; i < 6; ++i)
    balls += fmt::format("  b{}: {{position: [{}, {}, 0]}}\n", i, -0.7 + 0.25 * (i % 3) * 2, i < 3 ? 0.15 : -0.15);
  const Scene scene = load_text(balls_scene(balls, "labels: [speed]\n"));
  const Marks marks = marks_at_start(scene);
  ASSERT_EQ(marks.labels.size(), 6u);

  const Image ground{picture.width, picture.height, vector<uint8_t>(size_t(picture.width * picture.height * 3), 128)};
  Image all = ground;
  MarkPainter(picture).draw(marks, {}, all);
  int changed = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      if (all.row(y)[3 * x] == 128) continue;
      ++changed;
      for (const BodyBounds& body : marks.bounds)
        EXPECT_FALSE(x > body.left && x + 1 < body.right && y > body.top && y + 1 < body.bottom) << x << ", " << y;
    }

  // As many pixels as the labels alone have.
  int alone = 0;
  for (const BodyLabel& label : marks.labels) {
    Image one = ground;
    Marks single = marks;
    single.labels = {label};
    MarkPainter(picture).draw(single, {}, one);
    for (size_t i = 0; i < one.pixels.size(); i += 3) alone += one.pixels[i] != 128;
  }
  EXPECT_EQ(changed, alone);
}

TEST(Labels, AreDarkOnLightPicturesAndLightOnOthers) {
  const Scene scene = load_text(balls_scene("  red: {position: [0, 0, 0]}\n", "labels: [speed]\n"));
  const Marks marks = marks_at_start(scene);
  for (const int ground : {0, 128, 190, 210, 255}) {
    Image image{picture.width, picture.height,
                vector<uint8_t>(size_t(picture.width * picture.height * 3), uint8_t(ground))};
    MarkPainter(picture).draw(marks, {}, image);
    const auto [least, most] = ranges::minmax(image.pixels);

    // Whole pixels of the letters, in their outline.
    const bool dark = ground > 0.78 * 255;
    EXPECT_LT(least, 50) << ground;  // 36
    EXPECT_GT(most, 230) << ground;
    int letters = 0;
    for (size_t i = 0; i < image.pixels.size(); i += 3)
      letters += image.pixels[i] != ground && (dark ? image.pixels[i] < 80 : image.pixels[i] > 200);
    EXPECT_GE(letters, 10) << ground;
  }
}

TEST(Labels, StayAwayFromOtherText) {
  const Scene scene = load_text(balls_scene("  red: {position: [0, 0, 0]}\n", "labels: [speed]\n"));
  const Marks marks = marks_at_start(scene);
  const Image ground{picture.width, picture.height, vector<uint8_t>(size_t(picture.width * picture.height * 3), 128)};
  Image image = ground;
  const PixelBox all{0, 0, picture.width, picture.height};
  MarkPainter(picture).draw(marks, span(&all, 1), image);
  EXPECT_EQ(image.pixels, ground.pixels);
}

TEST(Labels, FitByTheSizeOfThePicture) {
  // A value covers 6 x 1.3 letters of 1/38 of the height: an eighth of 16:9 has room for 41.
  EXPECT_EQ(most_labels({1280, 720}, 1), 41u);
  EXPECT_EQ(most_labels({1280, 720}, 2), 20u);
  EXPECT_EQ(most_labels({3840, 2160}, 2), 20u);
  EXPECT_EQ(most_labels({320, 180}, 1), 16u);  // the least letters
}

TEST(MomentumSum, IsThatOfItsParts) {
  const Scene scene =
      load_text(balls_scene("  red: {position: [-1, 0, 0], velocity: [3, 1, 2]}\n  blue: {mass: 5, position: [1, 0, "
                            "0], velocity: [-2, 0, 1]}\n",
                            "arrows: [momentum]\n"));
  const optional<MomentumSum> sum = marks_at_start(scene).momentum;
  ASSERT_TRUE(sum);
  ASSERT_EQ(sum->parts.size(), 2u);
  // Seen along -z, x is to the right and y up. 2 (3, 1, 2) + 5 (-2, 0, 1) = (-4, 2, 9).
  EXPECT_NEAR(sum->parts[0].right, 6, 1e-12);
  EXPECT_NEAR(sum->parts[1].right, -10, 1e-12);
  EXPECT_NEAR(sum->total.right, -4, 1e-12);
  EXPECT_NEAR(sum->total.up, 2, 1e-12);
  EXPECT_EQ(sum->text, "sum: 10.0 kg m/s");  // sqrt(101)
  EXPECT_EQ(sum->parts[0].color, scene.roster.bodies[0].color);
}

TEST(MomentumSum, OfManyBodiesStandsAlone) {
  string balls;
  for (int i = 0; i < 7; ++i) balls += fmt::format("  b{}: {{position: [{}, 0, 0], velocity: [1, 0, 0]}}\n", i, i);
  const optional<MomentumSum> sum = marks_at_start(load_text(balls_scene(balls, "arrows: [momentum]\n"))).momentum;
  ASSERT_TRUE(sum);
  EXPECT_TRUE(sum->parts.empty());
  EXPECT_EQ(sum->text, "sum: 14.0 kg m/s");
}

TEST(Marks, AreNoneUnlessTheSceneHasThem) {
  EXPECT_FALSE(has_marks(load_text(balls_scene("  red: {position: [0, 0, 0]}\n", "arrows: [velocity]\n"))));
  for (const string more : {"labels: [name]\n", "scale_bar: true\n", "arrows: [momentum]\n"})
    EXPECT_TRUE(has_marks(load_text(balls_scene("  red: {position: [0, 0, 0]}\n", more)))) << more;
}

TEST(Marks, StayInTheLowerThreeFifthsBesideTheLegends) {
  // Neither changes a pixel of what the other covers, in large and in small pictures.
  for (const Size size : {Size{1280, 720}, Size{320, 180}, Size{300, 400}}) {
    const Scene scene = load_text(balls_scene(
        "  a_ball_with_a_name_of_some_length: {position: [-1, 0, 0], velocity: [3, 0, 0], color: {by: group}}\n",
        "arrows: [velocity, momentum]\nscale_bar: true\ncaption: true\ntitle: A title of some length, and more\n"));
    const Image ground{size.width, size.height, vector<uint8_t>(size_t(size.width * size.height * 3), 200)};
    const Marks marks = marks_at_start(scene, size);

    Image both = ground, text = ground, sums = ground;
    Inscription inscription(scene, size);
    inscription.write({scene.title, "1", "", ""}, both, marks);
    inscription.write({scene.title, "1", "", ""}, text);
    MarkPainter(size).draw(marks, {}, sums);

    int of_both = 0, of_text = 0, of_sums = 0;
    for (size_t i = 0; i < ground.pixels.size(); i += 3) {
      of_both += both.pixels[i] != 200;
      of_text += text.pixels[i] != 200;
      of_sums += sums.pixels[i] != 200;
    }
    EXPECT_EQ(of_both, of_text + of_sums) << size.width;
    EXPECT_GT(of_sums, 500);
  }
}

TEST(Pen, CoversTheAreaOfItsShapes) {
  const double pi = std::numbers::pi;
  Coverage line(100, 100), arrow(100, 100), disc(100, 100), box(100, 100);
  draw_line({20.3, 30.1}, {70.3, 60.6}, 4, line);
  EXPECT_NEAR(sum_of(line), 4 * hypot(50, 30.5) + 4 * pi, 2);  // 246.6
  draw_disc({50.2, 50.7}, 20, disc);
  EXPECT_NEAR(sum_of(disc), 400 * pi, 3);
  draw_box({10.25, 10.5}, {20.75, 30.25}, box);
  EXPECT_NEAR(sum_of(box), 10.5 * 19.75, 0.5);
  // A head of 4 widths and a shaft: the head is 16 long and 13.4 wide.
  draw_arrow({10, 50}, {90, 50}, 4, arrow);
  EXPECT_NEAR(sum_of(arrow), 64 * 4 + 2 * pi + 0.5 * 16 * 13.44, 6);
  EXPECT_EQ(arrow.at(95, 50), 0);
}

TEST(Pen, OutlinesAreAsWideAsSaid) {
  Coverage dot(21, 21);
  dot.at(10, 10) = 255;
  const Coverage wide = outline_of(dot, 3);
  EXPECT_EQ(wide.at(12, 10), 255);
  EXPECT_NEAR(wide.at(13, 10), 127, 1);
  EXPECT_EQ(wide.at(14, 10), 0);
  EXPECT_EQ(wide.at(10, 10), 255);
}

}  // namespace
}  // namespace carom
