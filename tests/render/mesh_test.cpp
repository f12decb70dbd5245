// Meshes: files that are read; any other file fails with an error.
#include "render/mesh.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "paths.h"
#include "render/colored_meshes.h"
#include "render/mesh_folder.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

using test::MeshFolder;

const string data = DATA_DIR "/meshes/";
const string scenes = SCENES_DIR "/meshes/";

string bytes_of(const string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// "" if the file is read.
string trouble(const string& path, const MeshLimits& limits = {}) {
  return test::trouble_of(read_mesh, path, limits);
}

const char* const triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(ReadMesh, ATetrahedronOfStlHasFourFacesWithNormalsOfTheirOwn) {
  const Mesh mesh = read_mesh(data + "tetrahedron.stl");
  EXPECT_EQ(mesh.triangles.size(), 12U);
  ASSERT_EQ(mesh.vertices.size(), 12U);  // sharp edges: each corner belongs to three faces
  for (size_t t = 0; t < 12; t += 3) {
    const Vec3 &a = mesh.vertices[mesh.triangles[t]], &b = mesh.vertices[mesh.triangles[t + 1]],
               &c = mesh.vertices[mesh.triangles[t + 2]];
    EXPECT_LT((mesh.normals[mesh.triangles[t]] - (b - a).cross(c - a).normalized()).norm(), 1e-7);
  }
}

/// A tetrahedron as a text.
string stl_text(const string& name) {
  string text = "solid " + name + "\n";
  for (const char* face : {"0 0 0,0 1 0,1 0 0", "0 0 0,1 0 0,0 0 1", "0 0 0,0 0 1,0 1 0", "1 0 0,0 1 0,0 0 1"}) {
    string corners = face;
    for (size_t i = 0; (i = corners.find(',', i)) != string::npos;) corners.replace(i, 1, "\n      vertex ");
    text += "  facet normal 0 0 0\n    outer loop\n      vertex " + corners + "\n    endloop\n  endfacet\n";
  }
  return text + "endsolid " + name + "\n";
}

string in_capitals(string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 32);
  return text;
}

string replaced(string text, const string& part, const string& by) {
  return text.replace(text.find(part), part.size(), by);
}

TEST(ReadMesh, AnStlFileIsReadInAnyCaseWithEmptySolidsAndBytesBehind) {
  const MeshFolder folder;
  const Mesh right = read_mesh(folder.write("right.stl", stl_text("t")));
  ASSERT_EQ(right.triangles.size(), 12U);
  const string binary = bytes_of(data + "tetrahedron.stl");
  ASSERT_EQ(binary.size(), 84U + 4 * 50);

  const auto same = [&](const string& bytes, const Mesh& as) {
    const Mesh mesh = read_mesh(folder.write("a.stl", bytes));
    EXPECT_EQ(mesh.vertices, as.vertices) << bytes.substr(0, 40);
    EXPECT_EQ(mesh.triangles, as.triangles) << bytes.substr(0, 40);
  };

  same(in_capitals(stl_text("t")), right);
  same(replaced(stl_text("t"), "facet normal", "Facet Normal"), right);
  same("solid first\nendsolid first\n" + stl_text("second"), right);
  same(stl_text("first") + "SOLID\nENDSOLID\n", right);
  same("\n  " + stl_text(""), right);

  const Mesh as_binary = read_mesh(data + "tetrahedron.stl");
  same(binary + "made by a program", as_binary);
  same(binary + string(500, '\0'), as_binary);
  same("solid" + binary.substr(5) + "x", as_binary);
}

TEST(ReadMesh, AnStlFileThatIsNoneIsRefusedWithItsPlace) {
  const MeshFolder folder;
  const auto why = [&](const string& bytes) { return trouble(folder.write("a.stl", bytes)); };
  EXPECT_EQ(why(replaced(stl_text("t"), "1 0 0", "1,5 0 0")), "line 6: `1,5` is not a number. Remedy: export it again");
  EXPECT_EQ(why(replaced(stl_text("t"), "1 0 0", "nan 0 0")),
            "line 6: `nan` is not a finite number. Remedy: export it again");

  EXPECT_EQ(why(replaced(stl_text("t"), "endloop", "vertex 1 1 1\nendloop")),
            "line 7: `vertex` stands in place of `endloop`. Remedy: export it again");
  EXPECT_EQ(why("hello\n"), "line 1: `hello` is no word of an STL file. Remedy: export it again");
  EXPECT_EQ(why(stl_text("t").substr(0, 100)),
            "line 6: it ends within a triangle: the file is cut off. Remedy: export it again");
  EXPECT_EQ(why("solid t\nendsolid t\n"), "it has no triangles");

  const string binary = bytes_of(data + "tetrahedron.stl");
  EXPECT_EQ(why(binary.substr(0, 200)),
            "it holds 2 of the 4 triangles that its header counts, or it is no STL file. Remedy: export it again");
  EXPECT_EQ(why(string(binary).replace(96, 4, string("\0\0\xC0\x7F", 4))),
            "triangle 1 has a corner that is not finite");
}

TEST(ReadMesh, ATriangleOfGltfWithAMissingVertexIsRefused) {
  const MeshFolder folder;
  const string text = test::GltfSquare{""}.text();
  ASSERT_EQ(trouble(folder.write("a.gltf", text)), "");
  EXPECT_EQ(trouble(folder.write("a.gltf", replaced(text, R"("count": 4)", R"("count": 3)"))),
            "a triangle refers to a missing vertex. Remedy: export it again");
}

TEST(ReadMesh, NodesOfGltfMoveTurnAndScale) {
  for (const char* name : {"turned_cube.gltf", "turned_cube.glb"}) {
    const Mesh mesh = read_mesh(data + name);
    Vec3 low = mesh.vertices[0], high = low;
    for (const Vec3& p : mesh.vertices) low = low.cwiseMin(p), high = high.cwiseMax(p);
    // The unit cube doubled, turned by 90 degrees about z, moved by (10, 0, 0).
    EXPECT_LT((low - Vec3(8, 0, 0)).norm(), 1e-6);
    EXPECT_LT((high - Vec3(10, 2, 2)).norm(), 1e-6);
    EXPECT_EQ(mesh.triangles.size(), 36U);
  }
}

TEST(ReadMesh, PolygonsAreCutCornersJoinedAndRoundedShapesSmooth) {
  const MeshFolder folder;
  const Mesh square = read_mesh(folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"));
  EXPECT_EQ(square.triangles.size(), 6U);
  EXPECT_EQ(square.vertices.size(), 4U);
  // A ridge of 60 degrees has two normals along its edge, one of 20 degrees has one.
  for (const auto& [height, vertices] : {pair{0.577, 6U}, {0.176, 4U}}) {
    const string text =
        "v 0 0 0\nv 0 0 1\nv 1 -" + to_string(height) + " 0\nv -1 -" + to_string(height) + " 0\nf 1 2 3\nf 2 1 4\n";
    EXPECT_EQ(read_mesh(folder.write("b.obj", text)).vertices.size(), vertices) << height;
  }
}

TEST(ReadMesh, TheSameFileGivesTheSameMesh) {
  const Mesh a = read_mesh(scenes + "duck.obj"), b = read_mesh(scenes + "duck.obj");
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(read_mesh_points(scenes + "duck.obj"), a.vertices);
}

TEST(ReadMesh, ThePinHasItsPublishedSize) {
  double low = 1, high = -1, radius = 0;
  for (const Vec3& p : read_mesh_points(scenes + "pin.obj")) {
    low = std::min(low, p.y()), high = std::max(high, p.y());
    radius = std::max(radius, hypot(p.x(), p.z()));
  }
  EXPECT_EQ(low, 0);
  EXPECT_NEAR(high, 15 * 0.0254, 1e-6);
  EXPECT_NEAR(radius, 4.766 / 2 * 0.0254, 2e-5);  // four digits in the file
}

TEST(ReadMesh, ReportsErrorsOfFiles) {
  const MeshFolder folder;
  EXPECT_EQ(trouble(folder.path + "none.obj"), "No such file or directory");
  EXPECT_EQ(trouble(folder.write("a.ply", "ply")), "meshes are read from files that end in .obj, .stl, .gltf, .glb");
  EXPECT_EQ(trouble(folder.write("noending", "x")), "meshes are read from files that end in .obj, .stl, .gltf, .glb");
  EXPECT_EQ(trouble(folder.write("empty.stl", "")), "it is empty");

  EXPECT_EQ(trouble(folder.write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")), "a vertex is not finite");
  EXPECT_EQ(trouble(folder.write("points.obj", "v 0 0 0\nv 1 0 0\nv 1 1 1\nv 2 2 2\n")), "it has no triangles");
  EXPECT_EQ(trouble(folder.write("lines.obj", "v 0 0 0\nv 1 0 0\nv 1 1 1\nl 1 2 3\n")), "it has no triangles");

  std::filesystem::create_directory(folder.path + "folder.obj");
  EXPECT_EQ(trouble(folder.path + "folder.obj"), "it is a folder");
  ASSERT_EQ(mkfifo((folder.path + "queue.obj").c_str(), 0600), 0);
  EXPECT_EQ(trouble(folder.path + "queue.obj"), "it is not a regular file");
  EXPECT_EQ(trouble("/dev/zero"), "meshes are read from files that end in .obj, .stl, .gltf, .glb");
}

TEST(ReadMesh, EndingsMayBeInCapitals) {
  const MeshFolder folder;
  EXPECT_EQ(trouble(folder.write("A.OBJ", triangle)), "");
}

TEST(ReadMesh, OtherFormatsUnderAKnownEndingAreNotRead) {
  const MeshFolder folder;
  const string x = "xof 0303txt 0032\nMesh m { 3; 0;0;0;, 1;0;0;, 0;1;0;; 1; 3;0,1,2;; }\n";
  for (const char* name : {"a.obj", "a.stl", "a.gltf"}) EXPECT_NE(trouble(folder.write(name, x)), "") << name;
}

TEST(ReadMesh, RefusesMoreThanItsLimits) {
  const string pin = scenes + "pin.obj";
  MeshLimits small;
  small.file_bytes = 1000;
  EXPECT_EQ(trouble(pin, small),
            "it has " + to_string(std::filesystem::file_size(pin)) + " bytes; at most 1000 are read");
  MeshLimits few;
  few.vertices = 100;
  EXPECT_EQ(trouble(pin, few), "it has more than 100 vertices");
  few = {};
  few.triangles = 100;
  EXPECT_EQ(trouble(pin, few), "it has more than 100 triangles");
}

TEST(ReadMesh, MaterialsOfOtherFoldersAreNotOpened) {
  // Opening a queue without a writer would block: the reader must not open it.
  const MeshFolder folder;
  std::filesystem::create_directory(folder.path + "in");
  ASSERT_EQ(mkfifo((folder.path + "queue").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo((folder.path + "in/queue").c_str(), 0600), 0);
  MeshLimits limits;
  limits.seconds = 1;
  EXPECT_EQ(trouble(folder.write("in/a.obj", string("mtllib ../queue\n") + triangle), limits), "");
  EXPECT_EQ(trouble(folder.write("in/b.obj", string("mtllib queue\n") + triangle), limits), "");
}

TEST(ReadMesh, WhatTakesTooLongIsEnded) {
  MeshLimits limits;
  limits.seconds = 0;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(trouble(scenes + "duck.obj", limits), "reading it takes longer than 0 s; it may be damaged");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(3));
}

TEST(ReadMesh, TooLittleMemoryIsReported) {
  NOT_WITH_SANITIZERS();
  const MeshFolder folder;
  string text;
  for (int i = 0; i < 150'000; ++i) text += "v " + to_string(i) + " 0 0\n";
  for (int i = 3; i < 150'000; ++i) text += "f 1 2 " + to_string(i) + "\n";
  MeshLimits limits;
  limits.memory_bytes = 10'000'000;
  EXPECT_EQ(trouble(folder.write("large.obj", text), limits), "reading it takes too much memory");
}

// By the robustness notes one in a few thousand crashes the reader, or hangs it; each must end in a mesh or a text.
TEST(ReadMesh, MutatedFilesGiveAMeshOrAText) {
  SLOW_WITH_SANITIZERS();
  const MeshFolder folder;
  MeshLimits limits;
  limits.seconds = 2;
  uint64_t seed = 21;
  const auto random = [&](size_t below) {
    seed = seed * 6364136223846793005U + 1442695040888963407U;
    return static_cast<size_t>((seed >> 33U) % below);
  };

  const string pin = bytes_of(scenes + "pin.obj").substr(0, 700) + "f 1 2 3\nf 4 5 6\n";
  int read = 0, refused = 0;
  for (const auto& [ending, bytes] : {pair{"stl", bytes_of(data + "tetrahedron.stl")},
                                      {"gltf", bytes_of(data + "turned_cube.gltf")},
                                      {"glb", bytes_of(data + "turned_cube.glb")},
                                      {"obj", pin}}) {
    for (int round = 0; round < 75; ++round) {
      string mutated = bytes;

      // Up to six bytes change, or go, or are copied.
      for (size_t i = random(6) + 1; i-- > 0;) {
        const size_t at = random(mutated.size());
        switch (random(4)) {
          case 0:
            mutated[at] = static_cast<char>(random(256));
            break;
          case 1:
            mutated[at] = static_cast<char>(mutated[at] ^ (1 << random(8)));
            break;

          case 2:
            mutated.insert(at, mutated.substr(random(mutated.size()), random(20)));
            break;
          default:
            mutated.erase(at, random(4) ? random(4) : mutated.size());
        }

        if (mutated.empty()) mutated = "x";
      }
      const string path = folder.write(string("m.") + ending, mutated);
      (trouble(path, limits).empty() ? read : refused) += 1;
    }
  }

  EXPECT_EQ(read + refused, 300);
  EXPECT_GT(read, 20);
  EXPECT_GT(refused, 20);
}

TEST(ReadMesh, LeavesNoProcessBehind) {
  const string before = bytes_of("/proc/self/task/" + to_string(getpid()) + "/children");
  trouble(scenes + "pin.obj");
  trouble("/none.obj");
  EXPECT_EQ(bytes_of("/proc/self/task/" + to_string(getpid()) + "/children"), before);
}

}  // namespace
}  // namespace carom
