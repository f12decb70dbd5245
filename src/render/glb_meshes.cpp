// Translates meshes to assimp's form. A mesh in colours of its own has one of assimp's for each part, since each has
// one material. Textures are written as PNG into the file.
#include "render/glb_meshes.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

#include "render/lighting.h"
#include "render/render_error.h"
#include "render/still_things.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

/// Moves pointers to an array that assimp deletes.
template <typename Item, typename Count>
void hand_over_all(vector<unique_ptr<Item>>& items, Item**& to, Count& count) {
  to = new Item*[items.size()];
  for (size_t i = 0; i < items.size(); ++i) to[i] = items[i].release();
  count = static_cast<Count>(items.size());
  items.clear();
}

aiVector3D floats_of(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// Places in the texture have v upwards in assimp. White vertices need no colour.
void add_paint(const MeshPaint& paint, aiMesh& out) {
  if (paint.parts.empty()) return;
  out.mNumUVComponents[0] = 2;
  out.mTextureCoords[0] = new aiVector3D[paint.uv.size()];
  std::transform(paint.uv.begin(), paint.uv.end(), out.mTextureCoords[0],
                 [](const auto& uv) { return aiVector3D(uv[0], 1 - uv[1], 0); });
  const array<float, 3> white{1, 1, 1};
  if (std::ranges::all_of(paint.tint, [&](const auto& tint) { return tint == white; })) return;
  out.mColors[0] = new aiColor4D[paint.tint.size()];
  std::transform(paint.tint.begin(), paint.tint.end(), out.mColors[0],
                 [](const auto& tint) { return aiColor4D(tint[0], tint[1], tint[2], 1); });
}

unique_ptr<aiMesh> mesh_of(const Mesh& mesh, size_t material, const string& name) {
  auto out = make_unique<aiMesh>();
  out->mName = name;
  out->mMaterialIndex = static_cast<unsigned>(material);
  out->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;

  out->mNumVertices = static_cast<unsigned>(mesh.vertices.size());
  out->mVertices = new aiVector3D[mesh.vertices.size()];
  std::transform(mesh.vertices.begin(), mesh.vertices.end(), out->mVertices, floats_of);
  out->mNormals = new aiVector3D[mesh.normals.size()];
  std::transform(mesh.normals.begin(), mesh.normals.end(), out->mNormals,
                 [](const Vec3& n) { return floats_of(n.isZero(0) ? Vec3(0, 1, 0) : n); });

  out->mNumFaces = static_cast<unsigned>(mesh.triangles.size() / 3);
  out->mFaces = new aiFace[out->mNumFaces];
  for (size_t i = 0; i < out->mNumFaces; ++i) {
    out->mFaces[i].mNumIndices = 3;
    out->mFaces[i].mIndices = new unsigned[3];
    std::copy_n(&mesh.triangles[3 * i], 3, out->mFaces[i].mIndices);
  }

  add_paint(mesh.paint, *out);
  return out;
}

constexpr float roughness = 0.6F;

/// `base`: linear.
unique_ptr<aiMaterial> material_of(const aiColor4D& base, bool two_sided, const string& name) {
  auto out = make_unique<aiMaterial>();
  const aiString named(name);
  const float metallic = 0;
  const int sides = two_sided ? 1 : 0;
  out->AddProperty(&named, AI_MATKEY_NAME);
  out->AddProperty(&base, 1, AI_MATKEY_BASE_COLOR);
  out->AddProperty(&metallic, 1, AI_MATKEY_METALLIC_FACTOR);
  out->AddProperty(&roughness, 1, AI_MATKEY_ROUGHNESS_FACTOR);
  out->AddProperty(&sides, 1, AI_MATKEY_TWOSIDED);
  return out;
}

/// The part of the triangles from `first` on, with the vertices that it uses.
Mesh part_of(const Mesh& mesh, size_t first, const MeshPart& part) {
  Mesh out;
  out.paint.parts = {part};

  constexpr uint32_t none = std::numeric_limits<uint32_t>::max();
  vector<uint32_t> number(mesh.vertices.size(), none);
  for (size_t i = first; i < first + size_t{3} * part.triangles; ++i) {
    const uint32_t from = mesh.triangles[i];

    // Vertices are numbered in the order in which triangles use them.
    if (number[from] == none) {
      number[from] = static_cast<uint32_t>(out.vertices.size());
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

unique_ptr<aiTexture> texture_of(const MeshTexture& texture) {
  const string bytes = png_of(texture);
  auto out = make_unique<aiTexture>();
  // assimp deletes texels of four bytes.
  out->mWidth = static_cast<unsigned>(bytes.size());
  out->mHeight = 0;
  out->pcData = new aiTexel[bytes.size() / sizeof(aiTexel) + 1];
  std::memcpy(out->pcData, bytes.data(), bytes.size());
  std::strcpy(out->achFormatHint, "png");
  return out;
}

int mode_of_axis(Wrap wrap) {
  return wrap == Wrap::mirror  ? aiTextureMapMode_Mirror
         : wrap == Wrap::clamp ? aiTextureMapMode_Clamp
                               : aiTextureMapMode_Wrap;
}

}  // namespace

size_t GlbMeshes::material(const Color& color, bool two_sided) {
  const auto [found, is_new] =
      material_numbers_.try_emplace({Srgb{color.r, color.g, color.b}, two_sided}, materials_.size());
  if (is_new) {
    const auto c = linear(color);
    materials_.push_back(
        material_of({c[0], c[1], c[2], 1}, two_sided, hex_text(color) + (two_sided ? ", two-sided" : "")));
  }
  return found->second;
}

size_t GlbMeshes::texture(const MeshTexture& picture) {
  unique_ptr<aiTexture> made = texture_of(picture);
  const auto same = [&](const unique_ptr<aiTexture>& other) {
    return other->mWidth == made->mWidth && std::memcmp(other->pcData, made->pcData, made->mWidth) == 0;
  };
  const auto found = std::ranges::find_if(textures_, same);
  const auto number = static_cast<size_t>(found - textures_.begin());
  if (found == textures_.end()) textures_.push_back(std::move(made));
  return number;
}

size_t GlbMeshes::material(const MeshPart& part, const vector<size_t>& textures, const string& name) {
  const auto& f = part.factor;
  // Pictures show both sides.
  unique_ptr<aiMaterial> out = material_of({f[0], f[1], f[2], f[3]}, true, name);

  if (part.cutoff > 0) {
    const aiString mask("MASK");
    out->AddProperty(&mask, AI_MATKEY_GLTF_ALPHAMODE);
    out->AddProperty(&part.cutoff, 1, AI_MATKEY_GLTF_ALPHACUTOFF);
  }

  if (part.texture > 0) {
    const aiString file(fmt::format("*{}", textures[part.texture - 1]));
    const aiString sampler(
        fmt::format("{}{}{}", static_cast<int>(part.wrap[0]), static_cast<int>(part.wrap[1]), part.sharp));
    const array<int, 2> modes{mode_of_axis(part.wrap[0]), mode_of_axis(part.wrap[1])};

    // GL_NEAREST, GL_LINEAR
    const int filter = part.sharp ? 9728 : 9729;

    out->AddProperty(&file, AI_MATKEY_TEXTURE(aiTextureType_BASE_COLOR, 0));
    out->AddProperty(&sampler, AI_MATKEY_GLTF_MAPPINGID(aiTextureType_BASE_COLOR, 0));
    out->AddProperty(&modes[0], 1, AI_MATKEY_MAPPINGMODE_U(aiTextureType_BASE_COLOR, 0));
    out->AddProperty(&modes[1], 1, AI_MATKEY_MAPPINGMODE_V(aiTextureType_BASE_COLOR, 0));
    out->AddProperty(&filter, 1, AI_MATKEY_GLTF_MAPPINGFILTER_MAG(aiTextureType_BASE_COLOR, 0));
  }

  materials_.push_back(std::move(out));
  return materials_.size() - 1;
}

unsigned GlbMeshes::add(const Mesh& mesh, size_t material, const string& name) {
  meshes_.push_back(mesh_of(mesh, material, name));
  return static_cast<unsigned>(meshes_.size() - 1);
}

GlbMeshes::Numbers GlbMeshes::single(const Mesh& mesh, const Color& color, bool two_sided, const string& name) {
  if (mesh.paint.parts.empty()) return {add(mesh, material(color, two_sided), name)};
  Numbers numbers;
  vector<size_t> textures;
  for (const MeshTexture& picture : mesh.paint.textures) textures.push_back(texture(picture));
  size_t first = 0;
  for (const MeshPart& part : mesh.paint.parts) {
    if (part.triangles == 0) continue;
    const size_t look = part.colored ? material(part, textures, name) : material(color, two_sided);
    numbers.push_back(add(part_of(mesh, first, part), look, name));
    first += size_t{3} * part.triangles;
  }
  return numbers;
}

const GlbMeshes::Numbers& GlbMeshes::volume(Shape shape, const Color& color) {
  const auto [found, is_new] = volumes_.try_emplace({shape, Srgb{color.r, color.g, color.b}});
  if (is_new) {
    const Mesh mesh = shape == Shape::sphere ? round_ball() : shape == Shape::cylinder ? round_cylinder() : unit_box();
    constexpr const char* names[] = {"ball", "cylinder", "box"};
    found->second =
        single(mesh, color, false, fmt::format("{} {}", names[static_cast<size_t>(shape)], hex_text(color)));
  }
  return found->second;
}

const GlbMeshes::Numbers& GlbMeshes::file(const MeshUse& use, const Color& color) {
  const array<double, 4> how = {use.center.x(), use.center.y(), use.center.z(), use.scale};

  // A mesh whose parts all have a colour is the same for every body.
  constexpr Srgb any{-1, -1, -1};
  const Srgb own{color.r, color.g, color.b};
  for (const Srgb& of : {any, own})
    if (const auto same = files_.find({use.file, how, use.own_colors, of}); same != files_.end()) return same->second;

  const Mesh mesh = drawn_mesh(use);
  const auto& parts = mesh.paint.parts;
  const bool colored = !parts.empty() && std::ranges::all_of(parts, [](const MeshPart& part) { return part.colored; });

  Numbers& numbers = files_[{use.file, how, use.own_colors, colored ? any : own}];
  const string name = parts.empty() ? "mesh " + hex_text(color) : std::filesystem::path(use.file).stem().string();
  numbers = single(mesh, color, false, name);
  return numbers;
}

void GlbMeshes::hand_over(aiScene& scene) {
  hand_over_all(meshes_, scene.mMeshes, scene.mNumMeshes);
  hand_over_all(materials_, scene.mMaterials, scene.mNumMaterials);
  if (!textures_.empty()) hand_over_all(textures_, scene.mTextures, scene.mNumTextures);
}

}  // namespace carom
