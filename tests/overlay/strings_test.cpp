// Strings as strokes: taut, slack, rods, and those of bodies that are gone.
#include "overlay/strings.h"

#include "overlay/drawing_maker.h"
#include "overlay/hanging_curve.h"
#include "scene/scenes_in_text.h"
#include "std.h"

namespace carom {
namespace {

constexpr Size of_picture{1280, 720};
const Vec3 down = -Vec3::UnitY();

TEST(HangingCurve, IsACatenary) {
  // z = a cosh(u) with a = 2 from u = -0.5 to u = 1.5, along a level direction of its own.
  const Vec3 level = Vec3(0.6, 0, 0.8), from(1, 2, 3);
  const auto at = [&](double u) {
    return Vec3(from + 2 * (u + 0.5) * level - 2 * (std::cosh(u) - std::cosh(0.5)) * down);
  };
  const double length = 2 * (std::sinh(1.5) + std::sinh(0.5));
  const vector<Vec3> points = hanging_curve(from, at(1.5), length, down, 1e-9);
  ASSERT_EQ(points.size(), 64u) << "as many as are allowed";
  for (size_t i = 0; i < points.size(); ++i)
    EXPECT_LT((points[i] - at(-0.5 + 2 * static_cast<double>(i + 1) / 64)).norm(), 1e-13) << i;
}

TEST(HangingCurve, HasStrokesWithinTheError) {
  const double length = 2 * std::sinh(1.0), error = 1e-3;
  vector<Vec3> points = hanging_curve(Vec3(-1, 0, 0), Vec3(1, 0, 0), length, down, error);
  points.insert(points.begin(), Vec3(-1, 0, 0));

  const auto height = [](double x) { return std::cosh(x) - std::cosh(1.0); };
  double worst = 0;
  for (size_t i = 0; i + 1 < points.size(); ++i)
    for (int k = 0; k <= 50; ++k) {
      const Vec3 p = points[i] + k / 50.0 * (points[i + 1] - points[i]);
      worst = std::max(worst, std::abs(p.y() - height(p.x())) / std::cosh(p.x()));
    }

  EXPECT_LT(worst, 1.01 * error);
  EXPECT_GT(worst, error / 3);
  EXPECT_LT(points.size(), 30u);
}

TEST(HangingCurve, IsStraightWhereItIsTautOrWithoutGravity) {
  const Vec3 a(0, 0, 0), b(3, 4, 0);
  EXPECT_EQ(hanging_curve(a, b, 5, down, 0.01), vector<Vec3>{b});
  EXPECT_EQ(hanging_curve(a, b, 4.9, down, 0.01), vector<Vec3>{b});
  EXPECT_EQ(hanging_curve(a, b, 7, Vec3::Zero(), 0.01), vector<Vec3>{b});
}

TEST(HangingCurve, HangsDoubleBetweenEndsAboveOneAnother) {
  const vector<Vec3> points = hanging_curve(Vec3(1, 0, 0), Vec3(1, 2, 0), 6, down, 0.01);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0], Vec3(1, -2, 0));
  EXPECT_EQ(points[1], Vec3(1, 2, 0));
}

TEST(HangingCurve, KeepsItsLengthInEveryShape) {
  for (const double width : {1e-12, 1e-6, 0.01, 0.5, 1.0, 1.5})
    for (const double rise : {-1.0, 0.0, 0.3, 1.2}) {
      const Vec3 to(width, rise, 0);
      const double least = to.norm();

      for (const double slack : {1e-12, 1e-6, 0.1, 10.0, 1e6}) {
        const double length = least * (1 + slack);
        Vec3 last = Vec3::Zero();
        double sum = 0;
        for (const Vec3& point : hanging_curve(last, to, length, down, 1e-9 * least)) {
          ASSERT_TRUE(point.allFinite());
          sum += (point - last).norm();
          last = point;
        }

        EXPECT_EQ(last, to);
        EXPECT_NEAR(sum, length, 0.02 * length) << width << " " << rise << " " << slack;
      }
    }
}

const string tied_balls =
    "scene: 1\nsimulate: {duration: 9}\nbackground: black\noutput: {frames: true}\n"
    "balls:\n  red: {mass: 2, radius: 0.1, position: [0, 0, 0]}\n  blue: {mass: 2, radius: 0.2, position: [1, 0, 0]}\n"
    "camera: {eye: [0, 0, 5], target: [0, 0, 0]}\n";

vector<Stroke> strokes_of(const Scene& scene, const State& state) {
  const History history(scene, picture_needs(scene));
  return DrawingMaker(scene, history, of_picture).at(state, *scene.camera).strokes;
}

TEST(Strings, AreDrawnBetweenTheirEndsUnlessHidden) {
  const Scene scene = load_text(tied_balls +
                                "strings:\n"
                                "  line: {from: [0, 1, 0], to: red}\n"
                                "  bar: {from: blue, to: red, rod: true}\n"
                                "  unseen: {from: [0, 2, 0], to: red, visible: false}\n");
  const vector<Stroke> strokes = strokes_of(scene, scene.initial);
  ASSERT_EQ(strokes.size(), 2u);
  EXPECT_EQ(strokes[0].from, Vec3(0, 0, 0));
  EXPECT_EQ(strokes[0].to, Vec3(0, 1, 0));
  EXPECT_EQ(strokes[1].from, Vec3(0, 0, 0));
  EXPECT_EQ(strokes[1].to, Vec3(1, 0, 0));
  EXPECT_GT(strokes[1].from_radius, strokes[0].from_radius) << "rods are thicker";
}

TEST(Strings, HangWhenSlack) {
  const Scene scene = load_text(tied_balls + "strings: {line: {from: blue, to: red, length: 3}}\n");
  const vector<Stroke> strokes = strokes_of(scene, scene.initial);
  ASSERT_GT(strokes.size(), 4u);
  double length = 0, lowest = 0;
  for (size_t i = 0; i < strokes.size(); ++i) {
    EXPECT_EQ(strokes[i].from, i > 0 ? strokes[i - 1].to : Vec3(0, 0, 0));
    length += (strokes[i].to - strokes[i].from).norm();
    lowest = std::min(lowest, strokes[i].to.y());
  }
  EXPECT_NEAR(length, 3, 0.01);
  EXPECT_LT(lowest, -1);
}

TEST(Strings, ThatAreCutAreNotDrawn) {
  const Scene scene = load_text(tied_balls +
                                "regions: {gate: {radius: 1, position: [9, 0, 0]}}\n"
                                "strings: {line: {from: blue, to: red, length: 3, until: {region: gate}}}\n");
  const History history(scene, picture_needs(scene));
  DrawingMaker maker(scene, history, {64, 36});
  State state = scene.initial;
  state.time = 1;
  state.fired = {not_yet};
  EXPECT_FALSE(maker.at(state, camera_of(scene)).strokes.empty());
  state.fired = {0.5};
  EXPECT_TRUE(maker.at(state, camera_of(scene)).strokes.empty());
}

TEST(Strings, OfBodiesThatAreGoneAreNotDrawn) {
  const Scene scene = load_text(tied_balls + "strings: {line: {from: blue, to: red, length: 3}}\n");
  State state = scene.initial;
  state.part_of = {0, no_entity};
  EXPECT_TRUE(strokes_of(scene, state).empty());
}

TEST(Strings, CountForTheCollisionsOfBothBodies) {
  const Scene scene = load_text(tied_balls +
                                "strings: {line: {from: blue, to: red, length: 3}}\nflash: true\n"
                                "defaults: {ball: {color: {by: collisions}}}\n");
  History history(scene, picture_needs(scene));
  const Collision taut{0.5, CollisionKind::taut, 0, 2, Vec3::Zero(), Vec3::UnitX(), 1, 0, 0, 1, 1};
  history.record({&taut, 1});
  EXPECT_EQ(history.last_collision(0), 0.5);
  EXPECT_EQ(history.last_collision(1), 0.5);
}

}  // namespace
}  // namespace carom
