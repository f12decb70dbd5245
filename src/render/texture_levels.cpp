// Reduces textures by the mean over areas, along rows and then along columns. OpenGL's own mipmaps are not used: how
// they divide odd sides depends on the driver. Weights are ratios of whole numbers, so that the bytes are the same
// everywhere.
#include "render/texture_levels.h"

#include "numerics/srgb.h"
#include "std.h"

namespace carom {
namespace {

/// By byte.
const array<float, 256>& lights() {
  static const array<float, 256> made = [] {
    array<float, 256> light{};
    for (size_t i = 0; i < light.size(); ++i) light[i] = float(light_of_srgb(double(i) / 255));
    return light;
  }();
  return made;
}

uint8_t byte_of(float light) {
  const float root = sqrt(clamp(light, 0.0F, 1.0F));
  return srgb_bytes().of_root[size_t(std::lround(root * SrgbBytes::steps))];
}

/// The share of one long pixel in a short one.
struct Share {
  uint32_t from, to;  // numbers of pixels
  float weight;
};

/// How `from` pixels in a row become `to`.
vector<Share> shares(uint32_t from, uint32_t to) {
  vector<Share> out;
  for (uint64_t k = 0; k < to; ++k)
    for (uint64_t i = k * from / to; i * to < (k + 1) * from; ++i) {
      const uint64_t low = max(i * to, k * from), high = min((i + 1) * to, (k + 1) * from);
      out.push_back({uint32_t(i), uint32_t(k), float(high - low) / float(from)});
    }
  return out;
}

using Pixel = array<float, 4>;

Pixel loaded(const uint8_t* rgba) {
  const float opacity = float(rgba[3]) / 255;
  return {lights()[rgba[0]], lights()[rgba[1]], lights()[rgba[2]], opacity};
}

void store(const Pixel& sum, uint8_t* rgba) {
  for (size_t c = 0; c < 3; ++c) rgba[c] = sum[3] > 0 ? byte_of(sum[c] / sum[3]) : 0;
  rgba[3] = uint8_t(std::lround(clamp(sum[3], 0.0F, 1.0F) * 255));
}

}  // namespace

MeshTexture reduced(const MeshTexture& texture, uint32_t width, uint32_t height) {
  MeshTexture out{width, height, vector<uint8_t>(size_t{4} * width * height)};
  const vector<Share> across = shares(texture.width, width), down = shares(texture.height, height);
  vector<Pixel> row(width), sum(width);

  for (size_t k = 0; k < down.size(); ++k) {
    const uint8_t* from = texture.rgba.data() + size_t{4} * texture.width * down[k].from;
    ranges::fill(row, Pixel{});

    for (const Share& share : across) {
      const Pixel pixel = loaded(from + size_t{4} * share.from);
      // Colours are weighted by opacity.
      for (size_t c = 0; c < 4; ++c) row[share.to][c] += share.weight * pixel[c] * (c < 3 ? pixel[3] : 1);
    }

    if (k == 0 || down[k].to != down[k - 1].to) ranges::fill(sum, Pixel{});
    for (uint32_t x = 0; x < width; ++x)
      for (size_t c = 0; c < 4; ++c) sum[x][c] += down[k].weight * row[x][c];

    // The row is done when the next one adds nothing to it.
    if (k + 1 < down.size() && down[k + 1].to == down[k].to) continue;
    for (uint32_t x = 0; x < width; ++x) store(sum[x], &out.rgba[4 * (size_t{width} * down[k].to + x)]);
  }
  return out;
}

vector<MeshTexture> coarser_levels(const MeshTexture& texture) {
  vector<MeshTexture> levels;
  const MeshTexture* last = &texture;
  while (last->width > 1 || last->height > 1) {
    levels.push_back(reduced(*last, max(last->width / 2, 1U), max(last->height / 2, 1U)));
    last = &levels.back();
  }
  return levels;
}

array<float, 4> light_of(const MeshTexture& texture, uint32_t x, uint32_t y) {
  return loaded(&texture.rgba[4 * (size_t{texture.width} * y + x)]);
}

}  // namespace carom
