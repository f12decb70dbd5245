// Translates assimp's materials. glTF: pbrMetallicRoughness, alphaMode, KHR_texture_transform, samplers. Wavefront: Kd
// and map_Kd. Of a material only the base colour is used: the surfaces of pictures are all alike.
#include "render/mesh_materials.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <fmt/format.h>

#include "numerics/srgb.h"
#include "render/texture_decode.h"
#include "std.h"

namespace carom {
namespace {

constexpr float blend_cutoff = 0.5F;
constexpr int nearest_pixel = 9728;  // GL_NEAREST of a glTF sampler

string texture_name(const aiMaterial& material) {
  aiString name;
  return material.Get(AI_MATKEY_TEXTURE(aiTextureType_DIFFUSE, 0), name) == AI_SUCCESS ? name.C_Str() : "";
}

string alpha_mode(const aiMaterial& material) {
  aiString mode;
  return material.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == AI_SUCCESS ? mode.C_Str() : "";
}

Wrap wrap_of(int mode) {
  return mode == aiTextureMapMode_Mirror                                    ? Wrap::mirror
         : mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal ? Wrap::clamp
                                                                            : Wrap::repeat;
}

/// u' = offset + R S u in glTF's frame (v downwards, KHR_texture_transform), R a turn against the clock.
/// assimp gives the offset of a turn about the picture's centre with v upwards (its glTF2Importer.cpp). That is undone.
void add_transform(const aiUVTransform& t, PartSource& source) {
  const float c = std::cos(-t.mRotation), s = std::sin(-t.mRotation), sx = t.mScaling.x, sy = t.mScaling.y;
  const float offset_u = t.mTranslation.x - 0.5F * sx * (1 - c + s);
  const float offset_v = 1 - sy - t.mTranslation.y + 0.5F * sy * (s + c - 1);
  // With v = 1 - assimp's.
  const array<array<float, 3>, 2> uv = {{{c * sx, -s * sy, offset_u + s * sy}, {-s * sx, -c * sy, offset_v + c * sy}}};
  for (const auto& row : uv)
    for (const float x : row)
      if (!isfinite(x)) return;
  source.uv = uv;
}

/// The same for Wavefront, where v is upwards as assimp has it.
array<array<float, 3>, 2> uv_of(const WavefrontPlacement& placement) {
  const auto [scale, offset] = placement;
  return {{{scale[0], 0, offset[0]}, {0, -scale[1], 1 - offset[1]}}};
}

}  // namespace

MeshMaterials::MeshMaterials(const aiScene& scene, const MeshFiles& files, const string& ending,
                             const MeshLimits& limits)
    : scene_(scene), files_(files), limits_(limits), wavefront_(ending == "obj") {
  // A picture may be needed twice, opaque and not.
  set<pair<string, string>> names;
  for (unsigned i = 0; i < scene.mNumMaterials; ++i)
    names.insert({texture_name(*scene.mMaterials[i]), alpha_mode(*scene.mMaterials[i])});
  most_kept_ = max<uint64_t>(limits.texture_bytes / 4 / max<size_t>(names.size(), 1), 1);
}

bool MeshMaterials::gives_color(const aiMesh& mesh, const aiMaterial& material) const {
  if (mesh.mColors[0]) return true;
  if (wavefront_) return files_.defines(material.GetName().C_Str());
  // assimp's last material of a glTF file stands for none.
  return mesh.mMaterialIndex + 1 < scene_.mNumMaterials;
}

PartSource MeshMaterials::of(const aiMesh& mesh) {
  PartSource source;
  if (mesh.mMaterialIndex >= scene_.mNumMaterials) return source;
  const aiMaterial& material = *scene_.mMaterials[mesh.mMaterialIndex];
  if (!gives_color(mesh, material)) return source;

  MeshPart& part = source.part;
  part.colored = 1;
  source.srgb_tint = wavefront_;

  if (wavefront_) {
    aiColor3D color(1, 1, 1);
    if (files_.defines(material.GetName().C_Str())) material.Get(AI_MATKEY_COLOR_DIFFUSE, color);
    for (unsigned c = 0; c < 3; ++c) part.factor[c] = float(light_of_srgb(double{color_share(color[c])}));
  } else {
    aiColor4D color(1, 1, 1, 1);
    material.Get(AI_MATKEY_BASE_COLOR, color);
    for (unsigned c = 0; c < 4; ++c) part.factor[c] = color_share(color[c]);

    const string alpha = alpha_mode(material);
    if (alpha == "BLEND") part.cutoff = blend_cutoff;
    if (alpha == "MASK") {
      part.cutoff = blend_cutoff;
      material.Get(AI_MATKEY_GLTF_ALPHACUTOFF, part.cutoff);
      part.cutoff = isfinite(part.cutoff) ? max(part.cutoff, 0.0F) : 0;
    }
  }

  add_texture(material, part.cutoff == 0, source);
  if (wavefront_) source.uv = uv_of(files_.placement(material.GetName().C_Str()));
  return source;
}

void MeshMaterials::add_texture(const aiMaterial& material, bool opaque, PartSource& source) {
  const string name = texture_name(material);
  if (name.empty()) return;

  const auto number = [&](const char* key, unsigned type, unsigned index) {
    int value = 0;
    return material.Get(key, type, index, value) == AI_SUCCESS ? value : 0;
  };

  MeshPart& part = source.part;
  source.uv_set = unsigned(max(number(AI_MATKEY_UVWSRC(aiTextureType_DIFFUSE, 0)), 0));
  part.wrap = {wrap_of(number(AI_MATKEY_MAPPINGMODE_U(aiTextureType_DIFFUSE, 0))),
               wrap_of(number(AI_MATKEY_MAPPINGMODE_V(aiTextureType_DIFFUSE, 0)))};

  if (!wavefront_) {
    part.sharp = number(AI_MATKEY_GLTF_MAPPINGFILTER_MAG(aiTextureType_DIFFUSE, 0)) == nearest_pixel ? 1 : 0;
    aiUVTransform transform;
    if (material.Get(AI_MATKEY_UVTRANSFORM(aiTextureType_DIFFUSE, 0), transform) == AI_SUCCESS)
      add_transform(transform, source);
  }

  const auto [found, is_new] = known_.try_emplace({name, opaque}, uint32_t(textures_.size() + 1));
  part.texture = found->second;
  if (!is_new) return;

  textures_.push_back(texture(name));
  if (opaque)
    for (size_t i = 3; i < textures_.back().rgba.size(); i += 4) textures_.back().rgba[i] = 255;
}

MeshTexture MeshMaterials::texture(const string& name) const {
  const aiTexture* const inside = scene_.GetEmbeddedTexture(name.c_str());
  const string shown = inside ? "in the mesh" : name;
  if (inside && inside->mHeight > 0) throw runtime_error("its texture in the mesh is neither PNG nor JPEG");
  const string bytes = inside ? string(reinterpret_cast<const char*>(inside->pcData), inside->mWidth)
                              : files_.read("texture", name, limits_.file_bytes);
  try {
    return decoded_texture(bytes, limits_.texture_pixels, most_kept_);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw runtime_error(fmt::format("its texture {} {}", shown, error.what()));
  }
}

}  // namespace carom
