// Names are looked up in the text of meshes. A name too many does no harm: nobody changes a file that does not exist.
#include "commands/scene_files.h"

#include <fcntl.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "files/manifest.h"
#include "files/stored_file.h"
#include "scene/check.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "scene/scene_values.h"
#include "std.h"
#include "yaml/letters.h"
#include "yaml/source.h"
#include "yaml/value_json.h"

namespace carom {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t longest_text = 256 << 20;  // bytes of a mesh

/// Empty: it cannot be read.
string text_of(const string& file) {
  try {
    return read_text(AT_FDCWD, fs::weakly_canonical(file).string(), longest_text).value_or("");
  } catch (const std::exception&) {
    return {};
  }
}

bool is_named(string_view file, std::initializer_list<string_view> endings) {
  return contains(endings, in_lower_case(fs::path(file).extension().string()));
}

/// "%20" to " ".
string decoded(string_view uri) {
  string out;
  for (size_t i = 0; i < uri.size(); ++i) {
    int code = 0;
    for (size_t k = i + 1; uri[i] == '%' && k < min(i + 3, uri.size()); ++k) {
      const char c = uri[k];
      const int digit = c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c - 'A' + 10;
      code = 16 * code + digit;
    }
    out += code > 0 ? char(code) : uri[i];
    i += code > 0 ? 2 : 0;
  }
  return out;
}

void add_uris(const nlohmann::ordered_json& json, const fs::path& folder, set<string>& files) {
  for (const char* list : {"buffers", "images"}) {
    if (!json.is_object() || !json.contains(list) || !json[list].is_array()) continue;
    for (const auto& entry : json[list])
      if (entry.is_object() && entry.contains("uri") && entry["uri"].is_string())
        if (const string uri = entry["uri"]; !uri.starts_with("data:")) files.insert((folder / decoded(uri)).string());
  }
}

/// The names behind the first word of lines that begin with `word`: all behind it, and the last of its parts.
void add_names(string_view text, string_view word, const fs::path& folder, set<string>& files) {
  for (size_t i = 0; i < text.size();) {
    const size_t end = min(text.find_first_of("\r\n", i), text.size());
    string_view line = text.substr(i, end - i);
    i = end + 1;
    line.remove_prefix(min(line.find_first_not_of(" \t"), line.size()));
    if (!line.starts_with(word)) continue;

    // What follows the word, without blanks around it.
    line.remove_prefix(min(line.find_first_of(" \t"), line.size()));
    while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
    while (!line.empty() && (line.back() == ' ' || line.back() == '\t')) line.remove_suffix(1);

    if (line.empty()) continue;
    files.insert((folder / line).string());
    files.insert((folder / line.substr(line.find_last_of(" \t") + 1)).string());
  }
}

void add_mesh(const string& mesh, set<string>& files) {
  if (!files.insert(mesh).second) return;
  const fs::path folder = fs::path(mesh).parent_path();
  if (is_named(mesh, {".gltf"})) add_uris(json_of_text(text_of(mesh)), folder, files);
  if (!is_named(mesh, {".obj"})) return;
  set<string> libraries;
  add_names(text_of(mesh), "mtllib", folder, libraries);
  for (const string& library : libraries) {
    files.insert(library);
    add_names(text_of(library), "map_", folder, files);
  }
}

}  // namespace

set<string> files_of_scene(const PlannedScene& planned) {
  set<string> files = {planned.file};
  if (planned.scene)
    for (const MeshFile& mesh : planned.scene->meshes) add_mesh(mesh.file, files);
  if (planned.scene) files.insert(planned.scene->made_from.tables.begin(), planned.scene->made_from.tables.end());
  if (planned.scene && planned.scene->made_from.start)
    files.insert((fs::path(planned.scene->made_from.start->folder) / manifest_name).string());
  if (planned.scene) return files;

  // Of a scene with errors there is only its text.
  try {
    const string folder = fs::path(planned.file).parent_path().string();
    for (const SceneValue& value : scene_values(planned.file, text_of(planned.file)))
      if (value.path.ends_with(".mesh") || value.path.ends_with(".mesh.file"))
        add_mesh(beneath(folder, cell_text(value.text)), files);
      else if (value.path.ends_with(".table"))
        files.insert(beneath(folder, cell_text(value.text)));
      else if (value.path == "start.run")
        files.insert((fs::path(beneath(folder, cell_text(value.text))) / manifest_name).string());
  } catch (const std::exception&) {
    // The text is no YAML. The file itself is watched.
  }
  return files;
}

}  // namespace carom
