#pragma once
// Which fixed surfaces are near a place. Where there are many, the few that come near a cell of space are found out
// once, when somebody first asks there.
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "numerics/vec3.h"
#include "physics/entity.h"

namespace carom {

struct World;

class SurfacesNear {
 public:
  /// `world` must outlive this.
  explicit SurfacesNear(const World& world);

  /// Those that come within `reach` (m) of `center` (m), ascending, and perhaps some that do not quite.
  void find(const Vec3& center, double reach, std::vector<Entity>& found);

 private:
  /// x . normal - offset is the distance from a plane.
  struct HalfSpace {
    Vec3 normal;
    double offset, rounding;  // m
  };
  struct Cell {
    std::int64_t x, y, z;
    int size;  // 2^size m wide
    friend bool operator==(const Cell&, const Cell&) = default;
  };
  struct Hash {
    std::size_t operator()(const Cell& cell) const;
  };

  bool is_near(Entity e, const Vec3& center, double reach) const;

  const World& world_;
  std::vector<HalfSpace> planes_;
  std::vector<Entity> all_;
  std::unordered_map<Cell, std::vector<Entity>, Hash> cells_;
};

}  // namespace carom
