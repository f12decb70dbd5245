// Trails, springs and arrows, as strokes.
#include <numbers>

#include "numerics/compensated.h"
#include "overlay/drawing_maker.h"
#include "overlay/legend.h"
#include "overlay/moment.h"
#include "overlay/springs.h"
#include "overlay/trails.h"
#include "scene/scenes_in_text.h"
#include "std.h"

namespace carom {
namespace {

constexpr Size size{1280, 720};

string ball_scene(const string& more) {
  return "scene: 1\nsimulate: {duration: 9}\nbackground: black\noutput: {frames: true}\n"
         "balls: {red: {mass: 2, radius: 0.1, position: [0, 0, 0], velocity: [1, 2, 0], color: gold}}\n"
         "camera: {eye: [0, 0, 5], target: [0, 0, 0]}\n" +
         more;
}

PathPiece piece(double from, const Vec3& x, const Vec3& v, const Vec3& a) {
  return {.body = 0, .from = from, .start = {from, 0}, .x = x, .v = v, .a = a};
}

vector<Stroke> trails_of(const Scene& scene, const History& history, const State& state) {
  const BodyColors colors(scene);
  DrawingMaker maker(scene, history, size);
  vector<Stroke> strokes;
  add_trails({scene, scene.world, state, history, colors, Eye(camera_of(scene), size)}, strokes);
  return strokes;
}

/// The distance in pixels from a point to the nearest stroke.
double pixels_off(const Vec3& point, const vector<Stroke>& strokes, const Eye& eye) {
  const auto place = [&](const Vec3& x) {
    const Vec3 p = eye.point(x);
    return Vec3(p.x() / p.z() / eye.pixel, p.y() / p.z() / eye.pixel, 0);
  };
  double nearest = 1e9;
  const Vec3 p = place(point);
  for (const Stroke& stroke : strokes) {
    const Vec3 a = place(stroke.from), ab = place(stroke.to) - a;
    const double t = ab.squaredNorm() > 0 ? std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0) : 0;
    nearest = std::min(nearest, (p - a - t * ab).norm());
  }
  return nearest;
}

TEST(Trail, LiesWithinAQuarterPixelOfTheParabola) {
  const Scene scene = load_text(ball_scene("trails: {seconds: 0.8}\n"));
  History history(scene, picture_needs(scene));
  const PathPiece path = piece(0, {-1, 0, 0}, {1, 4, 0.5}, {0, -9.80665, 0});
  history.record_paths({&path, 1});

  State state = scene.initial;
  state.time = 1;
  const vector<Stroke> strokes = trails_of(scene, history, state);

  const Eye eye(*scene.camera, size);
  const auto exact = [&](double t) { return Vec3(path.x + t * (path.v + t / 2 * path.a)); };
  double worst = 0;
  for (int i = 0; i <= 300; ++i) worst = std::max(worst, pixels_off(exact(0.2 + 0.8 * i / 300), strokes, eye));
  EXPECT_LT(worst, 0.25);  // 0.115

  EXPECT_GT(strokes.size(), 10u);
  EXPECT_LT(strokes.size(), 100u);  // 30
  EXPECT_EQ(strokes.front().from, exact(1 - 0.8));
  EXPECT_EQ(strokes.back().to, exact(1));
}

TEST(Trail, FadesWithAgeAndIsOneLine) {
  const Scene scene = load_text(ball_scene("trails: {seconds: 2, width: 0.04}\n"));
  History history(scene, picture_needs(scene));
  const PathPiece path = piece(0, {0, 0, 0}, {1, 2, 0}, {0, -9.80665, 0});
  history.record_paths({&path, 1});

  State state = scene.initial;
  state.time = 1;
  const vector<Stroke> strokes = trails_of(scene, history, state);

  EXPECT_EQ(strokes.front().from_opacity, 0.5);  // 1 s of 2 s
  EXPECT_EQ(strokes.back().to_opacity, 1);
  for (size_t i = 0; i < strokes.size(); ++i) {
    EXPECT_EQ(strokes[i].from_radius, 0.02);
    EXPECT_EQ(strokes[i].color, parse_color("gold"));
    if (i == 0) continue;
    EXPECT_EQ(strokes[i].from, strokes[i - 1].to);
    EXPECT_EQ(strokes[i].from_opacity, strokes[i - 1].to_opacity);
  }
}

TEST(Trail, TurnsWhereItsBodyBounces) {
  const Scene scene = load_text(ball_scene("trails: {seconds: 2}\n"));
  History history(scene, picture_needs(scene));
  const PathPiece pieces[] = {piece(0, {0, 0, 0}, {1, -2, 0}, Vec3::Zero()),
                              piece(0.5, {0.5, -1, 0}, {1, 2, 0}, Vec3::Zero())};
  history.record_paths(pieces);
  State state = scene.initial;
  state.time = 1;
  const vector<Stroke> strokes = trails_of(scene, history, state);
  ASSERT_EQ(strokes.size(), 2u);
  EXPECT_EQ(strokes[0].to, Vec3(0.5, -1, 0));
  EXPECT_EQ(strokes[1].from, Vec3(0.5, -1, 0));
  EXPECT_EQ(strokes[1].to, Vec3(1, 0, 0));
}

TEST(Trail, OfManyShortStepsHasNoStrokesShorterThanAnEighthOfAPixel) {
  const Scene scene = load_text(ball_scene("trails: {seconds: 2}\n"));
  History history(scene, picture_needs(scene));
  for (int i = 0; i < 10000; ++i) {
    const PathPiece step = piece(1e-4 * i, {1e-6 * i, 0, 0}, {0.01, 0, 0}, Vec3::Zero());
    history.record_paths({&step, 1});
  }
  State state = scene.initial;
  state.time = 1;
  const vector<Stroke> strokes = trails_of(scene, history, state);
  EXPECT_LT(strokes.size(), 20u);  // 0.01 m are 1.7 pixels: 14
  EXPECT_GT(strokes.size(), 5u);
}

TEST(Trail, EndsWhereABodyBecomesPartOfAnother) {
  const Scene scene = load_text(ball_scene("trails: {seconds: 2}\n"));
  History history(scene, picture_needs(scene));
  PathPiece pieces[] = {piece(0, {0, 0, 0}, {1, 0, 0}, Vec3::Zero()), piece(0.5, {9, 9, 9}, {1, 2, 0}, Vec3::Zero())};
  pieces[1].part_of = 3;
  history.record_paths(pieces);
  State state = scene.initial;
  state.time = 1;
  const vector<Stroke> strokes = trails_of(scene, history, state);
  ASSERT_EQ(strokes.size(), 1u);
  EXPECT_EQ(strokes[0].to, Vec3(0.5, 0, 0));
}

TEST(Trail, IsOfTheNamedBodiesAlone) {
  const Scene scene = load_text(
      "scene: 1\nsimulate: {duration: 1}\noutput: {frames: true}\ndefaults: {ball: {mass: 1, radius: 0.1}}\n"
      "balls: {red: {position: [0, 0, 0]}, blue: {position: [1, 0, 0]}, green: {position: [2, 0, 0]}}\n"
      "trails: {on: [green, red]}\n");
  const History history(scene, picture_needs(scene));
  EXPECT_EQ(history.tracks()->bodies(), (vector<Entity>{0, 2}));
}

TEST(Trail, FromStatesFollowsAnOscillationWithinAQuarterPixel) {
  // x'' = -36 x: 6 rad/s, and a spring has no recorded paths.
  const Scene scene = load_text(
      ball_scene("gravity: [0, 0, 0]\ntrails: {seconds: 3}\nforces: [{spring: {anchor: [0, 0, 0], stiffness: 72}}]\n"));
  EXPECT_TRUE(overlay_needs(scene).states && overlay_needs(scene).collisions && !overlay_needs(scene).paths);

  History history(scene, picture_needs(scene));
  const auto at = [&](double time) {
    State state = scene.initial;
    state.time = time;
    state.position[0] = Vec3(std::cos(6 * time), 0.7 * std::sin(6 * time), 0);
    state.velocity[0] = Vec3(-6 * std::sin(6 * time), 4.2 * std::cos(6 * time), 0);
    return state;
  };

  int samples = 0;
  for (double time = 0; time < 2; time = history.next_sample(), ++samples) history.sample(at(time));
  history.sample(at(2));
  const vector<Stroke> strokes = trails_of(scene, history, at(2));

  const Eye eye(*scene.camera, size);
  double worst = 0;
  for (int i = 0; i <= 200; ++i) worst = std::max(worst, pixels_off(at(0.01 * i).position[0], strokes, eye));
  EXPECT_LT(worst, 0.25);  // 0.09
  EXPECT_LT(samples, 60);  // 48, at most 1/24 s apart
}

TEST(Trail, FromStatesDoesNotDependOnThePicturesBefore) {
  const Scene scene =
      load_text(ball_scene("trails: {seconds: 3}\nforces: [{spring: {anchor: [0, 0, 0], stiffness: 72}}]\n"));
  const auto at = [&](double time) {
    State state = scene.initial;
    state.time = time;
    state.position[0] = Vec3(std::cos(6 * time), 0, 0);
    state.velocity[0] = Vec3(-6 * std::sin(6 * time), 0, 0);
    return state;
  };

  const auto strokes = [&](double interval) {
    History history(scene, picture_needs(scene));
    double picture = interval;
    for (double time = 0; time < 1; time = std::min(picture, history.next_sample())) {
      history.sample(at(time));
      if (time == picture) picture += interval;
    }
    history.sample(at(1));
    return trails_of(scene, history, at(1));
  };

  const vector<Stroke> few = strokes(2), many = strokes(0.013);
  ASSERT_EQ(few.size(), many.size());
  for (size_t i = 0; i < few.size(); ++i) EXPECT_TRUE(few[i].from == many[i].from && few[i].to == many[i].to);
}

TEST(Trail, FromStatesHasItsKinkAtTheTimeOfTheCollision) {
  const Scene scene = load_text(ball_scene("trails: {seconds: 3}\nforces: [{drag: {quadratic: 1.0e-9}}]\n"));
  ASSERT_TRUE(overlay_needs(scene).states);
  History history(scene, picture_needs(scene));
  State state = scene.initial;

  const Vec3 g(0, -9.80665, 0), corner(0.1, -0.4, 0), before(0.5, -3, 0), after(0.5, 2, 0);
  const auto sample = [&](double t) {  // the collision is at 1 s
    state.time = t;
    const Vec3& v = t < 1 ? before : after;
    state.position[0] = corner + (t - 1) * v + (t - 1) * (t - 1) / 2 * g;
    state.velocity[0] = v + (t - 1) * g;
    history.sample(state);
  };

  sample(0.99);
  const Collision hit{1, CollisionKind::body_fixed, 0, 1, corner, -Vec3::UnitY(), 3, 2, 1, 1, 0};
  history.record({&hit, 1});
  sample(1.02);

  const vector<Stroke> strokes = trails_of(scene, history, state);
  double nearest = 1e9;
  for (const Stroke& stroke : strokes) nearest = std::min(nearest, (stroke.to - corner).norm());
  EXPECT_LT(nearest, 1e-6);
}

TEST(Spring, BeginsAtItsAnchorAndEndsAtItsBody) {
  const Scene scene = load_text(ball_scene("forces: [{spring: {anchor: [0, 2, 0], stiffness: 40, rest_length: 1}}]\n"));
  const History history(scene, picture_needs(scene));
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(0.5, 0.3, -0.4), Vec3(-1, 3, 1)}) {
    State state = scene.initial;
    state.position[0] = x;
    const vector<Stroke> strokes = DrawingMaker(scene, history, size).at(state, camera_of(scene)).strokes;
    ASSERT_GT(strokes.size(), 40u);
    EXPECT_EQ(strokes.front().from, Vec3(0, 2, 0));
    EXPECT_EQ(strokes.back().to, x);
    for (size_t i = 1; i < strokes.size(); ++i) EXPECT_EQ(strokes[i].from, strokes[i - 1].to);
    // The wire stays within its coil, 0.4 of the body's radius from the axis.
    const Vec3 along = (x - Vec3(0, 2, 0)).normalized();
    for (const Stroke& stroke : strokes) EXPECT_LT((stroke.to - Vec3(0, 2, 0)).cross(along).norm(), 0.04 + 1e-12);
  }
}

TEST(Spring, BetweenBodiesEndsAtBoth) {
  const Scene scene = load_text(
      "scene: 1\ncamera: {eye: [0, 0, 9], target: [0, 0, 0]}\n"
      "balls: {a: {mass: 1, radius: 0.1, position: [0, 0, 0]}, b: {mass: 1, radius: 0.2, position: [1, 0, 0]}}\n"
      "forces: [{spring: {from: a, to: b, stiffness: 1}}, {spring: {from: a, to: b, stiffness: 2}, visible: false}]\n"
      "simulate: {duration: 1}\noutput: {frames: {fps: 1}}\n");
  const History history(scene, picture_needs(scene));
  State state = scene.initial;
  state.position[1] = Vec3(0.5, 0.3, -0.4);
  const vector<Stroke> strokes = DrawingMaker(scene, history, size).at(state, camera_of(scene)).strokes;
  ASSERT_GT(strokes.size(), 20u);
  EXPECT_EQ(strokes.front().from, state.position[0]);
  EXPECT_EQ(strokes.back().to, state.position[1]);
}

TEST(Spring, HasTheSameTurnsHoweverItIsStretched) {
  const Scene scene = load_text(ball_scene("forces: [{spring: {anchor: [0, 2, 0], stiffness: 40, rest_length: 1}}]\n"));
  const History history(scene, picture_needs(scene));
  DrawingMaker maker(scene, history, size);

  const auto turns = [&](const Vec3& x) {
    State state = scene.initial;
    state.position[0] = x;
    int crossings = 0;
    double before = 0;

    for (const Stroke& stroke : maker.at(state, camera_of(scene)).strokes) {
      const double side = stroke.to.x();
      if (std::abs(side) < 1e-9) continue;
      crossings += before * side < 0;
      before = side;
    }
    return crossings / 2;
  };

  EXPECT_NEAR(turns({0, 1, 0}), 17, 1);  // 1 m / (1.5 x 0.04 m)
  EXPECT_NEAR(turns({0, 0, 0}), turns({0, 1, 0}), 1);
}

TEST(Spring, ThatIsNotVisibleOrNotActingIsNotDrawn) {
  const string spring = "spring: {anchor: [0, 2, 0], stiffness: 40}";
  for (const string& more : {spring + ", visible: false", spring + ", from: 5", spring + ", until: 0.5"}) {
    const Scene scene = load_text(ball_scene("forces: [{" + more + "}]\n"));
    const History history(scene, picture_needs(scene));
    State state = scene.initial;
    state.time = 1;
    EXPECT_TRUE(DrawingMaker(scene, history, size).at(state, camera_of(scene)).strokes.empty()) << more;
  }
}

TEST(Arrows, StartAtTheSurfaceAndAreAsLongAsTheirLegend) {
  const Scene scene = load_text(ball_scene("gravity: [0, 0, 0]\narrows: [velocity]\n"));
  const History history(scene, picture_needs(scene));
  const vector<ArrowScale> scales = arrow_scales(scene);
  ASSERT_EQ(scales.size(), 1u);
  EXPECT_EQ(scales[0].typical, 2.5);  // sqrt(5) m/s, rounded up
  EXPECT_DOUBLE_EQ(scales[0].length, 0.6);
  const vector<Stroke> strokes = DrawingMaker(scene, history, size).at(scene.initial, camera_of(scene)).strokes;
  ASSERT_EQ(strokes.size(), 2u);
  const Vec3 v(1, 2, 0);
  EXPECT_LT((strokes.front().from - 0.1 * v.normalized()).norm(), 1e-15);
  EXPECT_LT((strokes.back().to - strokes.front().from - 0.6 / 2.5 * v).norm(), 1e-15);
  EXPECT_EQ(strokes.back().to_radius, 0);
}

TEST(Arrows, OfMomentumAreAsLongAsMassTimesVelocity) {
  const Scene scene = load_text(
      "scene: 1\nsimulate: {duration: 1}\noutput: {frames: true}\ngravity: [0, 0, 0]\narrows: [velocity, momentum]\n"
      "balls:\n  light: {mass: 1, radius: 0.1, position: [0, 0, 0], velocity: [0, 4, 0]}\n"
      "  heavy: {mass: 5, radius: 0.1, position: [1, 0, 0], velocity: [2, 0, 0]}\n");

  const vector<ArrowScale> scales = arrow_scales(scene);
  ASSERT_EQ(scales.size(), 2u);
  EXPECT_EQ(scales[0].typical, 4);
  EXPECT_EQ(scales[1].typical, 10);
  EXPECT_EQ(scales[1].kind, ArrowScale::Kind::momentum);
  const vector<Legend> legends = legends_of(scene);
  ASSERT_EQ(legends.size(), 1u);
  EXPECT_EQ(legends[0].entries[0].name, "velocity: 4 m/s is 0.6 m");
  EXPECT_EQ(legends[0].entries[1].name, "momentum: 10 kg m/s is 0.6 m");
  EXPECT_FALSE(legends[0].entries[0].color == legends[0].entries[1].color);

  // A head and a shaft each: of the light ball 4 m/s and 4 kg m/s, of the heavy one 2 m/s and 10 kg m/s.
  const History history(scene, picture_needs(scene));
  const vector<Stroke> strokes = DrawingMaker(scene, history, size).at(scene.initial, camera_of(scene)).strokes;
  ASSERT_EQ(strokes.size(), 8u);
  const auto length = [&](size_t arrow) { return (strokes[2 * arrow + 1].to - strokes[2 * arrow].from).norm(); };
  EXPECT_NEAR(length(0), 0.6, 1e-15);
  EXPECT_NEAR(length(1), 0.24, 1e-15);
  EXPECT_NEAR(length(2), 0.3, 1e-15);
  EXPECT_NEAR(length(3), 0.6, 1e-15);
}

TEST(Arrows, OfForceAreGravityAndForcesTogether) {
  const Scene scene = load_text(ball_scene("gravity: [0, -10, 0]\nforces: [{uniform: [15, 0, 0]}]\narrows: [force]\n"));
  const History history(scene, picture_needs(scene));
  const vector<Stroke> strokes = DrawingMaker(scene, history, size).at(scene.initial, camera_of(scene)).strokes;
  ASSERT_EQ(strokes.size(), 2u);
  // 2 kg: (15, -20) N, 25 N in all, as long as six radii.
  EXPECT_LT((strokes.back().to - strokes.front().from - 0.6 * Vec3(0.6, -0.8, 0)).norm(), 1e-12);
}

TEST(Arrows, OfForceHaveNoScaleWhereNoForceIs) {
  const string arrows = "gravity: [0, 0, 0]\narrows: [force]\n";
  EXPECT_TRUE(arrow_scales(load_text(ball_scene(arrows))).empty());
  EXPECT_TRUE(legends_of(load_text(ball_scene(arrows))).empty());
  // A spring that is slack at time 0 pulls later.
  const string spring = "forces: [{spring: {anchor: [0, 2, 0], stiffness: 40, rest_length: 2}}]\n";
  EXPECT_EQ(arrow_scales(load_text(ball_scene(arrows + spring))).size(), 1u);
}

TEST(Arrows, StartAtTheSurfaceOfABox) {
  const Scene scene = load_text(
      "scene: 1\nsimulate: {duration: 1}\noutput: {frames: true}\ngravity: [0, 0, 0]\narrows: [velocity]\n"
      "bodies: {box: {mass: 1, box: [0.4, 0.2, 0.2], position: [0, 0, 0], velocity: [1, 1, 0]}}\n");
  const History history(scene, picture_needs(scene));
  const vector<Stroke> strokes = DrawingMaker(scene, history, size).at(scene.initial, camera_of(scene)).strokes;
  EXPECT_LT((strokes.front().from - Vec3(0.1, 0.1, 0)).norm(), 1e-15);
}

}  // namespace
}  // namespace carom
