// Materials and textures of mesh files: what is read, and errors.
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "paths.h"
#include "render/colored_meshes.h"
#include "render/mesh.h"
#include "render/texture_levels.h"
#include "std.h"

namespace carom {
namespace {

namespace fs = std::filesystem;
using test::data_uri;
using test::GltfSquare;
using test::MeshFolder;

/// "" if the file is read.
string painted_trouble(const string& path, const MeshLimits& limits = {}) {
  return test::trouble_of(read_painted_mesh, path, limits);
}

TEST(ReadPaintedMesh, HasNoPaintWithoutMaterials) {
  const string pin = SCENES_DIR "/meshes/pin.obj";
  const Mesh painted = read_painted_mesh(pin), plain = read_mesh(pin);
  EXPECT_TRUE(painted.paint.parts.empty());
  EXPECT_EQ(painted.vertices, plain.vertices);
  EXPECT_EQ(painted.triangles, plain.triangles);
}

TEST(ReadPaintedMesh, AloneLooksAtTextures) {
  const MeshFolder folder;
  const string file = folder.write("a.gltf", GltfSquare{"none.png"}.text());
  EXPECT_EQ(read_mesh(file).triangles.size(), 6U);
  EXPECT_EQ(read_mesh_points(file).size(), 4U);
  EXPECT_NE(painted_trouble(file), "");
}

TEST(ReadPaintedMesh, OptionsOfAWavefrontTextureAreUsedOrNamed) {
  const MeshFolder folder;
  folder.write("four.png", test::from_base64(test::four_colors));
  using Places = vector<array<float, 2>>;
  const auto places = [&](const string& options) {
    return read_painted_mesh(test::write_wavefront(folder, "newmtl paper\nmap_Kd " + options + " four.png\n")).paint.uv;
  };
  // u' = s u + o with v upwards; the picture's v is 1 - that. Corners: left lower, right lower, right upper, left
  // upper.
  EXPECT_EQ(places("-s 2 4 1 -o 0.25 0.5 0"), (Places{{0.25, 0.5}, {2.25, 0.5}, {2.25, -3.5}, {0.25, -3.5}}));
  EXPECT_EQ(places("-o 0.5 -clamp on -s 2"), (Places{{0.5, 1}, {2.5, 1}, {2.5, 0}, {0.5, 0}}));
  EXPECT_EQ(places("-blendu on -bm 1.0 -texres 512"), (Places{{0, 1}, {1, 1}, {1, 0}, {0, 0}}));
  EXPECT_EQ(
      painted_trouble(test::write_wavefront(folder, "newmtl paper\nKd 1 1 1\nmap_Kd -mm 0 2 four.png\n")),
      "line 3 of its material file square.mtl: the option -mm of map_Kd is not used. Remedy: remove the option, or "
      "give the body a `color`");
  folder.write("my picture.png", test::from_base64(test::four_colors));
  EXPECT_EQ(painted_trouble(test::write_wavefront(folder, "newmtl paper\nmap_Kd -s 1 1 1 my picture.png\n")), "");
}

TEST(ReadPaintedMesh, OfEachMaterialIsAPart) {
  const MeshFolder folder;
  folder.write("a.mtl", "newmtl red\nKd 1 0 0\nnewmtl paper\nmap_Kd -clamp on four.png\n");
  folder.write("four.png", test::from_base64(test::four_colors));
  const Mesh mesh = read_painted_mesh(folder.write(
      "a.obj",
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0.5 0.25\nusemtl red\nf 1/1 2/2 3/3\n"
      "usemtl paper\nf 1/1 2/2 4/3\nf 2/1 3/2 4/3\nusemtl missing\nf 1/1 3/2 4/3\n"));

  ASSERT_EQ(mesh.paint.parts.size(), 3U);
  uint32_t triangles = 0, colored = 0, textured = 0;
  for (const MeshPart& part : mesh.paint.parts) {
    triangles += part.triangles, colored += part.colored;
    if (part.texture == 0) continue;
    ++textured;
    EXPECT_EQ(part.triangles, 2U);
    EXPECT_EQ(part.wrap, (array{Wrap::clamp, Wrap::clamp}));
    EXPECT_EQ(part.factor, (array{1.0F, 1.0F, 1.0F, 1.0F}));  // no Kd: white
  }

  EXPECT_EQ(triangles, 4U);
  EXPECT_EQ(colored, 2U);  // a material that no file defines gives no colour
  EXPECT_EQ(textured, 1U);

  ASSERT_EQ(mesh.paint.textures.size(), 1U);
  EXPECT_EQ(mesh.paint.textures[0].rgba,
            (vector<uint8_t>{255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255}));
}

TEST(ReadPaintedMesh, SamplersSayHowATextureGoesOn) {
  const MeshFolder folder;
  GltfSquare square{data_uri(test::four_colors)};
  square.sampler = R"("wrapS": 33648, "wrapT": 33071)";
  const MeshPart part = read_painted_mesh(folder.write("a.gltf", square.text())).paint.parts.at(0);
  EXPECT_EQ(part.wrap, (array{Wrap::mirror, Wrap::clamp}));
  EXPECT_EQ(part.sharp, 0U);
  square.sampler = R"("magFilter": 9728)";
  const MeshPart other = read_painted_mesh(folder.write("b.gltf", square.text())).paint.parts.at(0);
  EXPECT_EQ(other.wrap, (array{Wrap::repeat, Wrap::repeat}));
  EXPECT_EQ(other.sharp, 1U);
}

TEST(ReadPaintedMesh, TransformsOfTexturesMoveTurnAndScaleThem) {
  const MeshFolder folder;
  GltfSquare square{data_uri(test::four_colors)};
  square.texture =
      R"(, "extensions": {"KHR_texture_transform": {"offset": [0.25, 0.5], "rotation": 0.3, "scale": [2, 3]}})";
  const Mesh mesh = read_painted_mesh(folder.write("a.gltf", square.text()));
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    // Before: u from left to right, v from top to bottom. The turn is against the clock, with v downwards.
    const double u = 2 * (mesh.vertices[i].x() + 1) / 2, v = 3 * (1 - mesh.vertices[i].y()) / 2;
    EXPECT_NEAR(mesh.paint.uv[i][0], 0.25 + std::cos(0.3) * u + std::sin(0.3) * v, 1e-5);
    EXPECT_NEAR(mesh.paint.uv[i][1], 0.5 - std::sin(0.3) * u + std::cos(0.3) * v, 1e-5);
  }
}

TEST(ReadPaintedMesh, SurfacesAreSmoothAcrossTheSeamsOfTextures) {
  // A ridge of 20 degrees whose two faces have different places in the texture.
  const MeshFolder folder;
  folder.write("a.mtl", "newmtl red\nKd 1 0 0\n");
  const Mesh mesh = read_painted_mesh(folder.write(
      "a.obj",
      "mtllib a.mtl\nusemtl red\nv 0 0 0\nv 0 0 1\nv 1 -0.176 0\nv -1 -0.176 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\n"
      "f 1/1 2/2 3/3\nf 2/3 1/4 4/1\n"));
  ASSERT_EQ(mesh.vertices.size(), 6U);
  for (size_t i = 0; i < 6; ++i) {
    if (mesh.vertices[i].x() != 0) continue;
    EXPECT_LT((mesh.normals[i] - Vec3(0, 1, 0)).norm(), 1e-6);
  }
}

TEST(ReadPaintedMesh, ReadsTexturesBelowItsFolderAlone) {
  const MeshFolder folder;
  fs::create_directories(folder.path + "in/textures");
  folder.write("secret.png", test::from_base64(test::four_colors));
  folder.write("in/textures/my four.png", test::from_base64(test::four_colors));
  fs::create_symlink(folder.path + "secret.png", folder.path + "in/link.png");
  fs::create_directory_symlink(folder.path, folder.path + "in/out");

  const auto of = [&](const string& uri) { return painted_trouble(folder.write("in/a.gltf", GltfSquare{uri}.text())); };
  EXPECT_EQ(of("textures/my%20four.png"), "");
  EXPECT_EQ(of("textures/../textures/my four.png"), "");

  for (const string& uri : {string("../secret.png"), string("link.png"), string("out/secret.png"),
                            folder.path + "secret.png", string("textures")})
    EXPECT_EQ(of(uri),
              "its texture " + uri +
                  " is not a file in the mesh's folder. Remedy: copy it into that folder and name the copy, or "
                  "give the body a `color`");
}

TEST(ReadPaintedMesh, ReportsTexturesAndMaterialsThatCannotBeRead) {
  const MeshFolder folder;
  const auto of = [&](const string& name, const string& bytes) {
    folder.write(name, bytes);
    return painted_trouble(folder.write("a.gltf", GltfSquare{name}.text()));
  };

  EXPECT_EQ(of("a.webp", "RIFF1234WEBP"),
            "its texture a.webp is neither PNG nor JPEG. Remedy: convert it, or give the body a `color`");
  const string png = test::from_base64(test::four_colors), jpeg = test::from_base64(test::red_over_blue);
  const string damaged = " is damaged. Remedy: save it again, or give the body a `color`";
  EXPECT_EQ(of("a.png", png.substr(0, png.size() - 25)), "its texture a.png" + damaged);
  EXPECT_EQ(of("a.jpg", jpeg.substr(0, jpeg.size() - 12)), "its texture a.jpg" + damaged);

  MeshLimits limits;
  limits.texture_pixels = 3;
  EXPECT_EQ(painted_trouble(folder.write("b.gltf", GltfSquare{data_uri(test::four_colors)}.text()), limits),
            "its texture in the mesh has 2 x 2 pixels; at most 3 in all are read. Remedy: scale it down");

  const char* const triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_EQ(painted_trouble(folder.write("c.obj", string("mtllib none.mtl\nusemtl red\n") + triangle)),
            "its material file none.mtl is not there. Remedy: put it beside the mesh, or give the body a `color`");

  folder.write("d.mtl", "newmtl a\nKd 1 0 0\n");
  string many = "mtllib d.mtl\n";
  for (int i = 0; i <= 1000; ++i) many += "usemtl a\n";
  EXPECT_EQ(painted_trouble(folder.write("d.obj", many + triangle)),
            "it changes its material more than 1000 times. Remedy: sort its faces by material, or give the body a "
            "`color`");
}

TEST(ReadPaintedMesh, NamesTheFileThatDiffersInCase) {
  const MeshFolder folder;
  fs::create_directory(folder.path + "Textures");
  folder.write("Textures/four.PNG", test::from_base64(test::four_colors));
  const string remedy = " is. Remedy: write its name as on the disk";
  EXPECT_EQ(
      painted_trouble(folder.write("a.gltf", GltfSquare{"textures/Four.png"}.text())),
      "its texture textures/Four.png is not there, but Textures/four.PNG" + remedy + ", or give the body a `color`");

  // A glTF file has its triangles in another file.
  string text = GltfSquare{""}.text();
  const size_t at = text.find("data:"), end = text.find('"', at);
  text.replace(at, end - at, "Square.bin");
  EXPECT_EQ(painted_trouble(folder.write("b.gltf", text)),
            "its file Square.bin is not there. Remedy: put it beside the mesh");
  folder.write("square.bin", "");
  EXPECT_EQ(painted_trouble(folder.write("b.gltf", text)), "its file Square.bin is not there, but square.bin" + remedy);
}

TEST(ReadPaintedMesh, ScalesTexturesDownToItsLimit) {
  const MeshFolder folder;
  const string file = folder.write("a.gltf", GltfSquare{data_uri(test::checkers)}.text());
  MeshLimits limits;
  limits.texture_bytes = 2 * 4 * 16 * 16;  // shared with the default material, which has no texture
  const MeshTexture texture = read_painted_mesh(file, limits).paint.textures.at(0);
  EXPECT_EQ(texture.width, 16U);
  EXPECT_EQ(texture.height, 16U);
  // The mean of black and white light.
  for (size_t i = 0; i < texture.rgba.size(); ++i) EXPECT_EQ(texture.rgba[i], i % 4 == 3 ? 255 : 188);
}

TEST(TextureLevels, HaveTheMeanOfTheirAreaInLinearLight) {
  // Three pixels to two: each has one and a half.
  const MeshTexture three{3, 1, {255, 255, 255, 255, 0, 0, 0, 255, 255, 0, 0, 255}};
  const MeshTexture two = reduced(three, 2, 1);
  EXPECT_EQ(two.rgba, (vector<uint8_t>{213, 213, 213, 255, 213, 0, 0, 255}));  // sRGB of 2/3
  const vector<MeshTexture> levels = coarser_levels({5, 3, vector<uint8_t>(60, 200)});
  ASSERT_EQ(levels.size(), 2U);
  EXPECT_EQ(levels[0].width, 2U);
  EXPECT_EQ(levels[0].height, 1U);
  EXPECT_EQ(levels[1].rgba, (vector<uint8_t>(4, 200)));
}

TEST(TextureLevels, DoNotMixInColorsThatCannotBeSeen) {
  const MeshTexture two{2, 1, {10, 200, 30, 255, 255, 0, 255, 0}};
  EXPECT_EQ(reduced(two, 1, 1).rgba, (vector<uint8_t>{10, 200, 30, 128}));
}

}  // namespace
}  // namespace carom
