// Decodes planes, rooms, walls and obstacles.
// A thing with an error still gets a number, so that the numbers of the others do not shift.
// Its keys without a good value keep their defaults.
#include <fmt/format.h>

#include "physics/world.h"
#include "scene/decode.h"
#include "scene/fields.h"
#include "scene/hollow.h"
#include "scene/member.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

void add_plane(const PlaneKeys& plane, const string& name, Scene& scene) {
  scene.world.planes.push_back({plane.point, unit(plane.normal), plane.restitution});
  scene.roster.fixed.push_back({name, plane.color, plane.visible});
}

string part_of(const string& name, string_view part) {
  return part.empty() ? name : name + "." + string(part);
}

void add_room(const View& view, const string& name, Scene& scene, Diagnostics& diagnostics) {
  const auto room = filled<RoomKeys>(view);
  for (int axis = 0; room.min && room.max && axis < 3; ++axis) {
    if ((*room.min)[axis] < (*room.max)[axis]) continue;
    const char letter = "xyz"[axis];
    diagnostics.add(view.place("max"), "the room's max." + string(1, letter) + " is not above its min." + letter,
                    "expected min below max on every axis");
  }

  // Each side faces inward.
  const vector<string_view> names = part_names(view);
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    Vec3 normal = Vec3::Zero();
    normal[axis] = side % 2 == 0 ? 1 : -1;
    const optional<Vec3>& corner = side % 2 == 0 ? room.min : room.max;
    scene.world.planes.push_back({corner.value_or(Vec3::Zero()), normal, room.restitution});
    scene.roster.fixed.push_back({part_of(name, names[size_t(side)]), room.color, room.visible});
  }
}

/// Whether `unit_up` is so nearly parallel to the normal that it does not define the direction of the height.
bool is_parallel(const Vec3& unit_up, const Vec3& unit_normal) {
  return unit_up.cross(unit_normal).norm() <= 1e-9;
}

void add_wall(const View& view, const string& name, Scene& scene, Diagnostics& diagnostics) {
  const auto wall = filled<WallKeys>(view);
  const Vec3 normal = unit(wall.normal);
  Vec3 up = unit(wall.up.value_or(default_up(normal)));
  if (is_parallel(up, normal)) {
    diagnostics.add(view.place("up"), "up is parallel to the normal", "expected a direction along the wall");
    up = std::fabs(normal.x()) < 0.5 ? Vec3::UnitX() : Vec3::UnitY();
  }
  up = unit(up - normal * up.dot(normal));
  // right x up = normal.
  const Vec3 right = unit(up.cross(normal));
  scene.world.walls.push_back(
      {wall.center, normal, right, up, wall.size.width / 2, wall.size.height / 2, wall.restitution});
  scene.roster.fixed.push_back({name, wall.color, wall.visible});
}

void add_obstacle(const View& view, const string& name, Forms& forms, Scene& scene, Diagnostics& diagnostics) {
  const auto obstacle = filled<ObstacleKeys>(view);
  // The volume of an obstacle with errors is empty.
  const Form form = forms.of(obstacle, view.find("color") != nullptr).value_or(Form{});
  check_hollow_keys(view, name, diagnostics);
  for (const HollowPart& part : parts_of_obstacle(obstacle, form.volume)) {
    scene.world.obstacles.push_back(part.obstacle);
    scene.roster.fixed.push_back({part_of(name, part.name), obstacle.color, obstacle.visible, form.mesh, part.inward});
  }
}

/// The legs of a thing's motion. None: it has no `motion`, or it never moves.
vector<MotionLeg> motion_of(const View& thing, Diagnostics& diagnostics) {
  const Node* const list = thing.find("motion");
  if (list == nullptr || !list->is_sequence()) return {};

  vector<MotionWindow> windows;
  for (const Node& node : list->items) {
    if (!node.is_map()) continue;
    const View view(&node, kind_named("motion"), node.place);
    const auto [from, until, velocity] = filled<MotionKeys>(view);

    // A window has a length, and starts after the one before.
    if (!(from < until))
      diagnostics.add(view.place("until"),
                      fmt::format("`until` is {} but `from` is {}", shortest(until), shortest(from)),
                      "expected from < until");
    if (!windows.empty() && from < windows.back().until) {
      const double end = windows.back().until;
      diagnostics.add(view.place("from"),
                      fmt::format("this window starts at {} s, but the one before it {}", shortest(from),
                                  std::isinf(end) ? "never ends" : fmt::format("ends at {} s", shortest(end))),
                      "expected windows in order that do not overlap, each with `until` except the last");
    }

    if (velocity) windows.push_back({from, until, *velocity});
  }
  return legs_of(windows);
}

/// Stores the motion of the things of an entry.
void add_motion(const FixedEntry& entry, Scene& scene, Diagnostics& diagnostics) {
  const vector<MotionLeg> legs = motion_of(entry.view, diagnostics);
  if (legs.empty()) return;
  scene.world.motions.resize(entry.first + entry.count);
  std::fill_n(scene.world.motions.begin() + entry.first, entry.count, legs);
}

}  // namespace

Vec3 default_up(const Vec3& unit_normal) {
  return is_parallel(Vec3::UnitY(), unit_normal) ? Vec3::UnitZ() : Vec3::UnitY();
}

Vec3 unit(const Vec3& v) {
  const Vec3 scaled = v / v.cwiseAbs().maxCoeff();
  return scaled / sqrt(scaled.x() * scaled.x() + scaled.y() * scaled.y() + scaled.z() * scaled.z());
}

void decode_fixed(const Inventory& inventory, Forms& forms, Scene& scene, Diagnostics& diagnostics) {
  for (const FixedEntry& entry : inventory.fixed) {
    const View& view = entry.view;
    const string_view kind = view.kind().name;
    const string& name = entry.key->text;
    if (kind != "room") add_motion(entry, scene, diagnostics);
    if (kind == "plane") add_plane(filled<PlaneKeys>(view), name, scene);
    if (kind == "room") add_room(view, name, scene, diagnostics);
    if (kind == "wall") add_wall(view, name, scene, diagnostics);
    if (kind == "obstacle") add_obstacle(view, name, forms, scene, diagnostics);
  }
  if (scene.world.moves()) scene.world.motions.resize(scene.world.fixed_count());
}

}  // namespace carom
