// Bodies and obstacles: volumes, meshes, overlaps at the start.
#include <numbers>

#include "physics/world.h"
#include "scene/marked_errors.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

constexpr double pi = std::numbers::pi;

/// Vertices of a pin of radius 0.06 m and height 0.38 m that stands on the file's origin.
const vector<Vec3> pin = {Vec3(0.06, 0, 0),  Vec3(-0.06, 0, 0),    Vec3(0, 0, 0.06),
                          Vec3(0, 0, -0.06), Vec3(0, 0.38, 0.001), Vec3(0, 0.38, -0.001)};

LoadOptions with_reader(int* reads = nullptr) {
  LoadOptions options;
  options.mesh_points = [reads](const string& path) -> vector<Vec3> {
    if (reads != nullptr) ++*reads;
    if (path.ends_with("torn.stl")) throw runtime_error("it ends within a triangle");
    if (path.ends_with("flat.stl")) return {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 1)};
    return pin;
  };
  return options;
}

/// A pin that is drawn in millimetres, with another axis up: of the file's axes (x, y, z) of the pin.
vector<Vec3> drawn_pin(const function<Vec3(const Vec3&)>& axes) {
  vector<Vec3> out;
  for (const Vec3& p : pin) out.push_back(1000 * axes(p));
  return out;
}

/// A scene in a folder with the meshes of with_reader().
Scene load_with_meshes(const string& text, const LoadOptions& options = with_reader()) {
  for (const char* name : {"pin.stl", "torn.stl", "flat.stl"}) write_file("solid\n", name);
  return load_text(text, options);
}

string mesh_errors(const string& text, const LoadOptions& options = with_reader()) {
  for (const char* name : {"pin.stl", "torn.stl", "flat.stl"}) write_file("solid\n", name);
  return errors_of(text, options);
}

TEST(Bodies, HaveSpheresCylindersAndBoxes) {
  const Scene scene = load_text(start +
                                "balls: {ball: {mass: 1, radius: 0.5, position: [0, 0, 0]}}\n"
                                "bodies:\n"
                                "  marble: {mass: 2, radius: 0.25, position: [5, 0, 0]}\n"
                                "  can: {density: 100, cylinder: {radius: 3, height: 8}, position: [10, 0, 0]}\n"
                                "  crate: {density: 10, box: [1, 2, 2], position: [20, 0, 0], velocity: [0, 1, 0]}\n"
                                "groups: {gas: {count: 2, ball: {mass: 1, radius: 0.1}, in: {min: [30, 0, 0], max: "
                                "[31, 1, 1]}}}\n");

  const World& world = scene.world;
  ASSERT_EQ(world.volume.size(), 6u);
  EXPECT_EQ(world.volume[0].shape, Shape::sphere);
  EXPECT_EQ(world.volume[1].half, Vec3(0.25, 0.25, 0.25));
  EXPECT_EQ(world.volume[2].shape, Shape::cylinder);
  EXPECT_EQ(world.volume[2].half, Vec3(3, 4, 3));
  EXPECT_EQ(world.volume[3].shape, Shape::box);
  EXPECT_EQ(world.volume[3].half, Vec3(0.5, 1, 1));
  EXPECT_EQ(world.volume[5].half, Vec3(0.1, 0.1, 0.1));
  EXPECT_EQ(world.radius, (vector<double>{0.5, 0.25, 5, 1.5, 0.1, 0.1}));  // of the spheres about them
  EXPECT_DOUBLE_EQ(world.mass[2], 100 * pi * 9 * 8);
  EXPECT_EQ(world.mass[3], 40);
  EXPECT_EQ(scene.initial.velocity[3], Vec3(0, 1, 0));

  EXPECT_EQ(scene.roster.name(2), "can");
  EXPECT_EQ(scene.roster.name(5), "gas.1");
}

TEST(Bodies, ThatAreAllSpheresNeedNoVolumes) {
  const Scene scene = load_text(start + "bodies: {a: {mass: 1, radius: 2, position: [0, 0, 0]}}\n");
  EXPECT_TRUE(scene.world.volume.empty());
  EXPECT_EQ(scene.world.radius, vector<double>{2});
}

TEST(Bodies, StandInTheOrderOfTheFileWithBallsAndGroups) {
  const Scene scene = load_text(start +
                                "bodies: {a: {mass: 1, box: [1, 1, 1], position: [0, 0, 0]}}\n"
                                "balls: {b: {mass: 2, radius: 1, position: [5, 0, 0]}}\n");
  EXPECT_EQ(scene.roster.name(0), "a");
  EXPECT_EQ(scene.world.mass, (vector<double>{1, 2}));
}

TEST(Bodies, TakeAVolumeFromTheirDefaultsUnlessTheyNameAnother) {
  const Scene scene = load_text(start +
                                "defaults: {body: {mass: 1, box: [2, 2, 2]}, obstacle: {radius: 1, color: red}}\n"
                                "bodies: {a: {position: [0, 0, 0]}, b: {radius: 0.5, position: [9, 0, 0]}}\n"
                                "obstacles: {o: {position: [0, 9, 0]}, p: {box: [1, 1, 1], position: [9, 9, 0]}}\n");
  EXPECT_EQ(scene.world.volume[0].shape, Shape::box);
  EXPECT_EQ(scene.world.volume[1].shape, Shape::sphere);
  EXPECT_EQ(scene.world.obstacles[0].volume.half, Vec3(1, 1, 1));
  EXPECT_EQ(scene.world.obstacles[1].volume.shape, Shape::box);
  EXPECT_EQ(scene.roster.fixed[1].color.g, 0);
}

TEST(Obstacles, AreNumberedAfterPlanesAndWalls) {
  const Scene scene = load_text(start +
                                "obstacles: {post: {cylinder: {radius: 0.5, height: 2}, position: [4, 0, 0], "
                                "restitution: 0.5, visible: false}}\n"
                                "balls: {b: {mass: 2, radius: 1, position: [0, 0, 0]}}\n"
                                "walls: {w: {center: [9, 0, 0], normal: [1, 0, 0], size: [1, 1]}}\n"
                                "planes: {p: {point: [0, -5, 0], normal: [0, 1, 0]}}\n");

  EXPECT_EQ(scene.roster.name(1), "p");
  EXPECT_EQ(scene.roster.name(2), "w");
  EXPECT_EQ(scene.roster.name(3), "post");
  EXPECT_TRUE(scene.world.volume.empty());
  EXPECT_EQ(scene.world.obstacle(3).center, Vec3(4, 0, 0));
  EXPECT_EQ(scene.world.obstacle(3).restitution, 0.5);
  EXPECT_FALSE(scene.roster.fixed[2].visible);
}

TEST(BodyErrors, VolumeIsMissingOrThereTwice) {
  EXPECT_EQ(in_parts(errors_of(start + "bodies: {a: {mass: 1, position: [0, 0, 0]}}\n")),
            (Parts{{"3:10 a", "body `a` has no `radius` and no `cylinder` and no `box` and no `fit`",
                    "expected `radius`: a number above 0 in m\n"
                    "or `cylinder`: a map of keys\n"
                    "or `box`: [x, y, z], three numbers above 0 in m\n"
                    "or `fit`: sphere, cylinder or box"}}));
  EXPECT_EQ(in_parts(errors_of(start + "bodies: {a: {mass: 1, box: [1, 1, 1], radius: 3, position: [0, 0, 0]}}\n")),
            (Parts{{"3:39 radius", "body `a` has both `box` and `radius`", "remove one of them"}}));
}

TEST(BodyErrors, EdgesAndHeightsAreAboveZero) {
  EXPECT_EQ(in_parts(errors_of(start + "bodies: {a: {mass: 1, box: [1, 0, 1], position: [0, 0, 0]}}\n")),
            (Parts{{"3:32 0", "a number of `box` is 0", "expected a number above 0 in m"}}));
  EXPECT_EQ(in_parts(errors_of(start + "obstacles: {a: {cylinder: {radius: 1}, position: [0, 0, 0]}}\n")),
            (Parts{{"3:17 cylinder", "`cylinder` has no `height`", "expected `height`: a number above 0 in m"}}));
  EXPECT_NE(errors_of(start + "defaults: {body: {cylinder: {radius: 1}}}\n").find("has no `height`"), string::npos);
}

TEST(BodyErrors, ObstaclesHaveNoMass) {
  EXPECT_EQ(in_parts(errors_of(start + "obstacles: {a: {mass: 1, radius: 1, position: [0, 0, 0]}}\n")),
            (Parts{{"3:17 mass", "unknown key `mass` in obstacle `a`",
                    "`mass` is a key of `ball`, `body` or `placed`\n"
                    "expected radius, cylinder, box, mesh, fit, position, inside, open, motion, restitution, color, "
                    "finish, opacity, "
                    "visible or "
                    "repeat"}}));
}

TEST(Overlaps, OfEveryVolumeWithEveryOtherAreErrors) {
  EXPECT_EQ(
      in_parts(errors_of(start + "balls: {b: {mass: 1, radius: 0.5, position: [1.25, 0, 0]}}\n"
                                 "bodies: {crate: {mass: 1, box: [2, 2, 2], position: [0, 0, 0]}}\n"
                                 "planes: {floor: {point: [0, -0.5, 0], normal: [0, 1, 0]}}\n"
                                 "obstacles: {pile: {box: [4, 1, 1], position: [0, 0.75, 0]}}\n")),
      (Parts{{"3:45 [", "`b` overlaps `pile` by 0.25 m at the start", "expected bodies apart, or just touching"},
             {"4:53 [", "`crate` overlaps `b` by 0.25 m at the start", "expected bodies apart, or just touching"},
             {"4:53 [", "`crate` overlaps `floor` by 0.5 m at the start", "expected bodies apart, or just touching"},
             {"4:53 [", "`crate` overlaps `pile` by 0.75 m at the start", "expected bodies apart, or just touching"}}));
}

TEST(Overlaps, BodyWhollyInsideAnObstacleIsOne) {
  EXPECT_NE(errors_of(start + "balls: {b: {mass: 1, radius: 0.01, position: [0.5, 0, 0]}}\n"
                              "obstacles: {block: {box: [4, 4, 4], position: [0, 0, 0]}}\n")
                .find("`b` overlaps `block` by 1.51 m"),
            string::npos);
}

TEST(Overlaps, TouchingVolumesAreRight) {
  EXPECT_EQ(
      errors_of(start +
                "defaults: {body: {mass: 1, box: [0.1, 0.3, 0.7]}}\n"
                "bodies: {a: {position: [0, 0.15, 0]}, b: {position: [0.1, 0.15, 0]}, c: {position: [0, 0.45, 0]}}\n"
                "balls: {d: {mass: 1, radius: 0.1, position: [0, 0.7, 0]}}\n"
                "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n"
                "obstacles: {shelf: {box: [1, 1, 1], position: [0.65, 0.5, 0]},\n"
                "            inner: {box: [1, 1, 1], position: [0.66, 0.5, 0]}}\n"),
      "");
}

TEST(Overlaps, BehindAPlaneIsReportedForAnyVolume) {
  EXPECT_NE(errors_of(start + "bodies: {a: {mass: 1, box: [9, 1, 9], position: [0, -0.6, 0]}}\n"
                              "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n")
                .find("`a` is behind `floor` at the start"),
            string::npos);
  EXPECT_NE(errors_of(start + "bodies: {a: {mass: 1, box: [9, 1, 9], position: [0, -0.4, 0]}}\n"
                              "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n")
                .find("`a` overlaps `floor` by 0.9 m at the start"),
            string::npos);
}

TEST(Overlaps, GroupsKeepClearOfBodiesAndObstacles) {
  const Scene scene = load_text(start +
                                "bodies: {crate: {mass: 1, box: [1, 1, 1], position: [0.5, 0.5, 0.5]}}\n"
                                "groups: {gas: {count: 300, ball: {mass: 1, radius: 0.05}, in: {min: [0, 0, 0], max: "
                                "[2, 2, 2]}}}\n"
                                "obstacles: {block: {box: [1, 1, 1], position: [1.5, 1.5, 1.5]}}\n");
  for (Entity i = 1; i <= 300; ++i) {
    for (const Vec3& center : {Vec3(0.5, 0.5, 0.5), Vec3(1.5, 1.5, 1.5)}) {
      const Vec3 outside = ((scene.initial.position[i] - center).cwiseAbs() - Vec3(0.5, 0.5, 0.5)).cwiseMax(0);
      EXPECT_GT(outside.norm(), 0.05 * (1 - 1e-12));
    }
  }
}

TEST(Meshes, FitGivesTheTightestVolumeAndItsCentre) {
  int reads = 0;
  const Scene scene = load_with_meshes(start +
                                           "bodies:\n"
                                           "  a: {mass: 1.5, mesh: pin.stl, fit: cylinder, position: [1, 0.19, 0]}\n"
                                           "  b: {mass: 1.5, mesh: ./pin.stl, fit: box, position: [2, 0.19, 0]}\n"
                                           "obstacles: {c: {mesh: pin.stl, fit: cylinder, position: [3, 0, 0]}}\n",
                                       with_reader(&reads));

  EXPECT_EQ(reads, 1);
  EXPECT_EQ(scene.world.volume[0].shape, Shape::cylinder);
  EXPECT_TRUE(scene.world.volume[0].half.isApprox(Vec3(0.06, 0.19, 0.06), 1e-15)) << scene.world.volume[0].half;
  EXPECT_EQ(scene.world.volume[1].shape, Shape::box);
  ASSERT_TRUE(scene.roster.bodies[0].mesh && scene.roster.fixed[0].mesh);
  EXPECT_TRUE(scene.roster.bodies[0].mesh->file.ends_with("/pin.stl"));
  EXPECT_TRUE(scene.roster.bodies[0].mesh->center.isApprox(Vec3(0, 0.19, 0), 1e-15));
  EXPECT_EQ(scene.roster.bodies[0].mesh->scale, 1);
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].copy, "pin.stl");
}

TEST(Meshes, OfFloatsAreTakenAsTheDecimalsThatWereWritten) {
  LoadOptions options;
  options.mesh_points = [](const string&) -> vector<Vec3> {
    return {Vec3(0.381F, 0.1F, 0), Vec3(0, 0.7F, 1.0F / 3), Vec3(0, 0, 1e-7F)};
  };
  const Scene scene =
      load_with_meshes(start + "obstacles: {a: {mesh: pin.stl, fit: box, position: [0, 0, 0]}}\n", options);
  const Vec3 edges = 2 * scene.world.obstacles[0].volume.half;
  EXPECT_DOUBLE_EQ(edges.x(), 0.381);
  EXPECT_DOUBLE_EQ(edges.y(), 0.7);
  EXPECT_DOUBLE_EQ(edges.z(), 0.33333334);
}

TEST(Meshes, WithoutFitAreDrawnScaledIntoTheVolume) {
  const Scene scene = load_with_meshes(start +
                                       "balls: {a: {mass: 1, radius: 2, position: [0, 0, 0], mesh: pin.stl}}\n"
                                       "bodies: {b: {mass: 1, cylinder: {radius: 0.6, height: 0.38}, position: [9, 0, "
                                       "0], mesh: pin.stl}}\n"
                                       "groups: {g: {count: 2, ball: {mass: 1, radius: 1, mesh: pin.stl}, in: {min: "
                                       "[20, 0, 0], max: [30, 10, 10]}}}\n");
  // The pin's smallest sphere goes through its foot and its tip: (h^2 + r^2) / (2 h) but for the tip's millimetre.
  const double tight = (0.38 * 0.38 + 0.06 * 0.06) / (2 * 0.38);
  EXPECT_NEAR(scene.roster.bodies[0].mesh->scale, 2 / tight, 2e-4);
  EXPECT_NEAR(scene.roster.bodies[2].mesh->scale, 1 / tight, 1e-4);
  EXPECT_NEAR(scene.roster.bodies[1].mesh->scale, 1, 1e-15);  // the height decides
  EXPECT_EQ(scene.world.radius[0], 2);
}

TEST(Meshes, OfTheResolvedSceneAreTheCopiesBesideIt) {
  const string text = start +
                      "bodies: {a: {mass: 1.5, mesh: sub/pin.stl, fit: cylinder, position: [1, 0.19, 0]}}\n"
                      "balls: {b: {mass: 1, radius: 1, position: [9, 0, 0], mesh: pin.stl}}\n";
  std::filesystem::create_directories(test_folder() + "/sub");
  write_file("solid\n", "sub/pin.stl");

  const Scene scene = load_with_meshes(text);
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.meshes[0].copy, "pin.stl");
  EXPECT_EQ(scene.meshes[1].copy, "pin-2.stl");
  EXPECT_NE(scene.resolved.find("a: {mass: 1.5, mesh: \"pin.stl\", fit: cylinder,"), string::npos);
  EXPECT_NE(scene.resolved.find("mesh: \"pin-2.stl\"}"), string::npos);

  write_file("solid\n", "pin-2.stl");
  const Scene again = load_with_meshes(scene.resolved);
  EXPECT_EQ(again.resolved, scene.resolved);
  EXPECT_EQ(again.world.radius, scene.world.radius);
}

TEST(Meshes, HaveTheirOwnColorsUnlessTheSceneGivesOne) {
  const string ball = "{mass: 1, radius: 1, mesh: pin.stl, position: ";
  const Scene scene = load_with_meshes(start + "balls:\n  a: " + ball + "[0, 0, 0]}\n  b: " + ball +
                                       "[9, 0, 0], color: red}\n  c: " + ball + "[20, 0, 0], color: {by: speed}}\n" +
                                       "obstacles:\n  d: {mesh: pin.stl, fit: box, position: [30, 0, 0]}\n"
                                       "  e: {mesh: pin.stl, fit: box, position: [40, 0, 0], color: red}\n");
  const auto own = [&](size_t body) { return scene.roster.bodies[body].mesh->own_colors; };

  EXPECT_TRUE(own(0));
  EXPECT_FALSE(own(1));
  EXPECT_FALSE(own(2));
  EXPECT_TRUE(scene.roster.fixed[0].mesh->own_colors);
  EXPECT_FALSE(scene.roster.fixed[1].mesh->own_colors);

  // The resolved scene gives them none either.
  const Scene again = load_with_meshes(scene.resolved);
  EXPECT_EQ(again.resolved, scene.resolved);
  EXPECT_TRUE(again.roster.bodies[0].mesh->own_colors && again.roster.fixed[0].mesh->own_colors);
  EXPECT_EQ(again.roster.bodies[0].color, scene.roster.bodies[0].color);
}

TEST(Meshes, WithMaterialsBesideThemAreNotCopied) {
  write_file("v 0 0 0\nmtllib pin.mtl\n", "pin.obj");
  const string ball = "{mass: 1, radius: 1, mesh: pin.obj, position: [0, 0, 0]";
  const Scene scene = load_with_meshes(start + "balls: {a: " + ball + "}}\n");
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].copy, "");
  write_file("v 0 0 0\nmtllib pin.mtl\n", "pin.obj");
  // In a colour of the scene it needs no materials.
  EXPECT_EQ(load_with_meshes(start + "balls: {a: " + ball + ", color: red}}\n").meshes[0].copy, "pin.obj");
}

TEST(MeshErrors, NameTheFileAndWhatIsWrongWithIt) {
  EXPECT_EQ(in_parts(mesh_errors(start + "bodies: {a: {mass: 1, mesh: torn.stl, fit: box, position: [0, 0, 0]}}\n")),
            (Parts{{"3:29 torn.stl", "the mesh `torn.stl` cannot be used: it ends within a triangle",
                    "expected a file of triangles with finite vertices"}}));
  EXPECT_EQ(in_parts(mesh_errors(start + "bodies: {a: {mass: 1, mesh: flat.stl, fit: box, position: [0, 0, 0]}}\n")),
            (Parts{{"3:29 flat.stl", "the mesh `flat.stl` is flat: its tightest box has no volume",
                    "expected a mesh with width, height and depth"}}));

  EXPECT_EQ(in_parts(mesh_errors(start + "bodies: {a: {mass: 1, mesh: pin.stl, fit: box, position: [0, 0, 0]}}\n", {})),
            (Parts{{"3:29 pin.stl", "the mesh `pin.stl` cannot be used: there is no reader of meshes here",
                    "expected a file of triangles with finite vertices"}}));
}

TEST(MeshErrors, FitAndMeshNeedOneAnother) {
  EXPECT_EQ(in_parts(mesh_errors(start + "bodies: {a: {mass: 1, mesh: pin.stl, position: [0, 0, 0]}}\n")),
            (Parts{{"3:10 a", "body `a` has a `mesh` but no volume",
                    "expected `fit`: sphere, cylinder or box, the tightest one around the mesh"}}));
  EXPECT_EQ(in_parts(errors_of(start + "obstacles: {a: {fit: box, position: [0, 0, 0]}}\n")),
            (Parts{{"3:17 fit", "obstacle `a` has `fit` but no `mesh`",
                    "expected `mesh`: the path of a file, relative to the folder of the scene, or a map of keys"}}));
}

TEST(Meshes, InOtherUnitsAndAxesAreTheSameBody) {
  const string rest = "mass: 1.5, fit: cylinder, position: [1, 0.19, 0]";
  const Scene plain = load_with_meshes(start + "bodies: {a: {mesh: pin.stl, " + rest + "}}\n");

  struct Case {
    const char* how;
    function<Vec3(const Vec3&)> axes;  // of the file, of a point of the pin
  };
  const Case cases[] = {
      {"scale: 0.001", [](const Vec3& p) { return p; }},
      // The file's z is up, and its y points away from the viewer, who looks along -z.
      {"scale: 0.001, up: z", [](const Vec3& p) { return Vec3(p.x(), -p.z(), p.y()); }},
      {"scale: 0.001, up: x", [](const Vec3& p) { return Vec3(p.y(), -p.x(), p.z()); }},
      {"scale: 0.001, turn: [0, 0, 90]", [](const Vec3& p) { return Vec3(p.y(), -p.x(), p.z()); }},
      {"scale: 0.001, turn: [-90, 0, 0]", [](const Vec3& p) { return Vec3(p.x(), -p.z(), p.y()); }},
      // About x first, then about y: the file's x is up only with the order of the two.
      {"scale: 0.001, turn: [90, 0, 90], up: y", [](const Vec3& p) { return Vec3(p.y(), p.z(), p.x()); }},
      // The turn comes after `up`.
      {"scale: 0.001, up: z, turn: [0, 90, 0]", [](const Vec3& p) { return Vec3(-p.z(), -p.x(), p.y()); }},
  };

  for (const Case& one : cases) {
    LoadOptions options = with_reader();
    options.mesh_points = [&](const string&) { return drawn_pin(one.axes); };
    const Scene scene =
        load_with_meshes(start + "bodies: {a: {mesh: {file: pin.stl, " + one.how + "}, " + rest + "}}\n", options);
    EXPECT_TRUE(scene.world.volume[0].half.isApprox(plain.world.volume[0].half, 1e-12)) << one.how;

    // Each vertex is drawn where that of the plain pin is.
    const MeshUse &use = *scene.roster.bodies[0].mesh, &known = *plain.roster.bodies[0].mesh;
    const vector<Vec3> file = drawn_pin(one.axes);
    for (size_t i = 0; i < pin.size(); ++i)
      EXPECT_LT((use.scale * (turned(use.turn, file[i]) - use.center) - (pin[i] - known.center)).norm(), 1e-12)
          << one.how << i;
    EXPECT_EQ(load_with_meshes(scene.resolved, options).resolved, scene.resolved);
  }
}

TEST(Meshes, AreTurnedAndNeverMirrored) {
  for (const UpAxis up : {UpAxis::x, UpAxis::y, UpAxis::z}) {
    const MeshTurn turn = mesh_turn(up, Vec3(30, -70, 200.5));
    EXPECT_NEAR(turn[0].cross(turn[1]).dot(turn[2]), 1, 1e-14);
    const MeshTurn plain = mesh_turn(up, Vec3(0, 0, 0));
    EXPECT_EQ(turned(plain, Vec3::Unit(int(up))), Vec3(0, 1, 0));
  }
  EXPECT_EQ(mesh_turn(UpAxis::y, Vec3(0, 0, 0)), no_turn);
  // About x, then y, then z: z goes to -y, stays, and goes to x.
  EXPECT_EQ(turned(mesh_turn(UpAxis::y, Vec3(90, 90, 90)), Vec3(0, 0, 1)), Vec3(1, 0, 0));
  EXPECT_LT((turned(mesh_turn(UpAxis::y, Vec3(30, 0, 0)), Vec3(0, 1, 0)) - Vec3(0, sqrt(3.0) / 2, 0.5)).norm(), 1e-15);
}

TEST(Meshes, InAGivenVolumeHaveItsSizeWhateverTheirScale) {
  const string body = "{mass: 1, radius: 2, position: [0, 0, 0], mesh: ";
  const Scene plain = load_with_meshes(start + "balls: {a: " + body + "pin.stl}}\n");
  const Scene scaled = load_with_meshes(start + "balls: {a: " + body + "{file: pin.stl, scale: 0.001}}}\n");
  EXPECT_EQ(scaled.roster.bodies[0].mesh->scale, plain.roster.bodies[0].mesh->scale);
}

TEST(Meshes, OfBallsOfManyRadiiAreAsLargeAsEach) {
  const Scene scene = load_with_meshes(
      start + "groups: {g: {count: 3, in: {radius: 9}, ball: {mass: 1, radius: {from: 0.5, to: 1}, mesh: pin.stl}}}\n");
  const Scene one = load_with_meshes(start + "balls: {a: {mass: 1, radius: 1, position: [0, 0, 0], mesh: pin.stl}}\n");
  for (Entity i = 0; i < 3; ++i)
    EXPECT_DOUBLE_EQ(scene.roster.bodies[0].mesh->scale_for(scene.world.radius[i]),
                     one.roster.bodies[0].mesh->scale * scene.world.radius[i]);
  EXPECT_EQ(one.roster.bodies[0].mesh->scale_for(1), one.roster.bodies[0].mesh->scale);
}

TEST(Meshes, KeepTheirFileWhenASettingGivesAnotherPart) {
  LoadOptions options = with_reader();
  options.set = {"bodies.a.mesh.scale=0.5"};
  for (const char* mesh : {"pin.stl", "{file: pin.stl, scale: 3}"}) {
    const Scene scene = load_with_meshes(
        start + "bodies: {a: {mass: 1, fit: cylinder, position: [1, 0.19, 0], mesh: " + mesh + "}}\n", options);
    EXPECT_NEAR(scene.world.volume[0].half.y(), 0.095, 1e-12);
  }
}

TEST(Meshes, ThatAreGivenWrongAreRefused) {
  const auto errors = [](const string& mesh) {
    return in_parts(mesh_errors(start + "bodies: {a: {mass: 1, fit: box, position: [0, 0, 0], mesh: " + mesh + "}}\n"));
  };
  EXPECT_EQ(errors("{scale: 0.001}"),
            (Parts{{"3:54 mesh", "`mesh` has no `file`",
                    "expected `file`: the path of a file, relative to the folder of the scene"}}));
  EXPECT_EQ(errors("{file: pin.stl, scale: 0}"), (Parts{{"3:83 0", "`scale` is 0", "expected a number above 0 in m"}}));
  EXPECT_EQ(errors("{file: pin.stl, up: w}"), (Parts{{"3:80 w", "`up` is `w`", "expected x, y or z"}}));
  EXPECT_EQ(errors("{file: pin.stl, turn: 30}"),
            (Parts{{"3:82 30", "`turn` is `30`", "expected [x, y, z], three numbers from -360 to 360 in degrees"}}));

  EXPECT_EQ(errors("{file: none.stl}"),
            (Parts{{"3:67 none.stl", "there is no file `none.stl`", "paths are relative to the folder of the scene"}}));
  EXPECT_EQ(errors("{file: pin.stl, scale: 1e30}").size(), 0u);
  EXPECT_EQ(errors("[pin.stl]").size(), 1u);
}

}  // namespace
}  // namespace carom
