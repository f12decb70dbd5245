// Regions, and the ends of runs.
#include "physics/world.h"
#include "scene/marked_errors.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

const string watched =
    "scene: 1\n"
    "balls: {red: {mass: 1, radius: 1, position: [0, 0, 0]}, blue: {mass: 1, radius: 1, position: [5, 0, 0]}}\n"
    "groups: {gas: {count: 3, ball: {mass: 1, radius: 0.1}, in: {min: [9, 0, 0], max: [10, 1, 1]}}}\n"
    "planes: {floor: {point: [0, -3, 0], normal: [0, 1, 0]}}\n";
const string simulate = "simulate: {duration: 1}\n";

TEST(RegionKeys, MakeShapesOnBodies) {
  const Scene scene =
      load_text(watched + simulate +
                "regions:\n"
                "  ball: {radius: 0.5, position: [1, 2, 3]}\n"
                "  can: {cylinder: {radius: 0.5, height: 3}, position: [1, 2, 3], on: [gas, red], action: stop}\n"
                "  crate: {box: [1, 2, 3], position: [1, 2, 3], action: remove}\n"
                "  below: {plane: {point: [0, -1, 0], normal: [0, -2, 0]}, on: [gas.1]}\n");

  const vector<WorldRegion>& regions = scene.world.regions;
  ASSERT_EQ(regions.size(), 4u);
  EXPECT_EQ(scene.roster.regions, (vector<string>{"ball", "can", "crate", "below"}));
  EXPECT_EQ(regions[0].volume, Volume::sphere(0.5));
  EXPECT_EQ(regions[0].position, Vec3(1, 2, 3));
  EXPECT_TRUE(regions[0].on.empty());
  EXPECT_EQ(regions[1].volume, Volume::cylinder(0.5, 3));
  EXPECT_EQ(regions[1].on, (vector<Entity>{0, 2, 3, 4}));
  EXPECT_TRUE(regions[1].stops && !regions[1].removes);
  EXPECT_EQ(regions[2].volume, Volume::box({1, 2, 3}));
  EXPECT_TRUE(!regions[2].stops && regions[2].removes);

  EXPECT_EQ(regions[3].position, Vec3(0, -1, 0));
  EXPECT_EQ(regions[3].normal, Vec3(0, -1, 0));
  EXPECT_EQ(regions[3].on, (vector<Entity>{3}));
}

TEST(RegionKeys, OfStopsEndTheRun) {
  const Scene scene =
      load_text(watched +
                "regions: {pocket: {radius: 1, position: [9, 9, 9], action: remove}}\n"
                "simulate: {duration: 1, stop: [rest, {collisions: 9}, {region: pocket}, {collisions: 7}]}\n");
  EXPECT_TRUE(scene.simulate.stop_at_rest);
  EXPECT_EQ(scene.simulate.stop_collisions, 7u);
  EXPECT_TRUE(scene.world.regions[0].stops && scene.world.regions[0].removes);
  EXPECT_TRUE(may_stop(scene));
  EXPECT_FALSE(may_stop(load_text(watched + simulate)));
}

TEST(RegionKeys, AreInTheResolvedScene) {
  const Scene scene = load_text(watched +
                                "regions: {pocket: {radius: 1, position: [9, 9, 9]}, low: {plane: {point: [0, 0, 0], "
                                "normal: [0, -1, 0]}, on: [red]}}\n"
                                "simulate: {duration: 1, stop: [rest, {region: low}]}\n"
                                "output: {regions: true}\n");

  EXPECT_NE(
      scene.resolved.find("regions:\n"
                          "  pocket: {radius: 1, position: [9, 9, 9], action: none}\n"
                          "  low: {plane: {point: [0, 0, 0], normal: [0, -1, 0]}, \"on\": [red], action: none}\n"),
      string::npos)
      << scene.resolved;
  EXPECT_NE(scene.resolved.find("stop: [rest, {region: low}]"), string::npos);
  EXPECT_NE(scene.resolved.find("  regions: true\n"), string::npos);
  EXPECT_EQ(load_text(scene.resolved).resolved, scene.resolved);
}

TEST(RegionKeys, AreSetByPaths) {
  LoadOptions options;
  options.set = {"regions.pocket.position.x=2", "regions.pocket.box=[1, 1, 1]", "simulate.stop.0.collisions=5"};
  const Scene scene = load_text(watched +
                                    "regions: {pocket: {radius: 1, position: [9, 9, 9]}}\n"
                                    "simulate: {duration: 1, stop: [{collisions: 9}]}\n",
                                options);
  EXPECT_EQ(scene.world.regions[0].position, Vec3(2, 9, 9));
  EXPECT_EQ(scene.world.regions[0].volume, Volume::box({1, 1, 1}));
  EXPECT_EQ(scene.simulate.stop_collisions, 5u);
}

/// The first line of each error of a scene with this region.
string of_region(const string& region) {
  const string all = errors_of(watched + simulate + "regions: {pocket: " + region + "}\n");
  string lines;
  for (size_t i = 0; i < all.size();) {
    const size_t end = std::min(all.find('\n', i), all.size());
    if (all.compare(i, 5, "scene") == 0) lines += all.substr(i, end - i) + "\n";
    i = end + 1;
  }
  return lines;
}

TEST(RegionErrors, OneShapeEach) {
  EXPECT_EQ(in_parts(errors_of(watched + simulate + "regions: {pocket: {position: [0, 0, 0]}}\n")),
            (Parts{{"6:11 pocket", "region `pocket` has no `radius` and no `cylinder` and no `box` and no `plane`",
                    "expected `radius`: a number above 0 in m\n"
                    "or `cylinder`: a map of keys\n"
                    "or `box`: [x, y, z], three numbers above 0 in m\n"
                    "or `plane`: a map of keys"}}));

  EXPECT_EQ(of_region("{radius: 1, box: [1, 1, 1], position: [0, 0, 0]}"),
            "scene.yaml:6:31: error: region `pocket` has both `radius` and `box`\n");
  EXPECT_EQ(of_region("{plane: {point: [0, 0, 0], normal: [0, 1, 0]}, position: [0, 0, 0]}"),
            "scene.yaml:6:66: error: region `pocket` has both `plane` and `position`\n");
  EXPECT_EQ(of_region("{radius: 1}"), "scene.yaml:6:11: error: region `pocket` has no `position` and no `plane`\n");
  EXPECT_EQ(of_region("{}").substr(0, 52), "scene.yaml:6:11: error: region `pocket` has no `radi");
}

TEST(RegionErrors, OfSizesAndPlaces) {
  EXPECT_EQ(of_region("{radius: 0, position: [0, 0, 0]}"), "scene.yaml:6:28: error: `radius` is 0\n");
  EXPECT_EQ(of_region("{radius: -1, position: [0, 0, 0]}"), "scene.yaml:6:28: error: `radius` is -1\n");
  EXPECT_EQ(of_region("{box: [1, 0, 1], position: [0, 0, 0]}"), "scene.yaml:6:29: error: a number of `box` is 0\n");
  EXPECT_EQ(of_region("{cylinder: {radius: 1, height: 0}, position: [0, 0, 0]}"),
            "scene.yaml:6:50: error: `height` is 0\n");
  EXPECT_EQ(of_region("{cylinder: {radius: 1}, position: [0, 0, 0]}"),
            "scene.yaml:6:20: error: `cylinder` has no `height`\n");
  EXPECT_EQ(of_region("{plane: {point: [0, 0, 0], normal: [0, 0, 0]}}"),
            "scene.yaml:6:54: error: `normal` has no length\n");
  EXPECT_EQ(of_region("{radius: 1e-9, position: [1e6, 0, 0]}"),
            "scene.yaml:6:44: error: `pocket` is 2e-09 m wide and 1e+06 m from the origin\n");
}

TEST(RegionErrors, OfNamesAndActions) {
  EXPECT_EQ(of_region("{radius: 1, position: [0, 0, 0], on: []}"), "scene.yaml:6:56: error: `on` has 0 entries\n");
  EXPECT_EQ(of_region("{radius: 1, position: [0, 0, 0], on: [rde]}"),
            "scene.yaml:6:57: error: nothing is named `rde`\n");
  EXPECT_EQ(of_region("{radius: 1, position: [0, 0, 0], on: [floor]}"),
            "scene.yaml:6:57: error: `floor` is a fixed thing: it enters no region\n");
  EXPECT_EQ(of_region("{radius: 1, position: [0, 0, 0], on: [pocket]}"),
            "scene.yaml:6:57: error: nothing is named `pocket`\n");
  EXPECT_EQ(of_region("{radius: 1, position: [0, 0, 0], action: kill}"),
            "scene.yaml:6:60: error: `action` is `kill`\n");

  EXPECT_EQ(in_parts(errors_of(watched + simulate + "regions: {red: {radius: 1, position: [0, 0, 0]}}\n")),
            (Parts{{"6:11 red", "the name `red` is taken",
                    "names of bodies, groups, fixed things, strings, the room and regions are unique in a scene"}}));
}

TEST(StopErrors, NameWhatIsWrong) {
  const auto of = [](const string& stop) {
    return errors_of("scene: 1\nsimulate: {duration: 1, stop: " + stop +
                     "}\n"
                     "regions: {pocket: {radius: 1, position: [0, 0, 0]}}\n");
  };

  EXPECT_EQ(in_parts(of("[{region: pokcet}]")),
            (Parts{{"2:41 pokcet", "no region is named `pokcet`", "did you mean `pocket`?"}}));
  EXPECT_EQ(in_parts(of("[{collisions: 0}]")),
            (Parts{{"2:45 0", "`collisions` is 0", "expected a whole number of at least 1"}}));

  EXPECT_EQ(in_parts(of("[]")), (Parts{{"2:31 [", "`stop` has no entries", "expected at least one"}}));
  EXPECT_EQ(
      in_parts(of("[sleep]")),
      (Parts{{"2:32 sleep", "`sleep` is no entry of `stop`", "expected rest, or a map of collisions or region"}}));

  for (const char* stop : {"[{collisions: -1}]", "[{collisions: 1.5}]", "rest", "[{collisions: 1, region: pocket}]",
                           "[{}]", "[{rest: true}]", "[[rest]]", "{collisions: 1}", "[~]", "[{region: [pocket]}]"})
    EXPECT_NE(of(stop), "") << stop;
}

TEST(StopErrors, TheBooksEngineRemovesNothing) {
  EXPECT_EQ(
      in_parts(errors_of(start.substr(0, 9) + "simulate: {duration: 1, engine: book}\n"
                                              "regions: {drain: {radius: 1, position: [0, 0, 0], action: remove}}\n")),
      (Parts{{"3:1 regions", "`engine: book` has no regions with `action: remove`", "expected `engine: exact`"}}));
}

}  // namespace
}  // namespace carom
