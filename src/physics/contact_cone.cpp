#include "physics/contact_cone.h"

#include <array>
#include <cmath>

namespace carom {

namespace {

/// Below this, relative to |u|, a component is rounding.
constexpr double rounding = 64 * 0x1p-53;

}  // namespace

// Three pressing surfaces at most matter in space, so the candidates are few: none, one, two, three of them.
Vec3 project_to_cone(const Vec3& u, std::span<const Vec3> normals, unsigned& active) {
  const double tolerance = rounding * u.norm();
  const auto n = static_cast<unsigned>(normals.size());
  const auto allowed = [&](const Vec3& v) {
    for (const Vec3& normal : normals)
      if (normal.dot(v) < -tolerance) return false;
    return true;
  };
  active = 0;
  if (allowed(u)) return u;
  for (unsigned i = 0; i < n; ++i) {
    const double push = -normals[i].dot(u);
    if (push <= 0) continue;
    Vec3 v = u + push * normals[i];
    v -= normals[i].dot(v) * normals[i];  // once more: what rounding left
    if (allowed(v)) {
      active = 1u << i;
      return v;
    }
  }
  for (unsigned i = 0; i < n; ++i) {
    for (unsigned j = i + 1; j < n; ++j) {
      const double c = normals[i].dot(normals[j]);
      const Vec3 edge = normals[i].cross(normals[j]);
      const double sine2 = edge.squaredNorm();
      if (sine2 < rounding) continue;
      const double ui = -normals[i].dot(u), uj = -normals[j].dot(u);
      if (ui - c * uj < 0 || uj - c * ui < 0) continue;  // lambda times sine2
      const Vec3 v = edge * (edge.dot(u) / sine2);
      if (allowed(v)) {
        active = 1u << i | 1u << j;
        return v;
      }
    }
  }
  // Three: held fast. Which of them press is decided for the first three that can hold it.
  for (unsigned i = 0; i < n; ++i)
    for (unsigned j = i + 1; j < n; ++j)
      for (unsigned k = j + 1; k < n; ++k) {
        const Vec3 &a = normals[i], &b = normals[j], &c = normals[k];
        const double det = a.dot(b.cross(c));
        if (std::abs(det) < rounding) continue;
        const double la = -u.dot(b.cross(c)) / det, lb = -u.dot(c.cross(a)) / det, lc = -u.dot(a.cross(b)) / det;
        if (la >= -tolerance && lb >= -tolerance && lc >= -tolerance) {
          active = 1u << i | 1u << j | 1u << k;
          return Vec3::Zero();
        }
      }
  active = n < 32 ? (1u << n) - 1 : ~0u;
  return Vec3::Zero();
}

Vec3 project_to_common_plane(const Vec3& u, std::span<const Vec3> normals) {
  // An orthonormal basis of the normals, taken out of u twice: once for the value, once for what rounding left.
  std::array<Vec3, 3> basis;
  std::size_t rank = 0;
  for (const Vec3& normal : normals) {
    Vec3 n = normal;
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t k = 0; k < rank; ++k) n -= basis[k].dot(n) * basis[k];
    const double length = n.norm();
    if (rank < 3 && length > rounding) basis[rank++] = n / length;
  }
  if (rank == 3) return Vec3::Zero();
  Vec3 v = u;
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t k = 0; k < rank; ++k) v -= basis[k].dot(v) * basis[k];
  return v;
}

}  // namespace carom
