// Fixed things as triangles, and glTF files.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstring>
#include <nlohmann/json.hpp>

#include "physics/world.h"
#include "render/colored_meshes.h"
#include "render/glb.h"
#include "render/scenes.h"
#include "render/still_things.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

using Json = nlohmann::json;

Extent extent_of(const Mesh& mesh) {
  Extent extent;
  for (const Vec3& vertex : mesh.vertices) extent.include(vertex);
  return extent;
}

Scene room() {
  Scene scene;
  const Vec3 low(-1, 0, -2), high(3, 5, 2);
  for (int axis = 0; axis < 3; ++axis) {
    scene.world.planes.push_back({low, Vec3::Unit(axis), {}});
    scene.world.planes.push_back({high, -Vec3::Unit(axis), {}});
  }
  for (const char* name : {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"})
    scene.roster.fixed.push_back({string("room.") + name, {}, true});
  return scene;
}

Scene ball_at(const Vec3& position) {
  Scene scene;
  scene.world.mass = {1};
  scene.world.radius = {0.5};
  scene.world.restitution = {1};
  scene.initial.position = {position};
  scene.initial.velocity = {Vec3::Zero()};
  scene.roster.bodies = {{"ball", 0, 1, false, {0.5, 0.5, 0.5}}};
  return scene;
}

Json json_of(const string& file) {
  uint32_t size = 0;
  std::memcpy(&size, file.data() + 12, sizeof size);
  return Json::parse(file.substr(20, size));
}

TEST(StillThings, SidesOfARoomEndWhereTheyMeet) {
  Extent seen;
  seen.include(Vec3(1, 1, 1));
  const vector<StillThing> things = still_things(room(), seen, false);
  ASSERT_EQ(things.size(), 6U);
  for (const StillThing& thing : things) EXPECT_EQ(thing.mesh.vertices.size(), 4U) << thing.name;
  const Extent floor = extent_of(things[2].mesh);
  EXPECT_TRUE(floor.low.isApprox(Vec3(-1, 0, -2), 1e-14)) << floor.low.transpose();
  EXPECT_TRUE((floor.high - Vec3(3, 0, 2)).norm() < 1e-14) << floor.high.transpose();
}

TEST(StillThings, APlaneReachesBeyondTheMotionAndNotForEver) {
  Scene scene;
  scene.world.planes = {{Vec3(7, -1, 0), Vec3(0, 1, 0), {}}};
  scene.roster.fixed = {{"floor", {}, true}};
  Extent seen;
  seen.include(Vec3(-2, 0, -1)), seen.include(Vec3(2, 3, 1));
  const vector<StillThing> things = still_things(scene, seen, false);
  ASSERT_EQ(things.size(), 1U);
  const Extent floor = extent_of(things[0].mesh);
  EXPECT_TRUE((floor.low.array() <= Vec3(-2, -1, -1).array()).all());
  EXPECT_TRUE((floor.high.array() >= Vec3(2, -1, 1).array()).all());
  EXPECT_LT((floor.high - floor.low).norm(), 20);
  EXPECT_EQ(floor.low.y(), -1);
}

TEST(StillThings, TrianglesFaceTheFreeSide) {
  for (const StillThing& thing : still_things(room(), {}, false)) {
    const Mesh& mesh = thing.mesh;
    for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
      const Vec3 &a = mesh.vertices[mesh.triangles[t]], &b = mesh.vertices[mesh.triangles[t + 1]],
                 &c = mesh.vertices[mesh.triangles[t + 2]];
      EXPECT_GT((b - a).cross(c - a).dot(mesh.normals[mesh.triangles[t]]), 0) << thing.name;
    }
  }
}

TEST(StillThings, WhatIsNotVisibleIsNotThere) {
  Scene scene = room();
  for (FixedLook& name : scene.roster.fixed) name.visible = false;
  EXPECT_TRUE(still_things(scene, {}, false).empty());
}

TEST(StillThings, RoundVolumesHaveTheirCornersOnThem) {
  const Mesh ball = round_ball(), cylinder = round_cylinder();
  EXPECT_EQ(ball.triangles.size(), 3U * 2048);

  for (const Vec3& vertex : ball.vertices) EXPECT_NEAR(vertex.norm(), 1, 1e-15);
  for (const Vec3& vertex : cylinder.vertices) {
    EXPECT_NEAR(Vec3(vertex.x(), 0, vertex.z()).norm(), 1, 1e-15);
    EXPECT_EQ(std::abs(vertex.y()), 1);
  }

  for (const Mesh& mesh : {ball, cylinder})  // outside is where the normals point
    for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
      const Vec3 &a = mesh.vertices[mesh.triangles[t]], &b = mesh.vertices[mesh.triangles[t + 1]],
                 &c = mesh.vertices[mesh.triangles[t + 2]];
      EXPECT_GT((b - a).cross(c - a).dot(mesh.normals[mesh.triangles[t]]), 0);
    }
}

TEST(Glb, HasNodesACameraLightsAndSteps) {
  Scene scene = ball_at(Vec3(1, 1, 1));
  scene.title = "At one";
  scene.lights = {{"lamp", {}, Vec3(0, 3, 0), {}, 1}};
  scene.camera = Camera{.eye = Vec3(0, 1, 5), .target = Vec3(0, 1, 0)};
  KeyedMotion motion;
  motion.times = {0, 0.5, 1};
  motion.position = {{1, 1, 1}, {1, 2, 1}, {1, 3, 1}};
  motion.changes = {{1, 0, Volume::sphere(1)}, {2, 0, nullopt}};
  const Json gltf = json_of(glb(scene, motion));

  EXPECT_EQ(gltf["scenes"][0]["name"], "At one");
  EXPECT_EQ(gltf["nodes"][0]["name"], "ball");
  EXPECT_EQ(gltf["nodes"][0]["translation"], Json({1, 1, 1}));
  EXPECT_EQ(gltf["nodes"][0]["scale"], Json({0.5, 0.5, 0.5}));
  EXPECT_EQ(gltf["nodes"][1]["camera"], 0);
  EXPECT_NEAR(gltf["cameras"][0]["perspective"]["yfov"].get<double>(), 0.785398163, 1e-7);
  EXPECT_EQ(gltf["nodes"][2]["extensions"]["KHR_lights_punctual"]["light"], 0);
  EXPECT_EQ(gltf["extensions"]["KHR_lights_punctual"]["lights"][0]["type"], "point");
  // 0.5 in sRGB is 0.214 of the light.
  EXPECT_NEAR(gltf["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][0].get<double>(), 0.21404, 1e-5);

  const Json& animation = gltf["animations"][0];
  ASSERT_EQ(animation["channels"].size(), 2U);
  EXPECT_EQ(animation["samplers"][0]["interpolation"], "LINEAR");
  EXPECT_EQ(animation["channels"][1]["target"]["path"], "scale");
  EXPECT_EQ(animation["samplers"][1]["interpolation"], "STEP");
}

TEST(Glb, HasTheFinishesOfSurfaces) {
  const vector<Surface> surfaces = {{}, {Finish::metal, nullopt}, {Finish::glass, nullopt}, {Finish::glow, 0.5}};
  Scene scene;
  for (size_t i = 0; i < surfaces.size(); ++i) {
    test::add_ball(scene, Vec3(double(i), 0, 0), 0.5, Color{1, 0, 0});
    scene.roster.bodies[i].surface = surfaces[i];
  }
  const Json gltf = json_of(glb(scene, {}));

  const Json& materials = gltf["materials"];
  ASSERT_EQ(materials.size(), surfaces.size());
  vector<double> metallic, opacity;
  for (const Json& material : materials) {
    metallic.push_back(material["pbrMetallicRoughness"]["metallicFactor"].get<double>());
    opacity.push_back(material["pbrMetallicRoughness"]["baseColorFactor"][3].get<double>());
    EXPECT_EQ(material.value("alphaMode", "") == "BLEND", opacity.back() < 1);
  }
  EXPECT_EQ(metallic, (vector<double>{0, 1, 0, 0}));
  EXPECT_EQ(opacity, (vector<double>{1, 1, double{0.2F}, 0.5}));
  EXPECT_FALSE(materials[1].contains("emissiveFactor"));
  EXPECT_EQ(materials[3]["emissiveFactor"], Json({1, 0, 0}));
}

TEST(Glb, OfABodyWithoutAFinishIsThatOfPlastic) {
  const auto glb_with = [](optional<Finish> first, optional<Finish> second) {
    Scene scene;
    for (const optional<Finish>& finish : {first, second}) {
      test::add_ball(scene, Vec3(double(scene.world.body_count()), 0, 0), 0.5, Color{1, 0, 0});
      scene.roster.bodies.back().surface.finish = finish;
    }
    return glb(scene, {});
  };
  const string bytes = glb_with(nullopt, nullopt);
  EXPECT_EQ(glb_with(nullopt, Finish::plastic), bytes);
  EXPECT_EQ(glb_with(Finish::plastic, nullopt), bytes);
}

TEST(Glb, HasTheColorsAndTexturesOfMeshes) {
  const test::MeshFolder folder;
  test::GltfSquare square{test::data_uri(test::four_opacities)};
  square.material = R"(, "alphaMode": "MASK", "alphaCutoff": 0.25)";
  square.metallic = R"("baseColorFactor": [0.5, 0.25, 1, 1])";
  square.sampler = R"("magFilter": 9728, "wrapS": 33071, "wrapT": 33648)";
  square.vertex_colors = true;
  Scene scene = ball_at(Vec3::Zero());
  scene.roster.bodies[0].mesh = MeshUse{folder.write("a.gltf", square.text()), Vec3::Zero(), 1, true};
  KeyedMotion motion;
  const string file = folder.write("b.glb", glb(scene, motion));
  const Mesh before = read_painted_mesh(scene.roster.bodies[0].mesh->file), after = read_painted_mesh(file);

  EXPECT_EQ(after.vertices, before.vertices);
  EXPECT_EQ(after.triangles, before.triangles);
  EXPECT_EQ(after.paint.uv, before.paint.uv);
  EXPECT_EQ(after.paint.tint, before.paint.tint);
  ASSERT_EQ(after.paint.parts.size(), 1U);

  const MeshPart &a = after.paint.parts[0], &b = before.paint.parts[0];
  EXPECT_EQ(a.factor, b.factor);
  EXPECT_EQ(a.cutoff, b.cutoff);
  EXPECT_EQ(a.wrap, b.wrap);
  EXPECT_EQ(a.sharp, b.sharp);
  ASSERT_EQ(after.paint.textures.size(), 1U);
  EXPECT_EQ(after.paint.textures[0].rgba, before.paint.textures[0].rgba);

  // In a colour of the scene it has none of these.
  scene.roster.bodies[0].mesh->own_colors = false;
  EXPECT_TRUE(read_mesh(folder.write("c.glb", glb(scene, motion))).paint.parts.empty());
  EXPECT_FALSE(json_of(glb(scene, motion)).contains("textures"));
}

TEST(Glb, WritesAPictureOnceForMeshesThatWrapItDifferently) {
  const test::MeshFolder folder;
  Scene scene;
  for (const char* wrap : {"10497", "33071"}) {
    test::GltfSquare square{test::data_uri(test::four_colors)};
    square.sampler = string(R"("wrapS": )") + wrap;
    const Entity e = test::add_ball(scene, Vec3(3.0 * scene.world.body_count(), 0, 0), 1, {1, 1, 1});
    scene.roster.bodies[e].mesh = MeshUse{folder.write(string(wrap) + ".gltf", square.text()), Vec3::Zero(), 1, true};
  }

  const Json gltf = json_of(glb(scene, KeyedMotion{}));
  EXPECT_EQ(gltf["images"].size(), 1U);
  ASSERT_EQ(gltf["textures"].size(), 2U);
  EXPECT_EQ(gltf["samplers"][gltf["textures"][0]["sampler"].get<size_t>()]["wrapS"], 10497);
  EXPECT_EQ(gltf["samplers"][gltf["textures"][1]["sampler"].get<size_t>()]["wrapS"], 33071);
}

TEST(Glb, BodiesShareAMeshOfSeveralMaterials) {
  const test::MeshFolder folder;
  folder.write("a.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
  const string file = folder.write(
      "a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 2 4\n");
  Scene scene;
  for (const double scale : {1.0, 2.0, 1.0}) {
    const Entity e = test::add_ball(scene, Vec3(3.0 * scene.world.body_count(), 0, 0), 1, {1, 1, scale / 2});
    scene.roster.bodies[e].mesh = MeshUse{file, Vec3::Zero(), scale, true};
  }
  const Json gltf = json_of(glb(scene, KeyedMotion{}));
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(gltf["nodes"][i]["mesh"], i == 1 ? 1 : 0);
  for (size_t i = 0; i < 2; ++i) EXPECT_EQ(gltf["meshes"][i]["primitives"].size(), 2U);
}

TEST(Glb, BallsOfAGroupHaveMeshesAsLargeAsEach) {
  const test::MeshFolder folder;
  Scene scene;
  test::add_ball(scene, Vec3(0, 0, 0), 1, {1, 1, 1});
  test::add_ball(scene, Vec3(3, 0, 0), 0.5, {1, 1, 1});
  scene.roster.bodies.resize(1);
  scene.roster.bodies[0].count = 2;
  scene.roster.bodies[0].group = true;

  MeshUse& use = scene.roster.bodies[0].mesh.emplace();
  use.file = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n");
  use.reach = 1;
  const Json gltf = json_of(glb(scene, KeyedMotion{}));
  EXPECT_EQ(gltf["nodes"][0]["scale"], Json({1, 1, 1}));
  EXPECT_EQ(gltf["nodes"][1]["scale"], Json({0.5, 0.5, 0.5}));
  EXPECT_EQ(gltf["nodes"][1]["mesh"], gltf["nodes"][0]["mesh"]);
}

/// The floats of an accessor, in order.
vector<float> floats_of(const string& file, const Json& gltf, size_t accessor) {
  const Json& has = gltf["accessors"][accessor];
  const Json& view = gltf["bufferViews"][has["bufferView"].get<size_t>()];
  uint32_t json_size = 0;
  std::memcpy(&json_size, file.data() + 12, sizeof json_size);
  const size_t parts = has["type"] == "VEC4" ? 4 : has["type"] == "VEC3" ? 3 : 1;
  vector<float> floats(parts * has["count"].get<size_t>());
  const size_t at = 20 + json_size + 8 + view.value("byteOffset", size_t{0}) + has.value("byteOffset", size_t{0});
  std::memcpy(floats.data(), file.data() + at, floats.size() * sizeof(float));
  return floats;
}

TEST(Glb, AMeshIsTurnedInTheFile) {
  const test::MeshFolder folder;
  const string obj = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 2 3\nf 1 2 4\n");
  Scene scene = ball_at(Vec3(0, 0, 0));
  MeshUse& use = scene.roster.bodies[0].mesh.emplace();
  use.file = obj;
  use.turn = mesh_turn(UpAxis::z, Vec3::Zero());
  const string file = glb(scene, KeyedMotion{});
  const Json gltf = json_of(file);
  const Json& position = gltf["accessors"][gltf["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<size_t>()];
  // The file's z is up, and its y goes to -z.
  EXPECT_EQ(position["min"], Json({0, 0, -2}));
  EXPECT_EQ(position["max"], Json({1, 3, 0}));
}

TEST(Glb, ACameraThatMovesHasKeyframes) {
  Scene scene = ball_at(Vec3(0, 0, 0));
  KeyedMotion motion;
  for (int i = 0; i <= 8; ++i) {
    // Once around, so that the quaternion changes its sign.
    const double turn = M_PI / 4 * i;
    motion.times.push_back(0.5 * i);
    motion.position.push_back({0, 0, 0});
    motion.cameras.push_back({.eye = Vec3(5 * std::sin(turn), 1, 5 * std::cos(turn)), .target = Vec3(0, 1, 0)});
  }

  const string file = glb(scene, motion);
  const Json gltf = json_of(file);
  size_t node = 0;
  while (!gltf["nodes"][node].contains("camera")) ++node;
  EXPECT_EQ(gltf["nodes"][node]["translation"], Json({0, 1, 5}));

  vector<float> place, turned;
  for (const Json& channel : gltf["animations"][0]["channels"]) {
    if (channel["target"]["node"] != node) continue;
    const Json& sampler = gltf["animations"][0]["samplers"][channel["sampler"].get<size_t>()];
    EXPECT_EQ(floats_of(file, gltf, sampler["input"])[8], 4.0F);
    (channel["target"]["path"] == "rotation" ? turned : place) = floats_of(file, gltf, sampler["output"]);
  }

  ASSERT_EQ(place.size(), 27U);
  ASSERT_EQ(turned.size(), 36U);

  Eigen::Quaternionf before(turned[3], turned[0], turned[1], turned[2]);
  for (size_t i = 0; i < 9; ++i) {
    const Vec3& eye = motion.cameras[i].eye;
    EXPECT_LT((Vec3(place[3 * i], place[3 * i + 1], place[3 * i + 2]) - eye).norm(), 1e-6);
    const Eigen::Quaternionf q(turned[4 * i + 3], turned[4 * i], turned[4 * i + 1], turned[4 * i + 2]);
    const Eigen::Vector3f ahead = q * -Eigen::Vector3f::UnitZ();
    EXPECT_LT((ahead.cast<double>() - Vec3(-eye.x(), 0, -eye.z()).normalized()).norm(), 1e-6) << i;
    EXPECT_GE(q.dot(before), 0) << i;
    before = q;
  }
}

TEST(Glb, AThingOnASineIsThereAtItsKeyframesAndNearlySoBetweenThem) {
  Scene scene = ball_at(Vec3(0, 3, 0));
  scene.world.obstacles.push_back({{0, 1, 0}, Volume::box({1, 1, 1}), nullopt});
  scene.world.motions = {motion_on_sine({0, 0.5, 0}, 2, 0)};
  scene.roster.fixed.push_back({"table", Color{}, true});
  KeyedMotion motion;
  for (int i = 0; i < 3; ++i) {
    motion.times.push_back(i);
    motion.position.push_back({0, 3, 0});
  }

  const string file = glb(scene, motion);
  const Json gltf = json_of(file);
  size_t node = 0;
  while (gltf["nodes"][node]["name"] != "table") ++node;
  vector<float> times, places;
  for (const Json& channel : gltf["animations"][0]["channels"]) {
    if (channel["target"]["node"] != node) continue;
    const Json& sampler = gltf["animations"][0]["samplers"][channel["sampler"].get<size_t>()];
    times = floats_of(file, gltf, sampler["input"]);
    places = floats_of(file, gltf, sampler["output"]);
  }

  ASSERT_GT(times.size(), 70U);
  ASSERT_EQ(places.size(), 3 * times.size());
  EXPECT_EQ(times.back(), 2.0F);
  for (size_t k = 0; k + 1 < times.size(); ++k) {
    const auto height = [&](double t) { return 1 + 0.5 * std::sin(M_PI * t); };
    EXPECT_NEAR(places[3 * k + 1], height(times[k]), 1e-6) << k;
    const double between = 0.5 * (double{places[3 * k + 1]} + double{places[3 * k + 4]});
    EXPECT_NEAR(between, height(0.5 * (double{times[k]} + double{times[k + 1]})), 1e-3 * 0.5) << k;
  }
}

TEST(Glb, ACameraThatStandsStillHasNone) {
  Scene scene = ball_at(Vec3(0, 0, 0));
  KeyedMotion motion;
  for (int i = 0; i < 3; ++i) {
    motion.times.push_back(i);
    motion.position.push_back({0, 0, static_cast<float>(i)});
    motion.cameras.push_back({.eye = Vec3(0, 1, 5), .target = Vec3(0, 1, 0)});
  }
  EXPECT_EQ(json_of(glb(scene, motion))["animations"][0]["channels"].size(), 1U);
}

TEST(Glb, AParallelProjectionHasTheSizeOfThePictureAndTheEyeOfTheScene) {
  Scene scene;
  test::add_ball(scene, Vec3(0, 0, 0), 0.1, test::red);
  CameraPlan plan(Camera{.eye = Vec3(0, 0, 9), .target = Vec3(0, 0, 0), .fov = 90, .near = 1, .far = 50});
  plan.orthographic = true;
  scene.camera = plan;

  const Json gltf = json_of(glb(scene, KeyedMotion{}));
  const Json& camera = gltf["cameras"][0];
  EXPECT_EQ(camera["type"], "orthographic");
  EXPECT_NEAR(camera["orthographic"]["ymag"].get<double>(), 9, 1e-5);
  EXPECT_NEAR(camera["orthographic"]["xmag"].get<double>(), 16, 1e-5);
  EXPECT_NEAR(camera["orthographic"]["znear"].get<double>(), 1, 1e-5);
  EXPECT_NEAR(camera["orthographic"]["zfar"].get<double>(), 50, 1e-4);
  for (const Json& node : gltf["nodes"])
    EXPECT_NEAR(node.contains("camera") ? node["translation"][2].get<double>() : 9, 9, 1e-5);
}

TEST(Glb, ASceneOfNothingIsAnError) {
  EXPECT_THROW(glb(Scene{}, {}), runtime_error);
}

}  // namespace
}  // namespace carom
