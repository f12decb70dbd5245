// What comes through the pipe from the reader of meshes is checked in every part.
#include "render/mesh_reply.h"
#include "std.h"

#include <gtest/gtest.h>

#include <cstring>

namespace carom {
namespace {

/// A triangle in one part with a texture of 2 x 1 pixels.
struct Reply {
  MeshReplyHead head{3, 1, 0, 1, 1};
  array<float, 9> positions{0, 0, 0, 1, 0, 0, 0, 1, 0}, normals{};
  array<uint32_t, 3> triangle{0, 1, 2};
  MeshPart part{1, 1, {}, 0, 1, 0, {1, 1, 1, 1}};
  array<float, 6> uv{};
  array<float, 9> tint{};
  array<uint32_t, 2> sides{2, 1};
  array<uint8_t, 8> rgba{1, 2, 3, 4, 5, 6, 7, 8};

  string bytes() const {
    string all;
    const auto put = [&](const auto& item) { all.append(reinterpret_cast<const char*>(&item), sizeof item); };
    put(head), put(positions), put(normals), put(triangle), put(part), put(uv), put(tint), put(sides), put(rgba);
    return all;
  }
};

Mesh received(string_view bytes, const MeshLimits& limits = {}) {
  return receive_mesh({[&](void* to, size_t size) {
                         if (size > bytes.size()) return false;
                         if (size > 0) std::memcpy(to, bytes.data(), size);
                         bytes.remove_prefix(size);
                         return true;
                       },
                       [] { return string("cut off"); }},
                      limits);
}

string refusal(const function<void(Reply&)>& damage) {
  Reply reply;
  damage(reply);
  try {
    received(reply.bytes());
    return "";
  } catch (const runtime_error& error) {
    return error.what();
  }
}

TEST(MeshReply, ReturnsThePaint) {
  const Mesh mesh = received(Reply{}.bytes());
  ASSERT_EQ(mesh.paint.textures.size(), 1U);
  EXPECT_EQ(mesh.paint.textures[0].width, 2U);
  EXPECT_EQ(mesh.paint.textures[0].rgba, (vector<uint8_t>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(mesh.paint.parts.at(0).texture, 1U);
  EXPECT_EQ(mesh.paint.uv.size(), 3U);
}

TEST(MeshReply, EveryDamageOfThePaintIsFound) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const function<void(Reply&)> damages[] = {
      [](Reply& r) { r.part.texture = 2; },
      [](Reply& r) { r.part.triangles = 2; },
      [](Reply& r) { r.part.triangles = 0; },
      [](Reply& r) { r.part.wrap[1] = static_cast<Wrap>(3); },
      [](Reply& r) { r.part.sharp = 2; },
      [](Reply& r) { r.part.colored = 2; },
      // Numbers out of their range.
      [](Reply& r) { r.part.cutoff = nan; },
      [](Reply& r) { r.part.cutoff = -1; },
      [](Reply& r) { r.part.factor[3] = nan; },
      [](Reply& r) { r.part.factor[0] = 1.5F; },
      [](Reply& r) { r.uv[5] = infinity; },
      [](Reply& r) { r.tint[8] = nan; },
      [](Reply& r) { r.tint[0] = -1; },
      // Sides of a texture.
      [](Reply& r) {
        r.sides = {0, 1};
      },
      [](Reply& r) {
        r.sides = {4097, 1};
      },
      [](Reply& r) {
        r.sides = {1U << 31U, 1U << 31U};
      },  // their product and 4 overflow

      [](Reply& r) { r.head.parts = ~0U; },
      [](Reply& r) { r.head.textures = ~0U; },
  };

  EXPECT_EQ(refusal([](Reply&) {}), "");
  for (size_t i = 0; i < std::size(damages); ++i) EXPECT_EQ(refusal(damages[i]), "it is damaged") << i;
  EXPECT_EQ(refusal([](Reply& r) { r.sides = {3, 1}; }), "cut off");
  EXPECT_EQ(refusal([](Reply& r) { r.head.textures = 2; }), "cut off");
}

TEST(MeshReply, TexturesHaveALimitInAll) {
  MeshLimits limits;
  limits.texture_bytes = 7;
  EXPECT_THROW(received(Reply{}.bytes(), limits), runtime_error);
}

}  // namespace
}  // namespace carom
