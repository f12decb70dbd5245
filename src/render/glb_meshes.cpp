// A mesh in colours of its own has a primitive for each part, since each has one material. Textures are written as PNG
// into the file.
#include "render/glb_meshes.h"

#include <fmt/format.h>
#include <png.h>

#include <filesystem>
#include <iterator>

#include "render/eye.h"
#include "render/lighting.h"
#include "render/renderer.h"
#include "render/still_things.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

using Json = nlohmann::ordered_json;

vector<array<float, 3>> rows_of(const vector<Vec3>& list) {
  vector<array<float, 3>> rows;
  ranges::transform(list, std::back_inserter(rows), [](const Vec3& v) { return floats(v); });
  return rows;
}

/// `base`: linear.
Json look(const array<float, 4>& base, bool two_sided, const string& name) {
  Json out{{"name", name},
           {"pbrMetallicRoughness", {{"baseColorFactor", base}, {"metallicFactor", 0}, {"roughnessFactor", 0.6F}}}};
  if (two_sided) out["doubleSided"] = true;
  return out;
}

Finish finish_of(const Coat& coat) {
  return coat.surface.finish.value_or(Finish::plastic);
}

/// By which a coat is told from others.
array<double, 5> key_of(const Coat& coat) {
  return {coat.color.r, coat.color.g, coat.color.b, double(finish_of(coat)), coat.surface.opacity.value_or(-1)};
}

/// "#c8413f", "#c8413f glass", "#c8413f, opacity 0.5"
string text_of(const Coat& coat) {
  string text = hex_text(coat.color);
  if (const Finish finish = finish_of(coat); finish != Finish::plastic) text += " " + string(name_of(finish));
  if (coat.surface.opacity) text += fmt::format(", opacity {}", *coat.surface.opacity);
  return text;
}

/// The part of the triangles from `first` on, with the vertices that it uses.
Mesh part_of(const Mesh& mesh, size_t first, const MeshPart& part) {
  Mesh out;
  out.paint.parts = {part};
  constexpr uint32_t none = numeric_limits<uint32_t>::max();
  vector<uint32_t> number(mesh.vertices.size(), none);

  for (size_t i = first; i < first + size_t{3} * part.triangles; ++i) {
    const uint32_t from = mesh.triangles[i];
    if (number[from] == none) {
      number[from] = uint32_t(out.vertices.size());
      out.vertices.push_back(mesh.vertices[from]);
      out.normals.push_back(mesh.normals[from]);
      out.paint.uv.push_back(mesh.paint.uv[from]);
      out.paint.tint.push_back(mesh.paint.tint[from]);
    }
    out.triangles.push_back(number[from]);
  }
  return out;
}

string png_of(const MeshTexture& texture) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = texture.width, png.height = texture.height, png.format = PNG_FORMAT_RGBA;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  string bytes(size, '\0');
  if (!png_image_write_to_memory(&png, bytes.data(), &size, 0, texture.rgba.data(), 0, nullptr))
    throw RenderError("cannot write a texture of animation.glb");
  bytes.resize(size);
  return bytes;
}

/// As OpenGL numbers it.
int mode_of_axis(Wrap wrap) {
  constexpr int repeat = 10497, clamp = 33071, mirror = 33648;
  return wrap == Wrap::mirror ? mirror : wrap == Wrap::clamp ? clamp : repeat;
}

}  // namespace

Json GlbMeshes::primitive(const Mesh& mesh, size_t material) {
  constexpr auto vertices = GlbFile::Use::vertices;
  vector<Vec3> normals = mesh.normals;
  ranges::replace_if(
      normals, [](const Vec3& n) { return n.isZero(0); }, Vec3(0, 1, 0));
  Json attributes{{"POSITION", file_.add_rows(rows_of(mesh.vertices), vertices)},
                  {"NORMAL", file_.add_rows(rows_of(normals), vertices)}};

  // A part of a mesh in colours. White vertices need no colour.
  const MeshPaint& paint = mesh.paint;
  if (!paint.parts.empty() && paint.parts.front().texture > 0)
    attributes["TEXCOORD_0"] = file_.add_rows(paint.uv, vertices);
  const array<float, 3> white{1, 1, 1};
  if (any_of(paint.tint, [&](const auto& tint) { return tint != white; })) {
    vector<array<float, 4>> colors;
    for (const auto& tint : paint.tint) colors.push_back({tint[0], tint[1], tint[2], 1});
    attributes["COLOR_0"] = file_.add_rows(colors, vertices);
  }
  return {{"attributes", attributes}, {"indices", file_.add_corners(mesh.triangles)}, {"material", material}};
}

size_t GlbMeshes::material(const Coat& coat, bool two_sided) {
  const auto c = linear(coat.color);
  const raster::SurfaceLight light = surface_light(coat.surface, Finish::plastic);
  Json out = look({c[0], c[1], c[2], light.opacity}, two_sided, text_of(coat) + (two_sided ? ", two-sided" : ""));

  constexpr array<float, 5> roughness = {1, 0.6F, 0.25F, 0.05F, 0.6F};  // by finish
  const Finish finish = finish_of(coat);
  out["pbrMetallicRoughness"]["metallicFactor"] = finish == Finish::metal ? 1 : 0;
  out["pbrMetallicRoughness"]["roughnessFactor"] = roughness[size_t(finish)];
  if (light.opacity < 1) out["alphaMode"] = "BLEND";
  if (light.emission > 0) out["emissiveFactor"] = c;
  return file_.add_once("materials", std::move(out));
}

size_t GlbMeshes::image(const MeshTexture& picture) {
  const string png = png_of(picture);
  const auto [known, is_new] = images_.try_emplace(png);
  if (is_new) known->second = file_.add("images", {{"bufferView", file_.add_bytes(png)}, {"mimeType", "image/png"}});
  return known->second;
}

size_t GlbMeshes::material(const MeshPart& part, optional<size_t> image, const string& name) {
  // Pictures show both sides.
  Json out = look(part.factor, true, name);
  if (part.cutoff > 0) out["alphaMode"] = "MASK", out["alphaCutoff"] = part.cutoff;
  if (image) {
    constexpr int nearest = 9728, smooth = 9729;  // as OpenGL numbers them
    const size_t sampler = file_.add_once("samplers", {{"wrapS", mode_of_axis(part.wrap[0])},
                                                       {"wrapT", mode_of_axis(part.wrap[1])},
                                                       {"magFilter", part.sharp ? nearest : smooth}});
    out["pbrMetallicRoughness"]["baseColorTexture"]["index"] =
        file_.add_once("textures", {{"source", *image}, {"sampler", sampler}});
  }
  return file_.add_once("materials", std::move(out));
}

size_t GlbMeshes::single(const Mesh& mesh, const Coat& coat, bool two_sided, const string& name) {
  Json primitives = Json::array();
  if (mesh.paint.parts.empty()) primitives.push_back(primitive(mesh, material(coat, two_sided)));

  map<uint32_t, size_t> images;  // by texture
  size_t first = 0;
  for (const MeshPart& part : mesh.paint.parts) {
    if (part.triangles == 0) continue;

    optional<size_t> shown;
    if (part.colored && part.texture > 0) {
      const auto [known, is_new] = images.try_emplace(part.texture);
      if (is_new) known->second = image(mesh.paint.textures[part.texture - 1]);
      shown = known->second;
    }

    const size_t look = part.colored ? material(part, shown, name) : material(coat, two_sided);
    primitives.push_back(primitive(part_of(mesh, first, part), look));
    first += size_t{3} * part.triangles;
  }
  return file_.add("meshes", {{"name", name}, {"primitives", std::move(primitives)}});
}

size_t GlbMeshes::volume(Shape shape, const Coat& coat) {
  const auto [known, is_new] = volumes_.try_emplace({shape, key_of(coat)});
  if (is_new) {
    const Mesh mesh = shape == Shape::sphere ? round_ball() : shape == Shape::cylinder ? round_cylinder() : unit_box();
    constexpr const char* names[] = {"ball", "cylinder", "box"};
    known->second = single(mesh, coat, false, fmt::format("{} {}", names[size_t(shape)], text_of(coat)));
  }
  return known->second;
}

size_t GlbMeshes::file(const MeshUse& use, const Coat& coat) {
  array<double, 13> how = {use.center.x(), use.center.y(), use.center.z(), use.scale};
  for (size_t k = 0; k < 9; ++k) how[4 + k] = use.turn[k / 3][ptrdiff_t(k % 3)];
  // A mesh whose parts all have a colour is the same for every body.
  constexpr Key any{-1, -1, -1, -1, -1};
  const Key own = key_of(coat);
  for (const Key& of : {any, own})
    if (const auto same = files_.find({use.file, how, use.own_colors, of}); same != files_.end()) return same->second;
  const Mesh mesh = drawn_mesh(use);
  const auto& parts = mesh.paint.parts;
  const bool colored = !parts.empty() && all_of(parts, [](const MeshPart& part) { return part.colored; });
  const string name = parts.empty() ? "mesh " + text_of(coat) : std::filesystem::path(use.file).stem().string();
  return files_[{use.file, how, use.own_colors, colored ? any : own}] = single(mesh, coat, false, name);
}

}  // namespace carom
