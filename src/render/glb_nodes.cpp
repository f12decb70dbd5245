// Edits the JSON chunk of a glTF file that assimp has written. Binary chunks stay.
// Nodes are identified by names that no scene has.
#include "render/glb_nodes.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "render/render_error.h"
#include "std.h"
#include "yaml/value_json.h"

namespace carom {
namespace {

using Json = nlohmann::ordered_json;

constexpr uint32_t magic = 0x46546C67, json_chunk = 0x4E4F534A;  // "glTF", "JSON"
constexpr size_t head_size = 12, chunk_head_size = 8;

uint32_t word_at(string_view file, size_t at) {
  uint32_t word = 0;
  if (at + sizeof word > file.size()) throw RenderError("assimp wrote an incomplete glTF file");
  std::memcpy(&word, file.data() + at, sizeof word);
  return word;
}

void put_word(string& file, size_t at, size_t value) {
  const auto word = static_cast<uint32_t>(value);
  std::memcpy(file.data() + at, &word, sizeof word);
}

/// Numbers rounded to float, as the binary part of the file has them.
Json floats(std::initializer_list<double> values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(static_cast<double>(static_cast<float>(value)) + 0.0);
  return list;
}

Json vector_json(const Vec3& v) {
  return floats({v.x(), v.y(), v.z()});
}

Json light_json(const GlbLight& light) {
  return {{"name", light.name},
          {"type", light.directional ? "directional" : "point"},
          {"color", floats({light.linear[0], light.linear[1], light.linear[2]})},
          {"intensity", floats({light.intensity})[0]}};
}

Json camera_json(const GlbCamera& camera) {
  const Json numbers = floats({camera.aspect, camera.fov_y, camera.far, camera.near});
  return {{"type", "perspective"},
          {"perspective",
           {{"aspectRatio", numbers[0]}, {"yfov", numbers[1]}, {"zfar", numbers[2]}, {"znear", numbers[3]}}}};
}

class Mender {
 public:
  Mender(Json& gltf, const vector<GlbNode>& nodes) : gltf_(gltf), nodes_(nodes) {}

  void mend() {
    gltf_.erase("extensionsUsed");
    for (Json& material : gltf_["materials"]) material.erase("extensions");

    std::map<string, size_t> numbers;
    for (size_t i = 0; i < nodes_.size(); ++i) numbers[exported_name(i)] = i;
    size_t found = 0;
    for (Json& json : gltf_["nodes"]) {
      const auto number = numbers.find(json.value("name", ""));

      // The root.
      if (number == numbers.end()) continue;

      mend_node(json, nodes_[number->second]);
      ++found;
    }

    if (found != nodes_.size()) throw RenderError("assimp dropped nodes of a glTF file");
    if (!lights_.empty()) {
      gltf_["extensionsUsed"] = {"KHR_lights_punctual"};
      gltf_["extensions"]["KHR_lights_punctual"]["lights"] = lights_;
    }
    if (gltf_.contains("animations"))
      for (Json& animation : gltf_["animations"]) step_scales(animation);
  }

 private:
  void mend_node(Json& json, const GlbNode& node) {
    json["name"] = node.name;
    for (const char* key : {"matrix", "translation", "rotation", "scale"}) json.erase(key);

    json["translation"] = vector_json(node.translation);
    if (node.rotation[3] != 1)
      json["rotation"] = floats({node.rotation[0], node.rotation[1], node.rotation[2], node.rotation[3]});
    if (node.scale != Vec3::Ones()) json["scale"] = vector_json(node.scale);

    if (node.camera) {
      json["camera"] = gltf_["cameras"].size();
      gltf_["cameras"].push_back(camera_json(*node.camera));
    }
    if (node.light) {
      json["extensions"]["KHR_lights_punctual"]["light"] = lights_.size();
      lights_.push_back(light_json(*node.light));
    }
  }

  static void step_scales(Json& animation) {
    for (const Json& channel : animation.at("channels"))
      if (channel.at("target").at("path") == "scale")
        animation.at("samplers").at(channel.at("sampler").get<size_t>())["interpolation"] = "STEP";
  }

  Json& gltf_;
  const vector<GlbNode>& nodes_;
  Json lights_ = Json::array();
};

}  // namespace

array<double, 4> rotation_to(const Vec3& x, const Vec3& y, const Vec3& z) {
  // 4 q_i^2 from the matrix's diagonal. The largest gives the others without loss (Shepperd 1978).
  const array<double, 4> squares = {1 + x.x() - y.y() - z.z(), 1 - x.x() + y.y() - z.z(), 1 - x.x() - y.y() + z.z(),
                                    1 + x.x() + y.y() + z.z()};

  size_t largest = 0;
  for (size_t i = 1; i < 4; ++i)
    if (squares[i] > squares[largest]) largest = i;

  const double twice = std::sqrt(squares[largest]), by = 0.5 / twice;
  const double xy = (x.y() + y.x()) * by, yz = (y.z() + z.y()) * by, zx = (z.x() + x.z()) * by;
  const double wx = (y.z() - z.y()) * by, wy = (z.x() - x.z()) * by, wz = (x.y() - y.x()) * by;

  switch (largest) {
    case 0:
      return {0.5 * twice, xy, zx, wx};
    case 1:
      return {xy, 0.5 * twice, yz, wy};
    case 2:
      return {zx, yz, 0.5 * twice, wz};
    default:
      return {wx, wy, wz, 0.5 * twice};
  }
}

string exported_name(size_t node) {
  return fmt::format("carom node {}", node);
}

string mended_glb(string_view file, const string& title, const vector<GlbNode>& nodes) {
  const size_t json_size = word_at(file, head_size), json_from = head_size + chunk_head_size;
  if (word_at(file, 0) != magic || word_at(file, head_size + 4) != json_chunk || json_from + json_size > file.size())
    throw RenderError("assimp wrote no glTF file");

  Json gltf = json_of_text(file.substr(json_from, json_size));
  if (!gltf.is_object()) throw RenderError("assimp wrote a glTF file without its JSON");
  Mender(gltf, nodes).mend();
  gltf["asset"]["generator"] = "carom " CAROM_VERSION ", by assimp";
  gltf["scenes"][0]["name"] = title;

  string text = text_of_json(gltf);
  text.resize((text.size() + 3) / 4 * 4, ' ');

  string out(file.substr(0, json_from));
  put_word(out, head_size, text.size());
  out += text;
  out += file.substr(json_from + json_size);

  // Bytes, the largest size that the format can represent.
  constexpr size_t largest = 0xFFFFFFFF;
  if (out.size() > largest) throw RenderError("animation.glb would be larger than 4 GB: use fewer keyframes a second");
  put_word(out, 8, out.size());
  return out;
}

}  // namespace carom
