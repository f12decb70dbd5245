// Converts planes, walls and obstacles to triangles. Planes are cut off at a cube around the scene, and at each other.
// Round shapes are subdivided by midpoints and square roots alone, so that corners are the same on every machine.
#include "render/still_things.h"

#include "physics/world.h"
#include "render/mesh.h"
#include "render/render_error.h"
#include "render/surfaces.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

/// A convex polygon without its part behind a plane (Sutherland and Hodgman 1974).
vector<Vec3> cut(const vector<Vec3>& polygon, const Vec3& point, const Vec3& normal) {
  vector<Vec3> left;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double above_a = normal.dot(a - point), above_b = normal.dot(b - point);
    if (above_a >= 0) left.push_back(a);
    if ((above_a < 0) != (above_b < 0)) left.push_back(a + above_a / (above_a - above_b) * (b - a));
  }
  return left;
}

/// A flat convex polygon, counterclockwise about `normal`.
Mesh flat(const vector<Vec3>& corners, const Vec3& normal) {
  Mesh mesh{corners, vector<Vec3>(corners.size(), normal), {}};
  for (uint32_t k = 2; k < corners.size(); ++k) mesh.triangles.insert(mesh.triangles.end(), {0, k - 1, k});
  return mesh;
}

vector<Vec3> rectangle(const Vec3& center, const Vec3& right, const Vec3& up) {
  return {center - right - up, center + right - up, center + right + up, center - right + up};
}

class Collector {
 public:
  Collector(const Scene& scene, const Extent& seen, bool painted)
      : scene_(scene), world_(scene.world), painted_(painted) {
    find_cube(seen);
  }

  vector<StillThing> collect() {
    for (size_t i = 0; i < world_.planes.size(); ++i)
      if (name(i).visible) add_plane(i);
    for (size_t i = 0; i < world_.walls.size(); ++i) {
      const Wall& wall = world_.walls[i];
      add(world_.planes.size() + i,
          flat(rectangle(wall.center, wall.half_width * wall.right, wall.half_height * wall.up), wall.normal), true);
    }
    for (size_t i = 0; i < world_.obstacles.size(); ++i)
      add(world_.planes.size() + world_.walls.size() + i,
          obstacle_mesh(world_.obstacles[i], look_of_obstacle(scene_, i)), false);
    return std::move(things_);
  }

 private:
  const FixedLook& name(size_t fixed) const {
    static const FixedLook unnamed{"", {0.8, 0.8, 0.8}, true};
    return fixed < scene_.roster.fixed.size() ? scene_.roster.fixed[fixed] : unnamed;
  }

  /// Finds the cube around all bounded things and around the points of the visible planes opposite its centre.
  void find_cube(const Extent& seen) {
    Extent all = seen;
    for (size_t i = 0; i < world_.walls.size(); ++i) {
      const Wall& wall = world_.walls[i];
      const Vec3 half = wall.half_width * wall.right.cwiseAbs() + wall.half_height * wall.up.cwiseAbs();
      if (name(world_.planes.size() + i).visible) all.include(wall.center, half);
    }

    for (size_t i = 0; i < world_.obstacles.size(); ++i)
      if (look_of_obstacle(scene_, i).visible) all.include(world_.obstacles[i].center, world_.obstacles[i].volume.half);

    // Without any of these, the planes' own points.
    if ((all.low.array() > all.high.array()).any()) {
      for (const Plane& plane : world_.planes) all.include(plane.point);
      all.include(Vec3::Zero());
    }

    const Vec3 middle = 0.5 * (all.low + all.high);
    for (size_t i = 0; i < world_.planes.size(); ++i) {
      const Plane& plane = world_.planes[i];
      if (name(i).visible) all.include(middle - plane.normal.dot(middle - plane.point) * plane.normal);
    }

    center_ = 0.5 * (all.low + all.high);
    half_ = max(1.5 * (0.5 * (all.high - all.low)).maxCoeff(), 1e-9);
  }

  void add_plane(size_t i) {
    const Plane& plane = world_.planes[i];
    // Along a world axis, if there is one in the plane.
    const Vec3 along = std::abs(plane.normal.y()) < 0.999 ? Vec3(0, 1, 0) : Vec3(0, 0, -1);
    const Vec3 right = along.cross(plane.normal).normalized(), up = plane.normal.cross(right);
    const Vec3 foot = center_ - plane.normal.dot(center_ - plane.point) * plane.normal;
    vector<Vec3> corners = rectangle(foot, 2 * half_ * right, 2 * half_ * up);
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0})
        corners = cut(corners, center_ + side * half_ * Vec3::Unit(axis), -side * Vec3::Unit(axis));
    for (size_t k = 0; k < world_.planes.size(); ++k)
      if (k != i && name(k).visible) corners = cut(corners, world_.planes[k].point, world_.planes[k].normal);
    if (corners.size() >= 3) add(i, flat(corners, plane.normal), false);
  }

  Mesh obstacle_mesh(const Obstacle& obstacle, const FixedLook& name) {
    if (!name.visible) return {};
    const Volume& volume = obstacle.volume;
    if (obstacle.hollow != Hollow::none || !name.inward.isZero(0)) return shell_mesh(obstacle, name.inward);
    if (name.mesh) {
      MeshUse use = *name.mesh;
      use.own_colors = use.own_colors && painted_;
      return placed(drawn_mesh(use), Vec3::Ones(), obstacle.center);
    }
    const auto known = shapes_.find(volume.shape);
    const Mesh& mesh =
        known != shapes_.end() ? known->second : shapes_.emplace(volume.shape, shape(volume.shape)).first->second;
    return placed(mesh, volume.half, obstacle.center);
  }

  /// A part of a hollow obstacle, as it is seen from within: a face that looks `inward`, or the back of what is round.
  static Mesh shell_mesh(const Obstacle& obstacle, const Vec3& inward) {
    const bool flat = !inward.isZero(0);
    const Mesh whole = shape(obstacle.volume.shape);
    const auto is_part = [&](const Vec3& middle, const Vec3& normal) {
      if (flat) return normal.dot(inward) > 0.5;
      return obstacle.hollow == Hollow::side         ? std::abs(normal.y()) < 0.5
             : obstacle.hollow == Hollow::lower_half ? middle.y() < 0
             : obstacle.hollow == Hollow::upper_half ? middle.y() > 0
                                                     : true;
    };

    // Only the vertices of its triangles, so that its extent is its own.
    Mesh mesh;
    map<uint32_t, uint32_t> numbers;
    const auto number = [&](uint32_t vertex) {
      const auto [known, fresh] = numbers.try_emplace(vertex, uint32_t(mesh.vertices.size()));
      if (!fresh) return known->second;
      mesh.vertices.emplace_back(obstacle.center + obstacle.volume.half.cwiseProduct(whole.vertices[vertex]));
      mesh.normals.emplace_back(flat ? inward : Vec3(-whole.normals[vertex]));
      return known->second;
    };

    for (size_t t = 0; t < whole.triangles.size(); t += 3) {
      const uint32_t i = whole.triangles[t], j = whole.triangles[t + 1], k = whole.triangles[t + 2];
      const Vec3 middle = whole.vertices[i] + whole.vertices[j] + whole.vertices[k];
      if (!is_part(middle, whole.normals[i] + whole.normals[j] + whole.normals[k])) continue;
      for (const uint32_t vertex : {i, flat ? j : k, flat ? k : j}) mesh.triangles.push_back(number(vertex));
    }
    return mesh;
  }

  static Mesh shape(Shape shape) {
    return shape == Shape::sphere ? round_ball() : shape == Shape::cylinder ? round_cylinder() : unit_box();
  }

  void add(size_t fixed, Mesh mesh, bool two_sided) {
    if (name(fixed).visible)
      things_.push_back({name(fixed).name, name(fixed).color, std::move(mesh), two_sided, fixed});
  }

  const Scene& scene_;
  const World& world_;
  const bool painted_;
  Vec3 center_;      // m, centre of the cube
  double half_ = 0;  // m, half of its edge
  map<Shape, Mesh> shapes_;
  vector<StillThing> things_;
};

}  // namespace

vector<StillThing> still_things(const Scene& scene, const Extent& seen, bool painted) {
  return Collector(scene, seen, painted).collect();
}

Mesh unit_box() {
  Mesh mesh;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const Vec3 normal = (face % 2 ? 1 : -1) * Vec3::Unit(axis), u = Vec3::Unit((axis + 1) % 3), v = normal.cross(u);
    const auto first = uint32_t(mesh.vertices.size());
    for (const auto& [a, b] : {pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
      mesh.vertices.push_back(normal + a * u + b * v);
      mesh.normals.push_back(normal);
    }
    for (const uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.triangles.push_back(first + k);
  }
  return mesh;
}

Mesh round_ball() {
  // An octahedron. Each of its triangles is divided into four, again and again.
  constexpr int times = 4;
  Mesh mesh;
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};

  for (int i = 0; i < times; ++i) {
    map<pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), mesh.vertices.size());
      if (is_new) mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
      return found->second;
    };

    vector<uint32_t> finer;
    for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
      const uint32_t a = mesh.triangles[t], b = mesh.triangles[t + 1], c = mesh.triangles[t + 2];
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    mesh.triangles = std::move(finer);
  }

  mesh.normals = mesh.vertices;
  return mesh;
}

Mesh round_cylinder() {
  // The corners of a square. The point of the circle half way between each two is added, again and again.
  vector<Vec3> circle = {{1, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 0, -1}};
  while (circle.size() < 64) {
    vector<Vec3> finer;
    for (size_t k = 0; k < circle.size(); ++k) {
      finer.push_back(circle[k]);
      finer.push_back((circle[k] + circle[(k + 1) % circle.size()]).normalized());
    }
    circle = std::move(finer);
  }

  const Vec3 up(0, 1, 0);
  const auto sides = uint32_t(circle.size());
  Mesh mesh;
  for (uint32_t k = 0; k < sides; ++k) {
    // Vertices of the flank.
    for (const double y : {-1.0, 1.0}) {
      mesh.vertices.push_back(circle[k] + y * up);
      mesh.normals.push_back(circle[k]);
    }

    // Vertices of the ends.
    for (const double y : {-1.0, 1.0}) {
      mesh.vertices.push_back(circle[k] + y * up);
      mesh.normals.push_back(y * up);
    }

    const uint32_t a = 4 * k, b = 4 * ((k + 1) % sides);
    mesh.triangles.insert(mesh.triangles.end(), {a, a + 1, b + 1, a, b + 1, b});
    if (k > 0 && k + 1 < sides) mesh.triangles.insert(mesh.triangles.end(), {2, a + 2, b + 2, 3, b + 3, a + 3});
  }
  return mesh;
}

Mesh placed(const Mesh& mesh, const Vec3& scale, const Vec3& middle) {
  Mesh out = mesh;
  for (Vec3& vertex : out.vertices) vertex = middle + scale.cwiseProduct(vertex);
  for (Vec3& normal : out.normals)
    if (!normal.isZero(0)) normal = normal.cwiseQuotient(scale).normalized();
  return out;
}

void turn_mesh(Mesh& mesh, const MeshTurn& turn) {
  if (turn == no_turn) return;
  for (Vec3& vertex : mesh.vertices) vertex = turned(turn, vertex);
  for (Vec3& normal : mesh.normals) normal = turned(turn, normal);
}

Mesh drawn_mesh(const MeshUse& use) {
  try {
    Mesh mesh = use.own_colors ? read_painted_mesh(use.file) : read_mesh(use.file);
    turn_mesh(mesh, use.turn);
    return placed(mesh, Vec3::Constant(use.scale), -use.scale * use.center);
  } catch (const runtime_error& error) {
    throw RenderError(error.what());
  }
}

}  // namespace carom
