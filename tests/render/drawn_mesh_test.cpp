// Meshes in pictures.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <tuple>

#include "paths.h"
#include "render/mesh.h"
#include "render/outlines.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

using test::grey;
using test::Point;
using test::projected;
using test::side;
using test::white;

const string meshes = SCENES_DIR "/meshes/";

/// One body, drawn as a mesh.
Scene mesh_scene(const string& file, const Vec3& position, const Vec3& center, double scale) {
  Scene scene = test::flat_scene(Vec3(1, 1.5, 5), Vec3::Zero());
  test::add_body(scene, position, Volume::sphere(1), white);
  scene.roster.bodies.back().mesh = MeshUse{file, center, scale};
  return scene;
}

/// The pixels whose centres lie behind a mesh's triangles, drawn at position + scale * (p - center).
vector<char> covered_by(const Mesh& mesh, const Scene& scene, Size size, const Vec3& position, const Vec3& center,
                        double scale) {
  vector<char> covered(static_cast<size_t>(size.width * size.height), 0);
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    array<Point, 3> q{};
    for (size_t k = 0; k < 3; ++k)
      q[k] = projected(scene, size, position + scale * (mesh.vertices[mesh.triangles[t + k]] - center));

    // Every pixel whose middle is inside.
    const auto [x0, x1] = std::minmax({q[0].x, q[1].x, q[2].x});
    const auto [y0, y1] = std::minmax({q[0].y, q[1].y, q[2].y});
    for (int y = std::max(0, static_cast<int>(y0)); y <= std::min(size.height - 1, static_cast<int>(y1)); ++y)
      for (int x = std::max(0, static_cast<int>(x0)); x <= std::min(size.width - 1, static_cast<int>(x1)); ++x) {
        const Point p{x + 0.5, y + 0.5};
        const double a = side(q[0], q[1], p), b = side(q[1], q[2], p), c = side(q[2], q[0], p);
        if ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0))
          covered[static_cast<size_t>(y * size.width + x)] = 1;
      }
  }
  return covered;
}

TEST(DrawnMesh, IsWhereItsVerticesAreToAPixel) {
  const Size size{300, 300};
  for (const auto& [name, center, scale] : {std::tuple{"pin.obj", Vec3(0, 0.1905, 0), 6.0},
                                            {"duck.obj", Vec3(0.1, 0.6, 0), 1.2},
                                            {"rock.stl", Vec3(0.05, 0, 0), 1.5}}) {
    const Vec3 position(0.3, -0.2, 0.1);
    const Scene scene = mesh_scene(meshes + name, position, center, scale);
    Renderer renderer(scene, size, 4);
    const Image& image = renderer.draw(scene.initial);

    const vector<char> covered = covered_by(read_mesh(meshes + name), scene, size, position, center, scale);
    int wrong = 0, inside = 0;

    // A pixel counts if its neighbours are all inside, or all outside.
    for (int y = 1; y + 1 < size.height; ++y)
      for (int x = 1; x + 1 < size.width; ++x) {
        int around = 0;
        for (int k = 0; k < 9; ++k)
          around += covered[static_cast<size_t>((y + k / 3 - 1) * size.width + x + k % 3 - 1)];
        if (around == 9) ++inside;
        if ((around == 9 && grey(image, x, y) < 40) || (around == 0 && grey(image, x, y) > 0)) ++wrong;
      }

    EXPECT_EQ(wrong, 0) << name;
    EXPECT_GT(inside, 2000) << name;
  }
}

/// A temporary file.
struct MeshText {
  explicit MeshText(const string& text) {
    if (!mkdtemp(folder.data())) ADD_FAILURE() << "no temporary folder";
    file = folder + "/mesh.obj";
    std::ofstream(file) << text;
  }
  ~MeshText() { std::filesystem::remove_all(folder); }
  string folder = ::testing::TempDir() + "carom_drawn_XXXXXX", file;
};

TEST(DrawnMesh, ThatIsTurnedIsThePictureOfTheTurnedFile) {
  // The pin in its file, and the same pin as another program writes it: z up, in millimetres.
  const Mesh pin = read_mesh(meshes + "pin.obj");
  string text;
  for (const Vec3& p : pin.vertices) text += fmt::format("v {} {} {}\n", 1000 * p.x(), -1000 * p.z(), 1000 * p.y());
  for (size_t t = 0; t < pin.triangles.size(); t += 3)
    text += fmt::format("f {} {} {}\n", pin.triangles[t] + 1, pin.triangles[t + 1] + 1, pin.triangles[t + 2] + 1);
  const MeshText z_up(text);

  const Size size{200, 200};
  const Vec3 position(0.3, -0.2, 0.1);
  Scene plain = mesh_scene(meshes + "pin.obj", position, Vec3(0, 0.1905, 0), 6);
  Scene other = mesh_scene(z_up.file, position, Vec3(0, 190.5, 0), 0.006);
  other.roster.bodies.back().mesh->turn = mesh_turn(UpAxis::z, Vec3::Zero());
  for (Scene* scene : {&plain, &other}) {
    scene->roster.bodies.back().mesh->turn =
        scene == &other ? mesh_turn(UpAxis::z, Vec3(0, 40, 20)) : mesh_turn(UpAxis::y, Vec3(0, 40, 20));
    // The centre is that of the turned mesh.
    const Vec3 centre = scene->roster.bodies.back().mesh->center;
    scene->roster.bodies.back().mesh->center = turned(mesh_turn(UpAxis::y, Vec3(0, 40, 20)), centre);
  }

  Renderer one(plain, size, 4), two(other, size, 4);
  const Image &a = one.draw(plain.initial), &b = two.draw(other.initial);
  int lit = 0, differing = 0;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      lit += grey(a, x, y) > 0;
      differing += std::abs(grey(a, x, y) - grey(b, x, y)) > 3;
    }
  EXPECT_GT(lit, 500);
  EXPECT_LT(differing, lit / 100);  // rounding of the file's floats
}

TEST(DrawnMesh, CastsItsOwnOutlineInParallelLight) {
  // A level L, of the square from -1 to 1 without its quarter x > 0, z > 0.
  const MeshText l("v -1 0 -1\nv 1 0 -1\nv 1 0 0\nv -1 0 0\nv 0 0 0\nv 0 0 1\nv -1 0 1\nf 1 2 3 4\nf 4 5 6 7\n");
  Scene scene;
  test::add_body(scene, Vec3(0, 3, 0), Volume::box(Vec3(2, 0.1, 2)), white);
  scene.roster.bodies.back().mesh = MeshUse{l.file, Vec3::Zero(), 1};
  test::add_ball(scene, Vec3(3, 0.3, 0), 0.3, white);
  test::add_plane(scene, Vec3::Zero(), Vec3(0, 1, 0), {0.5, 0.5, 0.5});

  Camera camera;
  camera.eye = Vec3(0, 8, 8);
  scene.camera = camera;
  scene.ambient = Color{0.2, 0.2, 0.2};
  scene.lights.push_back({"noon", Vec3(0, -1, 0), {}, white, 0.8});

  Renderer renderer(scene, {400, 400}, 4);
  const Image& image = renderer.draw(scene.initial);

  const auto light = [&](double x, double z) { return test::grey_at(image, scene, Vec3(x, 0, z)); };
  const double open = light(-2, 0);
  for (const auto& [x, z] : {pair{-0.5, -0.5}, {0.5, -0.5}, {-0.5, 0.5}, {0.85, -0.15}, {-0.15, 0.85}})
    EXPECT_LT(light(x, z), 0.55 * open) << x << ' ' << z;
  for (const auto& [x, z] : {pair{0.5, 0.5}, {0.12, 0.12}, {1.1, -0.5}, {-0.5, 1.1}})  // blur: 0.09 m
    EXPECT_GT(light(x, z), 0.75 * open) << x << ' ' << z;

  // And on a ball below.
  State state = scene.initial;
  const double lit = test::grey_at(image, scene, Vec3(3, 0.6, 0));
  state.position[1] = Vec3(-0.5, 0.3, -0.5);
  EXPECT_LT(test::grey_at(renderer.draw(state), scene, Vec3(-0.5, 0.6, -0.5)), 0.7 * lit);
}

TEST(DrawnMesh, IsShadedAlikeWhicheverWayItsFacesTurn) {
  const string corners = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n";
  const MeshText one(corners + "f 1 2 3 4\n"), other(corners + "f 4 3 2 1\n");
  array<double, 2> seen{};
  for (size_t i = 0; i < 2; ++i) {
    Scene scene = mesh_scene(i ? other.file : one.file, Vec3::Zero(), Vec3::Zero(), 1);
    scene.lights[0] = {"sun", Vec3(0, 0, -1), {}, white, 0.5};
    scene.ambient = Color{0.3, 0.3, 0.3};
    Renderer renderer(scene, {100, 100}, 4);
    seen[i] = grey(renderer.draw(scene.initial), 50, 50);
  }
  EXPECT_GT(seen[0], 100);
  EXPECT_NEAR(seen[0], seen[1], 1);
}

TEST(DrawnMesh, OfAJointBodyGivesWayToItsVolume) {
  Scene scene = mesh_scene(meshes + "pin.obj", Vec3::Zero(), Vec3(0, 0.1905, 0), 3);
  Renderer renderer(scene, {100, 100}, 4);
  const Point at = projected(scene, {100, 100}, Vec3(-0.8, 0, 0));
  EXPECT_EQ(grey(renderer.draw(scene.initial), static_cast<int>(at.x), static_cast<int>(at.y)), 0);
  State state = scene.initial;
  state.part_of = {0};
  state.mass = {2};
  state.radius = {1.2};
  state.volume = {Volume::sphere(1.2)};
  EXPECT_GT(grey(renderer.draw(state), static_cast<int>(at.x), static_cast<int>(at.y)), 40);
}

TEST(DrawnMesh, ThatCannotBeReadIsARenderError) {
  const Scene scene = mesh_scene("/none/at/all.obj", Vec3::Zero(), Vec3::Zero(), 1);
  try {
    Renderer renderer(scene, {10, 10}, 4);
    FAIL();
  } catch (const RenderError& error) {
    EXPECT_STREQ(error.what(), "cannot read the mesh /none/at/all.obj: No such file or directory");
  }
}

}  // namespace
}  // namespace carom
