// Meshes in the colours of their files, in pictures.
#include <gtest/gtest.h>

#include <numbers>

#include "numerics/srgb.h"
#include "paths.h"
#include "render/colored_meshes.h"
#include "render/mesh_colors.h"
#include "render/scenes.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

using test::black;
using test::blue;
using test::data_uri;
using test::GltfSquare;
using test::green;
using test::MeshFolder;
using test::red;
using test::white;

using Rgb = array<int, 3>;

constexpr Size square_size{100, 100};

/// The square in flat light, filling most of the picture.
Scene square_scene(const string& file, bool own_colors, const Color& color = {0.5, 0.25, 0.75}) {
  Scene scene = test::flat_scene(Vec3(0, 0, 3), Vec3::Zero());
  test::add_body(scene, Vec3::Zero(), Volume::sphere(1), color);
  scene.roster.bodies.back().mesh = MeshUse{file, Vec3::Zero(), 1, own_colors};
  return scene;
}

Rgb seen(const Image& image, int x, int y) {
  const uint8_t* p = image.row(y) + image.channels * x;
  return {p[0], p[1], p[2]};
}

/// The middles of the square's quarters: the upper left one, upper right, lower left, lower right.
array<Rgb, 4> quarters(const Scene& scene) {
  Renderer renderer(scene, square_size, 4);
  const Image& image = renderer.draw(scene.initial);
  return {seen(image, 29, 29), seen(image, 70, 29), seen(image, 29, 70), seen(image, 70, 70)};
}
array<Rgb, 4> quarters(const string& file) {
  return quarters(square_scene(file, true));
}

/// How pictures show the same square in one colour.
Rgb plain(const Color& color) {
  const MeshFolder folder;
  return quarters(square_scene(folder.write("a.gltf", GltfSquare{""}.text()), false, color))[0];
}

void expect_near(const Rgb& a, const Rgb& b, const char* what) {
  for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1) << what << ", component " << i;
}

Color grey_of_light(double light) {
  const double c = srgb_of_light(light);
  return {c, c, c};
}

TEST(MeshColors, ATextureStandsUprightInEveryFormat) {
  const MeshFolder folder;
  folder.write("four.png", test::from_base64(test::four_colors));
  const array<Rgb, 4> expected{plain(red), plain(green), plain(blue), plain(white)};
  EXPECT_EQ(quarters(folder.write("data.gltf", GltfSquare{data_uri(test::four_colors)}.text())), expected);
  EXPECT_EQ(quarters(folder.write("file.gltf", GltfSquare{"four.png"}.text())), expected);
  // Between pixels it is smooth, except in their middles.
  const auto wavefront = quarters(test::write_wavefront(folder, "newmtl paper\nmap_Kd four.png\n"));
  const char* const names[] = {"red", "green", "blue", "white"};
  for (size_t i = 0; i < 4; ++i)
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(wavefront[i][c], expected[i][c], 40) << names[i];
  const auto jpeg = quarters(folder.write("jpeg.gltf", GltfSquare{data_uri(test::red_over_blue, "image/jpeg")}.text()));
  for (size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(jpeg[0][c], expected[0][c], 3);
    EXPECT_NEAR(jpeg[3][c], expected[2][c], 3);
  }
}

TEST(MeshColors, APixelOfATextureHasItsColor) {
  const MeshFolder folder;
  // (12, 40, 64), (90, 128, 160); (200, 220, 240), (5, 250, 100).
  const auto shown =
      quarters(folder.write("a.gltf", GltfSquare{data_uri("iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAFklEQVR42mPg"
                                                          "0XCIaljAcOLOB9ZfKQAhcQXm8nhQegAAAABJRU5ErkJggg==")}
                                          .text()));
  const Color pixels[] = {from_rgb(0x0c2840), from_rgb(0x5a80a0), from_rgb(0xc8dcf0), from_rgb(0x05fa64)};
  for (size_t i = 0; i < 4; ++i) expect_near(shown[i], plain(pixels[i]), "pixel");
}

TEST(MeshColors, FactorsMultiplyTheTextureInLinearLight) {
  const MeshFolder folder;
  GltfSquare square{data_uri(test::four_colors)};
  square.metallic = R"("baseColorFactor": [0.5, 0.25, 1, 1])";
  const auto shown = quarters(folder.write("a.gltf", square.text()));
  const Color factor{srgb_of_light(0.5), srgb_of_light(0.25), 1};
  expect_near(shown[0], plain({factor.r, 0, 0}), "red");
  expect_near(shown[3], plain(factor), "white");
  // Kd is sRGB.
  expect_near(quarters(test::write_wavefront(folder, "newmtl paper\nKd 0.8 0.4 0.2\n"))[0], plain({0.8, 0.4, 0.2}),
              "Kd");
}

TEST(MeshColors, ColorsOfVerticesAreLinearInGltfAndSrgbInWavefront) {
  const MeshFolder folder;
  GltfSquare square{""};
  square.vertex_colors = true;
  // Red, half light, blue at the corners of the lower triangle, and a place in it.
  const double pixel = 3 * std::tan(std::numbers::pi / 8) / 50, x = 20.5 * pixel, y = -10.5 * pixel;
  const double first = (1 - x) / 2, second = (x - y) / 2, third = (1 + y) / 2;
  Scene scene = square_scene(folder.write("a.gltf", square.text()), true);
  Renderer renderer(scene, square_size, 4);
  expect_near(seen(renderer.draw(scene.initial), 70, 60),
              plain({srgb_of_light(first + second / 2), srgb_of_light(second / 2), srgb_of_light(second / 2 + third)}),
              "glTF");
  const string v = " 0.5 0.5 0.5\n";
  const string grey = "v -1 -1 0" + v + "v 1 -1 0" + v + "v 1 1 0" + v + "v -1 1 0" + v + "f 1 2 3 4\n";
  expect_near(quarters(folder.write("b.obj", grey))[0], plain({0.5, 0.5, 0.5}), "Wavefront");
}

TEST(MeshColors, AColorOfTheSceneTakesTheirPlace) {
  const MeshFolder folder;
  const string file = folder.write("a.gltf", GltfSquare{data_uri(test::four_colors)}.text());
  for (const Rgb& shown : quarters(square_scene(file, false, green))) EXPECT_EQ(shown, plain(green));
}

TEST(MeshColors, APartWithoutAMaterialHasTheBodysColor) {
  const MeshFolder folder;
  folder.write("a.mtl", "newmtl paper\nKd 0 1 0\n");
  const string file = folder.write("a.obj",
                                   "mtllib a.mtl\nv -1 -1 0\nv 0 -1 0\nv 0 1 0\nv -1 1 0\nv 1 -1 0\nv 1 1 0\n"
                                   "usemtl paper\nf 1 2 3 4\nusemtl missing\nf 2 5 6 3\n");
  const auto shown = quarters(square_scene(file, true, blue));
  EXPECT_EQ(shown[0], plain(green));
  EXPECT_EQ(shown[1], plain(blue));
  const raster::Float3 mean = mean_color(read_painted_mesh(file)).with({0, 0, 1});
  EXPECT_NEAR(mean[1], 0.5, 1e-6);
  EXPECT_NEAR(mean[2], 0.5, 1e-6);
}

TEST(MeshColors, AFileWithoutMaterialsIsDrawnInTheBodysColorToTheByte) {
  const MeshFolder folder;
  GltfSquare bare{""};
  bare.has_material = false;
  for (const string& file : {folder.write("a.gltf", bare.text()), string(SCENES_DIR "/meshes/duck.obj"),
                             folder.write("b.obj", "usemtl unknown\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n")}) {
    const Scene with = square_scene(file, true), without = square_scene(file, false);
    Renderer a(with, square_size, 4), b(without, square_size, 4);
    EXPECT_EQ(a.draw(with.initial).pixels, b.draw(without.initial).pixels) << file;
  }
}

TEST(MeshColors, OpacityBelowTheCutoffIsAHole) {
  const MeshFolder folder;
  GltfSquare square{data_uri(test::four_opacities)};
  const Rgb paper = plain(white), hole{0, 0, 0};
  EXPECT_EQ(quarters(folder.write("opaque.gltf", square.text())), (array<Rgb, 4>{paper, paper, paper, paper}));
  square.material = R"(, "alphaMode": "MASK", "alphaCutoff": 0.4)";
  EXPECT_EQ(quarters(folder.write("mask.gltf", square.text())), (array<Rgb, 4>{paper, hole, paper, paper}));
  square.material = R"(, "alphaMode": "BLEND")";
  EXPECT_EQ(quarters(folder.write("blend.gltf", square.text())), (array<Rgb, 4>{paper, hole, hole, paper}));
}

TEST(MeshColors, HolesLetTheLightThrough) {
  const MeshFolder folder;
  GltfSquare square{data_uri(test::four_opacities), R"(, "alphaMode": "MASK")"};
  array<double, 2> behind{};
  for (const bool masked : {false, true}) {
    if (!masked) square.material = "";
    if (masked) square.material = R"(, "alphaMode": "MASK")";

    Scene scene = square_scene(folder.write("a.gltf", square.text()), true);
    scene.lights[0] = {"ahead", Vec3(0, 0, -1), {}, white, 0.8};
    scene.ambient = Color{0.1, 0.1, 0.1};
    test::add_plane(scene, Vec3(0, 0, -1), Vec3(0, 0, 1), {0.5, 0.5, 0.5});
    scene.camera->eye = Vec3(6, 0.5, 4);
    scene.camera->target = Vec3(0, 0, -1);

    Renderer renderer(scene, square_size, 4);
    behind[masked ? 1 : 0] = test::grey(renderer.draw(scene.initial), 55, 44);
  }

  EXPECT_GT(behind[1], 1.5 * behind[0]);
}

TEST(MeshColors, FarCheckersBecomeTheirMeanInLinearLight) {
  const MeshFolder folder;
  GltfSquare square{data_uri(test::checkers)};
  Scene scene = square_scene(folder.write("a.gltf", square.text()), true);
  const Rgb mean = plain(grey_of_light(0.5));
  for (const double distance : {40.0, 60.0}) {
    scene.camera->eye = Vec3(0.13, 0.07, distance);
    Renderer renderer(scene, square_size, 4);
    expect_near(seen(renderer.draw(scene.initial), 50, 50), mean, "far");
  }
}

TEST(MeshColors, ABodyOfLessThanAPixelHasTheirMean) {
  const MeshFolder folder;
  const Mesh mesh = read_painted_mesh(folder.write("a.gltf", GltfSquare{data_uri(test::four_colors)}.text()));
  const MeanColor mean = mean_color(mesh);
  EXPECT_EQ(mean.plain, 0);
  for (const float component : mean.colored) EXPECT_NEAR(component, 0.5, 0.01);
}

TEST(MeshColors, ATextureThatIsMissingIsARenderErrorWithARemedy) {
  const MeshFolder folder;
  const string file = folder.write("a.gltf", GltfSquare{"wood.png"}.text());
  const Scene scene = square_scene(file, true);
  try {
    Renderer renderer(scene, square_size, 4);
    FAIL();
  } catch (const RenderError& error) {
    EXPECT_EQ(error.what(), "cannot read the mesh " + file +
                                ": its texture wood.png is not there. Remedy: put it beside the mesh, or give the body "
                                "a `color`");
  }
  // With a colour of the scene the texture is not looked at.
  EXPECT_EQ(quarters(square_scene(file, false, red))[0], plain(red));
}

}  // namespace
}  // namespace carom
