// Colours of bodies by a quantity, and flashes.

#include "numerics/srgb.h"
#include "overlay/body_colors.h"
#include "overlay/drawing_maker.h"
#include "scene/scenes_in_text.h"
#include "std.h"

namespace carom {
namespace {

string scene_by(const string& coloring, const string& more = "") {
  return "scene: 1\nsimulate: {duration: 1}\ngravity: [0, 0, 0]\noutput: {frames: true}\n"
         "defaults: {ball: {color: {" +
         coloring + "}}}\nballs:\n  a: {mass: 1, radius: 0.1, position: [0, 0, 0], velocity: [2, 0, 0]}\n" +
         "  b: {mass: 4, radius: 0.2, position: [1, 0, 0], velocity: [0, 0, -3]}\n" +
         "  c: {mass: 9, radius: 0.5, position: [3, 0, 0]}\n" +
         "  plain: {mass: 1, radius: 0.1, position: [5, 0, 0], color: gold}\n" + more;
}

Collision hit(double time, Entity a, Entity b, CollisionKind kind = CollisionKind::body_body) {
  return {time, kind, a, b, Vec3::Zero(), Vec3::UnitX(), 1, 1, 1, 1, 0};
}

Color viridis(double at) {
  return color_in(ColorMap::viridis, at);
}

double luminance(const Color& c) {
  return 0.2126 * light_of_srgb(c.r) + 0.7152 * light_of_srgb(c.g) + 0.0722 * light_of_srgb(c.b);
}

TEST(ColourMap, StandsOutFromBlackFromItsStartAndEndsAsItsTable) {
  const pair<ColorMap, string> ends[] = {{ColorMap::viridis, "#fde725"},
                                         {ColorMap::cividis, "#fee838"},
                                         {ColorMap::magma, "#fcfdbf"},
                                         {ColorMap::plasma, "#f0f921"},
                                         {ColorMap::inferno, "#fcffa4"}};
  for (const auto& [map, end] : ends) {
    // Contrast 3 : 1 (WCAG 2.2, 1.4.11).
    EXPECT_NEAR((luminance(color_in(map, 0)) + 0.05) / 0.05, 3, 1e-4);
    EXPECT_EQ(hex_text(color_in(map, 1)), end);
    EXPECT_EQ(color_in(map, -5), color_in(map, 0));
    EXPECT_EQ(color_in(map, 7), color_in(map, 1));
  }

  // Number 136 of 256 of viridis, 0x1f988b (colormaps.py), is on the way.
  double nearest = 1;
  for (int i = 0; i <= 10000; ++i) {
    const Color c = color_in(ColorMap::viridis, i / 10000.0);
    nearest = std::min(nearest, hypot(c.r - 0x1f / 255.0, c.g - 0x98 / 255.0, c.b - 0x8b / 255.0));
  }
  EXPECT_LT(nearest, 1e-3);
}

TEST(ColourMap, BecomesLighterAllAlongForPrintWithoutColours) {
  for (const ColorMap map :
       {ColorMap::viridis, ColorMap::cividis, ColorMap::magma, ColorMap::plasma, ColorMap::inferno}) {
    double before = -1;
    for (int i = 0; i <= 100; ++i) {
      const Color c = color_in(map, i / 100.0);
      const auto linear = [](double x) { return x <= 0.04045 ? x / 12.92 : pow((x + 0.055) / 1.055, 2.4); };
      const double luminance = 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
      EXPECT_GT(luminance, before) << static_cast<int>(map) << " at " << i;
      before = luminance;
    }
  }
}

TEST(BodyColours, AreTheEndsOfTheMapAtMinAndMaxAndBeyond) {
  const Scene scene = load_text(scene_by("by: speed, min: 2, max: 3"));
  const History history(scene, picture_needs(scene));
  const vector<Color> colors = BodyColors(scene).at(scene.initial, history);
  EXPECT_EQ(colors[0], viridis(0));  // 2 m/s
  EXPECT_EQ(colors[1], viridis(1));  // 3 m/s
  EXPECT_EQ(colors[2], viridis(0));  // 0, below the scale
  EXPECT_EQ(colors[3], parse_color("gold"));
}

TEST(BodyColours, FollowTheStateBetweenTheEnds) {
  const Scene scene = load_text(scene_by("by: kinetic, min: 0, max: 20, map: plasma"));
  const History history(scene, picture_needs(scene));
  State state = scene.initial;
  state.velocity[0] = Vec3(0, 6, 0);  // 18 J
  const vector<Color> colors = BodyColors(scene).at(state, history);
  EXPECT_EQ(colors[0], color_in(ColorMap::plasma, 0.9));
  EXPECT_EQ(colors[1], color_in(ColorMap::plasma, 0.9));  // 4 kg at 3 m/s
  EXPECT_EQ(colors[2], color_in(ColorMap::plasma, 0));
}

TEST(BodyColours, ByMassAndRadiusSpanThoseOfTheScene) {
  for (const char* by : {"mass", "radius"}) {
    const Scene scene = load_text(scene_by(string("by: ") + by));
    const vector<Color> colors = BodyColors(scene).at(scene.initial, History(scene, picture_needs(scene)));
    EXPECT_EQ(colors[0], viridis(0)) << by;
    EXPECT_EQ(colors[2], viridis(1)) << by;
  }
}

TEST(BodyColours, ByCollisionsCountEachImpactOfABody) {
  const Scene scene = load_text(scene_by("by: collisions, max: 4"));
  History history(scene, picture_needs(scene));
  const vector<Collision> first = {hit(0.1, 0, 1), hit(0.2, 0, 2), hit(0.3, 0, 9, CollisionKind::rest)};
  history.record(first);
  const vector<Color> colors = BodyColors(scene).at(scene.initial, history);
  EXPECT_EQ(colors[0], viridis(0.5));
  EXPECT_EQ(colors[1], viridis(0.25));
}

TEST(BodyColours, OfATrailAreThoseOfItsTime) {
  const Scene scene = load_text(scene_by("by: collisions, max: 4", "trails: {seconds: 1}\n"));
  History history(scene, picture_needs(scene));
  const vector<Collision> hits = {hit(0.1, 0, 1), hit(0.2, 0, 2)};
  history.record(hits);
  const BodyColors colors(scene);
  EXPECT_EQ(colors.of(0, 0.15, Vec3::Zero(), scene.initial, history), viridis(0.25));
  EXPECT_EQ(colors.of(0, 0.25, Vec3::Zero(), scene.initial, history), viridis(0.5));
}

TEST(BodyColours, OfASceneWithoutAQuantityAreNotMade) {
  const Scene scene = load_text(start + "balls: {red: {mass: 1, radius: 0.1, position: [0, 0, 0]}}\n");
  const History history(scene, picture_needs(scene));
  const Drawing drawing = DrawingMaker(scene, history, {64, 36}).at(scene.initial, camera_of(scene));
  EXPECT_TRUE(drawing.body_colors.empty() && drawing.glow.empty() && drawing.strokes.empty());
}

TEST(Flash, LastsATenthOfASecondOfTheFilm) {
  const Scene scene = load_text(scene_by("by: mass", "flash: true\n"));
  for (const double speed : {1.0, 0.125}) {
    History history(scene, picture_needs(scene));
    const vector<Collision> one = {hit(0.5, 0, 2)};
    history.record(one);
    DrawingMaker maker(scene, history, {64, 36}, FilmClock(speed, 0));

    State state = scene.initial;
    const auto glow_at = [&](double time, size_t body) {
      state.time = time;
      return maker.at(state, camera_of(scene)).glow[body];
    };

    EXPECT_EQ(glow_at(0.5, 0), 1);
    EXPECT_FLOAT_EQ(glow_at(0.5 + 0.05 * speed, 0), 0.5F);
    EXPECT_GT(glow_at(0.5 + 0.099 * speed, 2), 0);
    EXPECT_EQ(glow_at(0.5 + 0.1001 * speed, 2), 0);
    EXPECT_EQ(glow_at(0.5, 1), 0);  // did not collide
  }
}

}  // namespace
}  // namespace carom
