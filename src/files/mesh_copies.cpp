// The copies have the bytes of the original files. The program exports no mesh of its own, because a conversion would
// change it.
#include "files/mesh_copies.h"

#include <fcntl.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "files/hash.h"
#include "files/stored_file.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/value_json.h"

namespace carom {
namespace {

string read_whole(const string& path) {
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file) fail("read the mesh", {AT_FDCWD, ""}, path);
  string bytes;
  vector<char> buffer(size_t{64} * 1024);
  while (const size_t n = read_some(file.get(), buffer.data(), buffer.size())) bytes.append(buffer.data(), n);
  return bytes;
}

}  // namespace

vector<MeshCopy> read_meshes(const Scene& scene) {
  vector<MeshCopy> copies;
  for (const MeshFile& mesh : scene.meshes) {
    if (!mesh.copy.empty()) copies.push_back({mesh.copy, read_whole(mesh.file)});
  }
  return copies;
}

string meshes_text(const Scene& scene) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const MeshFile& mesh : scene.meshes) {
    const string name = mesh.copy.empty() ? std::filesystem::path(mesh.file).filename().string() : mesh.copy;
    list.push_back({{"name", name}, {"sha256", sha256(read_whole(mesh.file))}});
  }
  return text_of_json(list);
}

}  // namespace carom
