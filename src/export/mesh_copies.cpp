#include "export/mesh_copies.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "export/hash.h"
#include "export/run_folder.h"

namespace carom {
namespace {

std::string read_whole(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw ExportError("cannot read the mesh " + path);
  return bytes;
}

}  // namespace

std::vector<MeshCopy> read_meshes(const Scene& scene) {
  std::vector<MeshCopy> copies;
  for (const MeshFile& mesh : scene.meshes) {
    if (!mesh.copy.empty()) copies.push_back({mesh.copy, read_whole(mesh.file)});
  }
  return copies;
}

std::string meshes_text(const Scene& scene) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const MeshFile& mesh : scene.meshes) {
    const std::string name = mesh.copy.empty() ? std::filesystem::path(mesh.file).filename().string() : mesh.copy;
    list.push_back({{"name", name}, {"sha256", sha256(read_whole(mesh.file))}});
  }
  return list.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace carom
