// Imports a mesh with assimp, in the child process. Only readers for the file's ending are left, and only files of its
// own folder can be opened. Vertices and indices are checked here, so that a defect of a reader becomes an error.
// Normals are made here for files without them, because the smoothing of a shared vertex depends on the angle between
// faces.
#include "render/mesh_import.h"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <new>
#include <stdexcept>
#include <string_view>

#include "scene/scene.h"

namespace carom {
namespace {

/// Turns lines of a Wavefront file that name groups and materials into comments. They have no effect on the shape.
/// assimp looks each name up among all others, which takes minutes for tens of thousands.
void drop_names(char* text, std::size_t size) {
  for (std::size_t i = 0; i < size;) {
    while (i < size && (text[i] == ' ' || text[i] == '\t')) ++i;
    const std::string_view rest(text + i, size - i);
    for (const std::string_view word : {"usemtl", "mtllib", "g", "o"}) {
      const bool whole = rest.size() == word.size() || (rest.size() > word.size() && rest[word.size()] <= ' ');
      if (rest.starts_with(word) && whole) text[i] = '#';
    }
    while (i < size && text[i] != '\n' && text[i] != '\r') ++i;
    while (i < size && (text[i] == '\n' || text[i] == '\r')) ++i;
  }
}

/// Opens regular files of one folder, for reading only. A mesh may name any files for its materials and buffers.
class OneFolder : public Assimp::DefaultIOSystem {
 public:
  OneFolder(const std::string& file, const std::string& ending)
      : folder_(folder_of(file)), wavefront_(ending == "obj" ? file : "") {}
  bool Exists(const char* file) const override { return within(file) && Assimp::DefaultIOSystem::Exists(file); }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    const bool reads = std::string_view(mode).find_first_of("wa+") == std::string_view::npos;
    if (!reads || !within(file)) return nullptr;
    std::unique_ptr<Assimp::IOStream> stream(Assimp::DefaultIOSystem::Open(file, mode));
    return stream && file == wavefront_ ? without_names(*stream) : stream.release();
  }

 private:
  static Assimp::IOStream* without_names(Assimp::IOStream& stream) {
    const std::size_t size = stream.FileSize();
    auto bytes = std::make_unique<std::uint8_t[]>(size);
    const std::size_t read = stream.Read(bytes.get(), 1, size);
    drop_names(reinterpret_cast<char*>(bytes.get()), read);
    return new Assimp::MemoryIOStream(bytes.release(), read, true);
  }
  static std::filesystem::path folder_of(const std::string& file) {
    return std::filesystem::path(file).lexically_normal().parent_path();
  }
  bool within(const char* file) const {
    std::error_code error;
    return folder_of(file) == folder_ && std::filesystem::is_regular_file(file, error);
  }
  std::filesystem::path folder_;
  std::string wavefront_;  // the file, if it is a Wavefront one
};

/// Leaves only the readers for the file's ending. Otherwise its content may select any of them.
void keep_readers(Assimp::Importer& importer, const std::string& ending) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    const std::string endings = std::string(" ") + importer.GetImporterInfo(i)->mFileExtensions + " ";
    if (endings.find(" " + ending + " ") == std::string::npos) importer.UnregisterLoader(importer.GetImporter(i));
  }
}

Vec3 vertex(const ImportedMesh& mesh, std::size_t i) {
  return Vec3(double{mesh.vertices[3 * i]}, double{mesh.vertices[3 * i + 1]}, double{mesh.vertices[3 * i + 2]});
}

constexpr double cos_smooth = 0.70710678118654752;  // cosine of 45 degrees
// Greatest number of triangles at a vertex for which normals are smoothed.
constexpr std::size_t most_around = 256;

/// Makes normals for the triangles from `triangle` on, with vertices from `first` on that have none. The normal at a
/// corner is the mean over triangles around it, weighted by area, that lean less than 45 degrees against its own. At
/// sharp edges a vertex is split into several.
void make_normals(ImportedMesh& mesh, std::size_t first, std::size_t triangle) {
  const std::size_t count = mesh.triangles.size() / 3 - triangle, vertices = mesh.vertices.size() / 3 - first;
  std::vector<Vec3> area(count), normal(count);
  std::vector<std::vector<std::uint32_t>> around(vertices);
  for (std::size_t t = 0; t < count; ++t) {
    const std::uint32_t* corner = &mesh.triangles[3 * (triangle + t)];
    const Vec3 a = vertex(mesh, corner[0]), b = vertex(mesh, corner[1]), c = vertex(mesh, corner[2]);
    area[t] = (b - a).cross(c - a);
    normal[t] = area[t].stableNormalized();
    for (int k = 0; k < 3; ++k) around[corner[k] - first].push_back(static_cast<std::uint32_t>(t));
  }
  mesh.normals.resize(mesh.vertices.size(), 0);
  struct Made {
    Vec3 normal;
    std::uint32_t vertex;
  };
  std::vector<Made> made;
  for (std::size_t v = 0; v < vertices; ++v) {
    made.clear();
    for (const std::uint32_t t : around[v]) {
      Vec3 sum = area[t];
      if (around[v].size() <= most_around) {
        sum.setZero();
        for (const std::uint32_t other : around[v])
          if (normal[other].dot(normal[t]) > cos_smooth || other == t) sum += area[other];
      }
      const Vec3 mean = sum.stableNormalized();
      std::uint32_t at = static_cast<std::uint32_t>(first + v);
      bool known = false;
      for (const Made& m : made)
        if (m.normal == mean) known = true, at = m.vertex;
      if (!known) {
        // The first one keeps its place.
        if (!made.empty()) {
          at = static_cast<std::uint32_t>(mesh.vertices.size() / 3);
          for (std::size_t k = 0; k < 3; ++k) mesh.vertices.push_back(mesh.vertices[3 * (first + v) + k]);
          mesh.normals.resize(mesh.vertices.size());
        }
        for (int k = 0; k < 3; ++k)
          mesh.normals[3 * std::size_t{at} + static_cast<std::size_t>(k)] = static_cast<float>(mean[k]);
        made.push_back({mean, at});
      }
      for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t& corner = mesh.triangles[3 * (triangle + t) + k];
        if (corner == first + v) corner = at;
      }
    }
  }
}

void check_count(std::size_t count, std::size_t most, const char* what) {
  if (count > most) throw std::runtime_error("it has more than " + std::to_string(most) + " " + what);
}

void append(const aiMesh& part, ImportedMesh& mesh, const MeshLimits& limits) {
  const std::size_t first = mesh.vertices.size() / 3, triangle = mesh.triangles.size() / 3;
  check_count(first + part.mNumVertices, limits.vertices, "vertices");
  check_count(triangle + part.mNumFaces, limits.triangles, "triangles");
  for (unsigned i = 0; i < part.mNumVertices; ++i)
    for (const float x : {part.mVertices[i].x, part.mVertices[i].y, part.mVertices[i].z}) {
      if (!std::isfinite(x)) throw std::runtime_error("a vertex is not finite");
      mesh.vertices.push_back(x);
    }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;
    for (unsigned k = 0; k < 3; ++k) {
      if (face.mIndices[k] >= part.mNumVertices) throw std::runtime_error("a triangle refers to a missing vertex");
      mesh.triangles.push_back(static_cast<std::uint32_t>(first + face.mIndices[k]));
    }
  }
  if (!part.mNormals) {
    make_normals(mesh, first, triangle);
    check_count(mesh.vertices.size() / 3, limits.vertices, "vertices");
    return;
  }
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D& n = part.mNormals[i];
    const float length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    const bool known = std::isfinite(length) && length > 0;
    for (const float x : {n.x, n.y, n.z}) mesh.normals.push_back(known ? x / length : 0);
  }
}

}  // namespace

const std::vector<std::string>& mesh_endings() {
  // Formats with readers that a damaged file seldom harms. In fuzzing, STL and OBJ never did, glTF in one of 2,900
  // files.
  static const std::vector<std::string> endings{"obj", "stl", "gltf", "glb"};
  return endings;
}

ImportedMesh import_mesh(const std::string& path, const std::string& ending, const MeshLimits& limits) {
  Assimp::Importer importer;
  // The importer owns it.
  importer.SetIOHandler(new OneFolder(path, ending));
  keep_readers(importer, ending);
  // An STL file has separate triangles with normals of their own. The normals are made anew, to be smooth.
  int unwanted = aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS | aiComponent_TEXCOORDS |
                 aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS | aiComponent_TEXTURES | aiComponent_LIGHTS |
                 aiComponent_CAMERAS | aiComponent_MATERIALS;
  if (ending == "stl") unwanted |= aiComponent_NORMALS;
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, unwanted);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene = importer.ReadFile(path, aiProcess_ValidateDataStructure | aiProcess_RemoveComponent |
                                                     aiProcess_Triangulate | aiProcess_SortByPType |
                                                     aiProcess_PreTransformVertices | aiProcess_JoinIdenticalVertices);
  if (!scene) {
    const std::string text = importer.GetErrorString();
    if (text == "std::bad_alloc") throw std::bad_alloc();
    throw std::runtime_error(text);
  }
  ImportedMesh mesh;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) append(*scene->mMeshes[i], mesh, limits);
  if (mesh.triangles.empty()) throw std::runtime_error("it has no triangles");
  return mesh;
}

}  // namespace carom
