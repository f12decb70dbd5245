#pragma once
// The fixed surfaces near a position. One that moves is near if it ever comes there. Where there are many, the few near
// a cell of space are collected once, at the first search in that cell.
#include <unordered_map>

#include "numerics/vec3.h"
#include "physics/entity.h"
#include "std.h"

namespace carom {

struct Obstacle;
struct World;

class SurfacesNear {
 public:
  /// `world` must outlive this object.
  explicit SurfacesNear(const World& world);

  /// Finds surfaces within `reach` (m) of `center` (m), ascending. Some that are slightly farther away may be among
  /// them.
  void find(const Vec3& center, double reach, vector<Entity>& found);

 private:
  /// x . normal - offset is the distance from a plane.
  struct HalfSpace {
    Vec3 normal;
    double offset, rounding;  // m
  };
  /// The box around all places of a wall's or an obstacle's centre.
  struct Places {
    Vec3 low, high;  // m
  };
  struct Cell {
    int64_t x, y, z;
    int size;  // 2^size m wide
    friend bool operator==(const Cell&, const Cell&) = default;
  };
  struct Hash {
    size_t operator()(const Cell& cell) const;
  };

  void sweep(Entity e);
  [[gnu::always_inline]] bool is_near(Entity e, const Vec3& center, double reach) const;
  [[gnu::noinline]] static bool is_shell_near(const Obstacle& shell, const Vec3& center, double reach);
  bool comes_near(Entity e, const Vec3& center, double reach) const;
  [[gnu::noinline]] void take_ever_near(const vector<Entity>& from, const Vec3& center, double reach,
                                        vector<Entity>& found) const;

  const World& world_;
  vector<HalfSpace> planes_;  // of a plane that moves: the farthest out along its normal
  vector<Places> places_;     // by fixed thing; empty: nothing moves
  vector<Entity> all_;
  std::unordered_map<Cell, vector<Entity>, Hash> cells_;
};

}  // namespace carom
