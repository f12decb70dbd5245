// Hollow things fall into parts without thickness, each of which is an obstacle with a number of its own. The flat ones
// are cylinders without height and boxes without width.
#include "scene/hollow.h"

#include <fmt/format.h>

#include "numerics/cube_root.h"
#include "scene/member.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

constexpr string_view face_names[] = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};

bool opens(Opening open, Opening side) {
  return open == side || open == Opening::both;
}

/// The flat part whose middle is so far from the centre along an axis (m).
HollowPart flat_part(string_view name, const ObstacleKeys& keys, Volume volume, int axis, int side) {
  const Vec3 off = side * volume.half[axis] * Vec3::Unit(axis);
  volume.half[axis] = 0;
  return {name, {keys.position + off, volume, keys.restitution}, -side * Vec3::Unit(axis)};
}

vector<HollowPart> tube(const ObstacleKeys& keys, const Volume& volume, Opening open) {
  vector<HollowPart> parts{{"side", {keys.position, volume, keys.restitution, Hollow::side}}};
  if (!opens(open, Opening::bottom)) parts.push_back(flat_part("bottom", keys, volume, 1, -1));
  if (!opens(open, Opening::top)) parts.push_back(flat_part("top", keys, volume, 1, 1));
  return parts;
}

vector<HollowPart> hollow_box(const ObstacleKeys& keys, const Volume& volume, Opening open) {
  vector<HollowPart> parts;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2, side = face % 2 == 0 ? -1 : 1;
    const bool is_open = axis == 1 && opens(open, side < 0 ? Opening::bottom : Opening::top);
    if (!is_open) parts.push_back(flat_part(face_names[face], keys, volume, axis, side));
  }
  return parts;
}

vector<HollowPart> hollow_sphere(const ObstacleKeys& keys, const Volume& volume, Opening open) {
  const Hollow hollow = open == Opening::none  ? Hollow::whole
                        : open == Opening::top ? Hollow::lower_half
                                               : Hollow::upper_half;
  return {{"", {keys.position, volume, keys.restitution, hollow}}};
}

string_view word_for(Shape shape) {
  return shape == Shape::box ? "a box" : "a cylinder";
}

/// The first body that is no ball. None: there is none.
optional<Entity> first_without_ball(const World& world) {
  for (Entity i = 0; i < world.volume.size(); ++i)
    if (world.volume[i].shape != Shape::sphere) return i;
  return nullopt;
}

}  // namespace

vector<string_view> part_names(const View& thing) {
  if (thing.kind().name == "room") return {std::begin(face_names), std::end(face_names)};
  if (thing.kind().name != "obstacle" || !thing.flag("inside").value_or(false)) return {};

  // Their sizes do not matter.
  const auto keys = filled<ObstacleKeys>(thing);
  vector<string_view> names;
  for (const HollowPart& part : parts_of_obstacle(keys, Volume{keys.box        ? Shape::box
                                                               : keys.cylinder ? Shape::cylinder
                                                                               : Shape::sphere}))
    if (!part.name.empty()) names.push_back(part.name);
  return names;
}

vector<HollowPart> parts_of_obstacle(const ObstacleKeys& keys, const Volume& volume) {
  const Opening open = keys.open.value_or(Opening::none);
  if (!keys.inside) return {{"", {keys.position, volume, keys.restitution}}};
  switch (volume.shape) {
    case Shape::sphere:
      break;
    case Shape::cylinder:
      return tube(keys, volume, open);
    case Shape::box:
      return hollow_box(keys, volume, open);
  }
  return hollow_sphere(keys, volume, open);
}

void check_hollow_keys(const View& view, const string& name, Diagnostics& diagnostics) {
  const auto keys = filled<ObstacleKeys>(view);
  const string open = view.text("open").value_or("");
  if (!keys.inside) {
    if (keys.open.value_or(Opening::none) != Opening::none)
      diagnostics.add(view.place("open"), fmt::format("{} has an opening and is solid", in_backticks(name)),
                      "expected `inside: true` beside `open`, or no `open`");
    return;
  }

  if (keys.mesh != nullptr)
    diagnostics.add(view.place("mesh"), fmt::format("{} is hollow, and a mesh is not", in_backticks(name)),
                    "expected `radius`, `cylinder` or `box` alone beside `inside: true`");
  if (keys.open == Opening::both && keys.radius)
    diagnostics.add(view.place("open"), fmt::format("a sphere is open at the top or at the bottom, not at {}", open),
                    "expected `open: top`, its lower half, `open: bottom`, its upper half, or a `cylinder`");
}

void check_hollows(const Inventory& inventory, const Scene& scene, Diagnostics& diagnostics) {
  const World& world = scene.world;
  const optional<Entity> no_ball = first_without_ball(world);

  // All that may merge into one ball.
  double joint = 0;  // m^3 without the factor
  if (scene.simulate.contact.merge)
    for (const double r : world.radius) joint += r * r * r;

  for (const FixedEntry& entry : inventory.fixed) {
    // The shell is the first part.
    const Entity e = inventory.body_count + entry.first;
    if (!world.is_shell(e)) continue;
    const string name = in_backticks(entry.key->text);
    const double radius = world.obstacle(e).volume.half.x();

    if (no_ball) {
      diagnostics.add(entry.view.place("inside"),
                      fmt::format("{} is round and hollow, which only balls can meet, and {} is {}", name,
                                  in_backticks(scene.roster.name(*no_ball)), word_for(world.volume[*no_ball].shape)),
                      "expected balls alone, or a hollow `box`, which all bodies can meet");
      continue;
    }

    if (entry.view.text("open").value_or("none") != "none") {
      const auto widest = ranges::max_element(world.radius);
      if (widest != world.radius.end() && *widest >= radius)
        diagnostics.add(entry.view.place("open"),
                        fmt::format("{}, of radius {} m, is too wide for the opening of {}, of radius {} m",
                                    in_backticks(scene.roster.name(Entity(widest - world.radius.begin()))),
                                    shortest(*widest), name, shortest(radius)),
                        "a ball cannot lie on a rim all around: expected narrower balls, or `open: none`");
    }

    if (joint >= radius * radius * radius)
      diagnostics.add(entry.view.place("inside"),
                      fmt::format("balls may merge into one of radius {:.6g} m, and {} has a radius of {} m",
                                  cube_root(joint), name, shortest(radius)),
                      "expected `contact: bounce`, or a wider one");
  }
}

}  // namespace carom
