// Writes and reads manifest.json.
// A manifest that is read may be damaged or forged. Names are checked before files are removed by them.
// The depth of brackets is checked before parsing.
#include "files/manifest.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "files/hash.h"
#include "files/mesh_copies.h"
#include "files/series_folders.h"
#include "files/stored_file.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"
#include "std.h"
#include "version.h"
#include "yaml/value_json.h"

namespace carom {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* tool = "carom";

Json outputs_json(const Output& output) {
  Json json = Json::object();
  for (const OutputKind& kind : output_kinds())
    if (kind.asked(output)) json[string(kind.name)] = kind.settings(output);
  return json;
}

/// The member `key` of this type. Otherwise null, which has no items.
const Json& member(const Json& json, const char* key, Json::value_t type) {
  static const Json none;
  const auto found = json.find(key);
  return found != json.end() && found->type() == type ? *found : none;
}

const Json& object_in(const Json& json, const char* key) {
  return member(json, key, Json::value_t::object);
}

const Json& list_in(const Json& json, const char* key) {
  return member(json, key, Json::value_t::array);
}

/// Empty: absent.
string text_member(const Json& json, const char* key) {
  const Json& text = member(json, key, Json::value_t::string);
  return text.is_string() ? text.get<string>() : string();
}

/// Whether brackets are nested deeper than in any manifest.
/// Writing such a value as text recurses as deep and may exhaust the stack.
bool is_too_deep(string_view text) {
  constexpr int deepest = 64;
  int depth = 0;
  bool quoted = false;

  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\') ++i;
    if (c == '"') quoted = !quoted;
    if (quoted) continue;

    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > deepest) return true;
  }
  return false;
}

optional<FileRecord> file_record(const Json& json) {
  FileRecord record{text_member(json, "name"), 0, text_member(json, "sha256")};
  if (!is_run_file(record.name) || record.sha256.size() != 64) return nullopt;
  const Json& bytes = member(json, "bytes", Json::value_t::number_unsigned);
  if (bytes.is_null()) return nullopt;
  record.bytes = bytes.get<uint64_t>();
  return record;
}

SceneOrigin origin_in(const Json& scene) {
  SceneOrigin origin{text_member(scene, "path"), {}};
  for (const Json& setting : list_in(scene, "settings"))
    if (setting.is_string()) origin.settings.push_back(setting.get<string>());
  return origin;
}

Json files_json(const vector<FileRecord>& files) {
  Json list = Json::array();
  for (const FileRecord& file : files)
    list.push_back({{"name", file.name}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  return list;
}

Json scene_json(const Scene& scene, const SceneOrigin& origin) {
  Json json = {{"file", std::filesystem::path(scene.file).filename().string()}};
  if (!origin.path.empty()) json["path"] = origin.path;
  if (!origin.settings.empty()) json["settings"] = origin.settings;
  json["title"] = scene.title;
  json["sha256"] = sha256(scene.resolved);
  if (!scene.made_from.expressions.empty()) json["expressions"] = scene.made_from.expressions;
  if (const auto& start = scene.made_from.start)
    json["start"] = {
        {"run", valid_utf8(start->run)}, {"at", start->at}, {"file", start->file}, {"sha256", start->sha256}};
  return {{"scene", std::move(json)}};
}

Json meshes_json(const Scene& scene) {
  Json meshes = Json::object();
  if (!scene.meshes.empty()) meshes["meshes"] = json_of_text(meshes_text(scene));
  return meshes;
}

string whole_text(const Json& of_scene, const string& outputs, const Json& meshes, const string& facts,
                  const vector<FileRecord>& files) {
  Json json;
  json["tool"] = tool;
  json["version"] = program_version;
  json.update(of_scene);
  json["outputs"] = json_of_text(outputs);
  json.update(meshes);
  json.update(json_of_text(facts));
  json["files"] = files_json(files);
  return text_of_json(json, 2) + "\n";
}

}  // namespace

string outputs_text(const Output& output) {
  return text_of_json(outputs_json(output));
}

string manifest_text(const Scene& scene, const string& outputs, const string& facts, const vector<FileRecord>& files) {
  return whole_text(scene_json(scene, {}), outputs, meshes_json(scene), facts, files);
}

string manifest_text(const string& outputs, const string& facts, const vector<FileRecord>& files) {
  return whole_text(Json::object(), outputs, Json::object(), facts, files);
}

string manifest_text(const Scene& scene, const Summary& summary, const RunFacts& facts,
                     const vector<FileRecord>& files) {
  Json json;
  json["counts"] = {{"bodies", summary.bodies}, {"collisions", summary.collisions}, {"frames", summary.frames}};
  json["wall_times_s"] = {
      {"load", facts.load_s}, {"simulate", facts.simulate_s}, {"render", facts.render_s}, {"export", facts.export_s}};
  json["peak_memory_bytes"] = facts.peak_memory;

  for (const Measured& measure : facts.measures)
    json["measures"][measure.name] = !measure.text.empty()     ? Json(valid_utf8(measure.text))
                                     : isfinite(measure.value) ? Json(measure.value)
                                                               : Json();
  for (const LeftOut& file : facts.left_out) json["left_out"][file.name] = file.why;
  json["status"] = summary.status;
  for (const Warning& warning : summary.warnings)
    json["warnings"].push_back({{"code", warning.code}, {"text", warning.text}});

  return whole_text(scene_json(scene, facts.origin), outputs_text(scene.output), meshes_json(scene), text_of_json(json),
                    files);
}

string changed_manifest(const string& text, const Scene& scene, const vector<FileRecord>& files) {
  const Output& output = scene.output;
  Json json = json_of_text(text);
  if (!json.is_object()) throw ExportError("the run's manifest.json cannot be read");
  json["scene"]["sha256"] = sha256(scene.resolved);
  json["outputs"] = outputs_json(output);
  json["files"] = files_json(files);
  if (!output.pictures() && json.contains("counts")) json["counts"]["frames"] = 0;

  Json left_out = Json::object();
  for (const auto& [file, why] : object_in(json, "left_out").items())
    if (const OutputKind* kind = output_of(file); kind != nullptr && kind->asked(output)) left_out[file] = why;
  json.erase("left_out");
  if (!left_out.empty()) json["left_out"] = std::move(left_out);
  return text_of_json(json, 2) + "\n";
}

optional<Manifest> read_manifest(int folder, const string& name) {
  const auto text = read_text(folder, name, largest_manifest);
  if (!text || is_too_deep(*text)) return nullopt;
  const Json json = json_of_text(*text);
  const Json& files = list_in(json, "files");
  if (text_member(json, "tool") != tool || !json.contains("outputs") || files.is_null()) return nullopt;

  Manifest manifest;
  manifest.version = text_member(json, "version");
  manifest.outputs = text_of_json(json["outputs"]);
  manifest.meshes = json.contains("meshes") ? text_of_json(json["meshes"]) : "[]";
  if (const Json& count = member(object_in(json, "counts"), "collisions", Json::value_t::number_unsigned);
      !count.is_null())
    manifest.collisions = count.get<uint64_t>();

  const Json& scene = object_in(json, "scene");
  manifest.scene_sha256 = text_member(scene, "sha256");
  manifest.scene_file = text_member(scene, "file");
  for (const auto& [path, expression] : object_in(scene, "expressions").items())
    if (expression.is_string()) manifest.expressions.emplace(path, expression.get<string>());
  manifest.origin = origin_in(scene);

  for (const auto& [file, why] : object_in(json, "left_out").items())
    manifest.left_out.push_back({file, why.is_string() ? why.get<string>() : ""});
  for (const auto& [measure, value] : object_in(json, "measures").items())
    manifest.measures.push_back({measure, value.is_number() ? value.get<double>() : std::nan(""),
                                 value.is_string() ? value.get<string>() : string()});
  for (const Json& warning : list_in(json, "warnings"))
    manifest.warnings.push_back({text_member(warning, "code"), text_member(warning, "text")});
  for (const Json& id : list_in(json, "failed"))
    if (id.is_string()) manifest.failed.push_back(id.get<string>());

  for (const Json& entry : files) {
    auto record = file_record(entry);
    if (!record) return nullopt;
    manifest.files.push_back(std::move(*record));
  }
  return manifest;
}

bool is_run_file(string_view name) {
  return output_with_series(name) != nullptr || is_plain_name(name);
}

vector<string> run_files(const Scene& scene, const Output& output) {
  vector<string> names = {"scene.yaml", "summary.csv"};
  for (const MeshFile& mesh : scene.meshes) {
    if (!mesh.copy.empty()) names.push_back(mesh.copy);
  }
  for (string& name : output_files(output)) names.push_back(std::move(name));
  for (const OutputKind& kind : output_kinds())
    for (const string_view name : parts_of(kind.series.names))
      if (kind.asked(output)) names.push_back(fmt::format("{}/{}", kind.series.folder, name));
  return names;
}

string valid_utf8(const string& text) {
  return json_of_text(text_of_json(text)).get<string>();
}

}  // namespace carom
