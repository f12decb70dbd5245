#pragma once
// Small mesh files with colours, made as text: a square from (-1, -1, 0) to (1, 1, 0).

#include "render/mesh_folder.h"
#include "std.h"

namespace carom::test {

inline string from_base64(string_view text) {
  constexpr string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  string bytes;
  unsigned bits = 0, count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6U | static_cast<unsigned>(digits.find(c));
    count += 6;
    if (count >= 8) bytes += static_cast<char>(bits >> (count -= 8));
  }
  return bytes;
}

/// PNG, 2 x 2 pixels: red, green; blue, white.
const string four_colors =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAEklEQVR42mP4z8DAAMIM/4EAAB/uBfvxq7p3AAAAAElFTkSuQmCC";
/// PNG, 2 x 2 white pixels with opacity 255, 0; 120, 255.
const string four_opacities =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAEklEQVR42mP4DwEMDECiAsQCAILpDmsEOdd0AAAAAElFTkSuQmCC";
/// PNG, 64 x 64 pixels: black, white, black, ...
const string checkers =
    "iVBORw0KGgoAAAANSUhEUgAAAEAAAABACAIAAAAlC+aJAAAAWElEQVR42u3RoQ0AAAgDwe6/dBHMgCC5itdNLknaPu7v9zsCBAgQIECAAAEC"
    "BAgQIECAAAECBAgQIECAAAECBAgQIECAAAECBAgQIECAAAECBAgQIEDgtgP9QulaQI5ysQAAAABJRU5ErkJggg==";
/// JPEG, 8 x 8 pixels: the upper half red, the lower half blue.
const string red_over_blue =
    "/9j//gAQTGF2YzU5LjM3LjEwMAD/2wBDAAgEBAQEBAUFBQUFBQYGBgYGBgYGBgYGBgYHBwcICAgHBwcGBgcHCAgICAkJCQgICAgJCQoKCgwMCwsO"
    "Dg4RERT/xABUAAEBAAAAAAAAAAAAAAAAAAAFBwEBAQAAAAAAAAAAAAAAAAAABgcQAQADAQAAAAAAAAAAAAAAAAAWZOOjEQEAAwEAAAAAAAAAAAAA"
    "AAAAGGblpf/AABEIAAgACAMBEgACEgADEgD/2gAMAwEAAhEDEQA/AJpKqffEOVRltfH1FVNZDVnq5qav/9k=";

inline string data_uri(const string& base64, const string& kind = "image/png") {
  return "data:" + kind + ";base64," + base64;
}

/// A glTF file of the square. `image`: the URI of its texture; `material`: further members of the material; `texture`:
/// of its baseColorTexture; `metallic`: of its pbrMetallicRoughness; `sampler`: members of the sampler.
struct GltfSquare {
  string image;
  string material{}, metallic{}, texture{};
  string sampler = R"("magFilter": 9728)";
  bool has_material = true, vertex_colors = false;

  string text() const {
    string json = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],)";
    json += R"("extensionsUsed": ["KHR_texture_transform"],)";
    json += R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1)";
    if (vertex_colors) json += R"(, "COLOR_0": 3)";
    json += R"(}, "indices": 2)" + string(has_material ? R"(, "material": 0)" : "") + "}]}],";

    json += R"("materials": [{"pbrMetallicRoughness": {)" + metallic;
    if (!image.empty()) json += (metallic.empty() ? "" : ", ") + (R"("baseColorTexture": {"index": 0)" + texture + "}");
    json += "}" + material + "}],";
    if (!image.empty())
      json += R"("textures": [{"source": 0, "sampler": 0}], "samplers": [{)" + sampler + R"(}], "images": [{"uri": ")" +
              image + R"("}],)";

    json += R"("accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0],)";
    json += R"("max": [1, 1, 0]}, {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},)";
    json += R"({"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"},)";
    json += R"({"bufferView": 3, "componentType": 5126, "count": 4, "type": "VEC3"}],)";
    json += R"("bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48},)";
    json += R"({"buffer": 0, "byteOffset": 48, "byteLength": 32}, {"buffer": 0, "byteOffset": 80, "byteLength": 12},)";
    json += R"({"buffer": 0, "byteOffset": 92, "byteLength": 48}], "buffers": [{"byteLength": 140, "uri": ")";

    // Positions; places in the texture, from (0, 1) at the left lower corner on; indices; four colours: red, half
    // light, blue, white.
    return json +
           data_uri(
               "AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAAAACAvwAAgD8AAAAAAAAAAAAAgD8AAIA/AACAPwAAgD8AAAAA"
               "AAAAAAAAAAAAAAEAAgAAAAIAAwAAAIA/AAAAAAAAAAAAAAA/AAAAPwAAAD8AAAAAAAAAAAAAgD8AAIA/AACAPwAAgD8=",
               "application/octet-stream") +
           "\"}]}";
  }
};

/// A Wavefront file of the square, with its material file.
inline string write_wavefront(const MeshFolder& folder, const string& material) {
  folder.write("square.mtl", material);
  return folder.write("square.obj",
                      "mtllib square.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                      "usemtl paper\nf 1/1 2/2 3/3 4/4\n");
}

}  // namespace carom::test
