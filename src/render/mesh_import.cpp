// Imports a mesh with assimp, or an STL file without it, in the child process. Only readers for the file's ending are
// left, and only files of its own folder can be opened. Vertices and indices are checked here, so that a defect of a
// reader becomes an error. Normals are made here for files without them, because the smoothing of a shared vertex
// depends on the angle between faces. Texture coordinates and materials divide vertices: they are imported only for
// paint.
#include "render/mesh_import.h"

#include <assimp/BaseImporter.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>
#include <cstring>
#include <fstream>
#include <iterator>
#include <new>
#include <numeric>

#include "numerics/srgb.h"
#include "numerics/vec3.h"
#include "render/mesh_files.h"
#include "render/mesh_materials.h"
#include "render/stl.h"
#include "std.h"

namespace carom {
namespace {

/// Leaves only the readers for the file's ending. Otherwise its content may select any of them.
void keep_readers(Assimp::Importer& importer, const string& ending) {
  for (size_t i = importer.GetImporterCount(); i-- > 0;) {
    const string endings = string(" ") + importer.GetImporterInfo(i)->mFileExtensions + " ";
    if (endings.find(" " + ending + " ") == string::npos) importer.UnregisterLoader(importer.GetImporter(i));
  }
}

Vec3 vertex(const ImportedMesh& mesh, size_t i) {
  return Vec3(double{mesh.vertices[3 * i]}, double{mesh.vertices[3 * i + 1]}, double{mesh.vertices[3 * i + 2]});
}

constexpr double cos_smooth = 0.70710678118654752;  // cosine of 45 degrees
// Greatest number of triangles at a vertex for which normals are smoothed.
constexpr size_t most_around = 256;

/// Adds a vertex like this one, without its normal.
void repeat_vertex(ImportedMesh& mesh, size_t i) {
  for (size_t k = 0; k < 3; ++k) mesh.vertices.push_back(mesh.vertices[3 * i + k]);
  if (mesh.paint.uv.empty()) return;
  mesh.paint.uv.push_back(mesh.paint.uv[i]);
  mesh.paint.tint.push_back(mesh.paint.tint[i]);
}

/// By vertex from `first` on: the first of those at its position. Paint divides vertices, but not the surface.
vector<uint32_t> places(const ImportedMesh& mesh, size_t first) {
  vector<uint32_t> place(mesh.vertices.size() / 3 - first);
  std::iota(place.begin(), place.end(), 0U);
  if (mesh.paint.uv.empty()) return place;
  map<array<float, 3>, uint32_t> known;
  for (uint32_t v = 0; v < place.size(); ++v) {
    const float* p = &mesh.vertices[3 * (first + v)];
    place[v] = known.try_emplace({p[0], p[1], p[2]}, v).first->second;
  }
  return place;
}

/// Makes normals for the triangles from `triangle` on, with vertices from `first` on that have none. The normal at a
/// corner is the mean over triangles around it, weighted by area, that lean less than 45 degrees against its own. At
/// sharp edges a vertex is split into several.
void make_normals(ImportedMesh& mesh, size_t first, size_t triangle) {
  const size_t count = mesh.triangles.size() / 3 - triangle, vertices = mesh.vertices.size() / 3 - first;
  vector<Vec3> area(count), normal(count);
  vector<vector<uint32_t>> at_vertex(vertices), at_place(vertices);

  const vector<uint32_t> place = places(mesh, first);

  // The triangles at each vertex, and at each place.
  for (size_t t = 0; t < count; ++t) {
    const uint32_t* corner = &mesh.triangles[3 * (triangle + t)];
    const Vec3 a = vertex(mesh, corner[0]), b = vertex(mesh, corner[1]), c = vertex(mesh, corner[2]);
    area[t] = (b - a).cross(c - a);
    normal[t] = area[t].stableNormalized();

    for (int k = 0; k < 3; ++k) {
      at_vertex[corner[k] - first].push_back(uint32_t(t));
      at_place[place[corner[k] - first]].push_back(uint32_t(t));
    }
  }

  // A vertex has as many normals as the smooth surfaces that meet there. It is repeated for each further one.
  mesh.normals.resize(mesh.vertices.size(), 0);
  struct Made {
    Vec3 normal;
    uint32_t vertex;
  };
  vector<Made> made;

  for (size_t v = 0; v < vertices; ++v) {
    made.clear();
    const vector<uint32_t>& around = at_place[place[v]];

    for (const uint32_t t : at_vertex[v]) {
      Vec3 sum = area[t];
      // The mean of the faces that are smooth with this one.
      if (around.size() <= most_around) {
        sum.setZero();
        for (const uint32_t other : around)
          if (normal[other].dot(normal[t]) > cos_smooth || other == t) sum += area[other];
      }
      const Vec3 mean = sum.stableNormalized();

      uint32_t at = uint32_t(first + v);
      bool known = false;
      for (const Made& m : made)
        if (m.normal == mean) known = true, at = m.vertex;

      if (!known) {
        // The first one keeps its place.
        if (!made.empty()) {
          at = uint32_t(mesh.vertices.size() / 3);
          repeat_vertex(mesh, first + v);
          mesh.normals.resize(mesh.vertices.size());
        }

        for (int k = 0; k < 3; ++k) mesh.normals[3 * size_t{at} + size_t(k)] = float(mean[k]);
        made.push_back({mean, at});
      }

      for (size_t k = 0; k < 3; ++k) {
        uint32_t& corner = mesh.triangles[3 * (triangle + t) + k];
        if (corner == first + v) corner = at;
      }
    }
  }
}

void check_count(size_t count, size_t most, const char* what) {
  if (count > most) throw runtime_error("it has more than " + to_string(most) + " " + what);
}

void append_vertices(const aiMesh& part, ImportedMesh& mesh) {
  for (unsigned i = 0; i < part.mNumVertices; ++i)
    for (const float x : {part.mVertices[i].x, part.mVertices[i].y, part.mVertices[i].z}) {
      if (!isfinite(x)) throw runtime_error("a vertex is not finite");
      mesh.vertices.push_back(x);
    }
}

void append_triangles(const aiMesh& part, size_t first, ImportedMesh& mesh) {
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;
    for (unsigned k = 0; k < 3; ++k) {
      if (face.mIndices[k] >= part.mNumVertices) throw runtime_error("a triangle refers to a missing vertex");
      mesh.triangles.push_back(uint32_t(first + face.mIndices[k]));
    }
  }
}

void append_normals(const aiMesh& part, ImportedMesh& mesh) {
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& n = part.mNormals[i];
    const float length = sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    const bool known = isfinite(length) && length > 0;
    for (const float x : {n.x, n.y, n.z}) mesh.normals.push_back(known ? x / length : 0);
  }
}

void append_paint(const aiMesh& part, const PartSource& source, MeshPaint& paint) {
  const aiVector3D* const uv =
      source.uv_set < AI_MAX_NUMBER_OF_TEXTURECOORDS ? part.mTextureCoords[source.uv_set] : nullptr;

  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    array<float, 2> at{};
    for (size_t k = 0; uv && k < 2; ++k) {
      at[k] = source.uv[k][0] * uv[i].x + source.uv[k][1] * uv[i].y + source.uv[k][2];
      if (!isfinite(at[k])) at[k] = 0;
    }

    paint.uv.push_back(at);

    array<float, 3> tint{1, 1, 1};
    for (unsigned c = 0; part.mColors[0] && c < 3; ++c) {
      tint[c] = color_share(part.mColors[0][i][c]);
      if (source.srgb_tint) tint[c] = float(light_of_srgb(double{tint[c]}));
    }

    paint.tint.push_back(tint);
  }
}

void append(const aiMesh& part, MeshMaterials* materials, ImportedMesh& mesh, const MeshLimits& limits) {
  const size_t first = mesh.vertices.size() / 3, triangle = mesh.triangles.size() / 3;
  check_count(first + part.mNumVertices, limits.vertices, "vertices");
  check_count(triangle + part.mNumFaces, limits.triangles, "triangles");

  append_vertices(part, mesh);
  append_triangles(part, first, mesh);

  if (materials) {
    PartSource source = materials->of(part);
    append_paint(part, source, mesh.paint);
    source.part.triangles = uint32_t(mesh.triangles.size() / 3 - triangle);
    mesh.paint.parts.push_back(source.part);
  }

  if (part.mNormals) return append_normals(part, mesh);
  make_normals(mesh, first, triangle);
  check_count(mesh.vertices.size() / 3, limits.vertices, "vertices");
}

/// The triangles of an STL file, joined where corners are at one place.
ImportedMesh imported_stl(const string& path, const MeshLimits& limits) {
  std::ifstream in(path, std::ios::binary);
  const string bytes{std::istreambuf_iterator<char>(in), {}};
  const vector<array<float, 3>> corners = stl_corners(bytes);
  check_count(corners.size() / 3, limits.triangles, "triangles");
  if (corners.empty()) throw runtime_error("it has no triangles");

  // By place, with a number each. The first corner of a place comes first.
  vector<uint32_t> order(corners.size());
  std::iota(order.begin(), order.end(), 0U);
  ranges::stable_sort(order, [&](uint32_t a, uint32_t b) { return corners[a] < corners[b]; });

  vector<uint32_t> first(corners.size());
  for (size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && corners[order[i]] == corners[order[i - 1]] ? first[order[i - 1]] : order[i];

  ImportedMesh mesh;
  vector<uint32_t> number(corners.size());
  for (uint32_t i = 0; i < corners.size(); ++i) {
    if (first[i] == i) {
      number[i] = uint32_t(mesh.vertices.size() / 3);
      mesh.vertices.insert(mesh.vertices.end(), corners[i].begin(), corners[i].end());
    }
    mesh.triangles.push_back(number[first[i]]);
  }

  check_count(mesh.vertices.size() / 3, limits.vertices, "vertices");
  make_normals(mesh, 0, 0);
  check_count(mesh.vertices.size() / 3, limits.vertices, "vertices");
  return mesh;
}

/// What assimp only logs: it leaves out triangles that refer to missing vertices.
class MissingVertices : public Assimp::LogStream {
 public:
  void write(const char* text) override { seen_ = seen_ || std::strstr(text, "out-of-range indices") != nullptr; }
  bool seen() const { return seen_; }

 private:
  bool seen_ = false;
};

ImportedMesh imported(const string& path, const string& ending, bool painted, const MeshLimits& limits) {
  Assimp::Importer importer;
  auto* const files = new MeshFiles(path, ending, painted);
  // The importer owns it.
  importer.SetIOHandler(files);
  keep_readers(importer, ending);

  // What no mesh needs is dropped.
  int unwanted = aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
                 aiComponent_LIGHTS | aiComponent_CAMERAS;
  if (!painted) unwanted |= aiComponent_COLORS | aiComponent_TEXCOORDS | aiComponent_TEXTURES | aiComponent_MATERIALS;
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, unwanted);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);

  MissingVertices missing;
  Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
  Assimp::DefaultLogger::get()->attachStream(&missing, Assimp::Logger::Warn);

  const aiScene* scene = importer.ReadFile(path, aiProcess_ValidateDataStructure | aiProcess_RemoveComponent |
                                                     aiProcess_Triangulate | aiProcess_SortByPType |
                                                     aiProcess_PreTransformVertices | aiProcess_JoinIdenticalVertices);

  if (!scene) {
    const string text = importer.GetErrorString();
    if (text == "std::bad_alloc") throw std::bad_alloc();
    for (const char* empty : {"no faces", "No meshes remaining"})
      if (text.find(empty) != string::npos) throw runtime_error("it has no triangles");

    files->check_opened();
    throw runtime_error(fmt::format("it is damaged, or no .{} file: {}. Remedy: export it again", ending, text));
  }

  Assimp::DefaultLogger::get()->detachStream(&missing, Assimp::Logger::Warn);
  if (missing.seen()) throw runtime_error("a triangle refers to a missing vertex. Remedy: export it again");

  ImportedMesh mesh;
  optional<MeshMaterials> materials;
  if (painted) {
    check_count(scene->mNumMeshes, limits.parts, "parts of different materials");
    materials.emplace(*scene, *files, ending, limits);
  }

  for (unsigned i = 0; i < scene->mNumMeshes; ++i)
    append(*scene->mMeshes[i], materials ? &*materials : nullptr, mesh, limits);
  if (mesh.triangles.empty()) throw runtime_error("it has no triangles");

  if (materials) mesh.paint.textures = materials->take_textures();
  return mesh;
}

}  // namespace

const vector<string>& mesh_endings() {
  // Formats with readers that a damaged file seldom harms. In fuzzing, STL and OBJ never did, glTF in one of 2,900
  // files.
  static const vector<string> endings{"obj", "stl", "gltf", "glb"};
  return endings;
}

ImportedMesh import_mesh(const string& path, const string& ending, bool painted, const MeshLimits& limits) {
  if (ending == "stl") return imported_stl(path, limits);
  if (painted && MeshFiles(path, ending, true).mentions_colors()) {
    ImportedMesh mesh = imported(path, ending, true, limits);
    const auto& parts = mesh.paint.parts;
    if (any_of(parts, [](const MeshPart& part) { return part.colored != 0; })) return mesh;
  }
  return imported(path, ending, false, limits);
}

}  // namespace carom
