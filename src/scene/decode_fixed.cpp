// Decodes planes, rooms, walls and obstacles.
// A thing with an error still gets a number, so that the numbers of the others do not shift.
// Its keys without a good value keep their defaults.
#include <fmt/format.h>

#include "physics/world.h"
#include "scene/decode.h"
#include "scene/events.h"
#include "scene/fields.h"
#include "scene/hollow.h"
#include "scene/member.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

/// What pictures show of a thing. `rgb`: its colour in the look.
FixedLook look_of(const string& name, const FixedKeys& keys, uint32_t rgb) {
  return {.name = name,
          .color = keys.color.value_or(from_rgb(rgb)),
          .visible = keys.visible,
          .surface = {keys.finish, keys.opacity}};
}

void add_plane(const PlaneKeys& plane, const string& name, Scene& scene) {
  scene.world.planes.push_back({plane.point, unit(plane.normal), plane.restitution});
  scene.roster.fixed.push_back(look_of(name, plane, style_of(scene.look).plane));
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
    FixedLook look = look_of(part_of(name, names[size_t(side)]), room, style_of(scene.look).room);
    if (!look.surface.finish) look.surface.finish = normal.y() > 0 ? Finish::matte : Finish::glass;
    scene.roster.fixed.push_back(look);
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
  scene.roster.fixed.push_back(look_of(name, wall, style_of(scene.look).wall));
}

void add_obstacle(const View& view, const string& name, Forms& forms, Scene& scene, Diagnostics& diagnostics) {
  const auto obstacle = filled<ObstacleKeys>(view);
  // The volume of an obstacle with errors is empty.
  const Form form = forms.of(obstacle, view.find("color") != nullptr).value_or(Form{});
  check_hollow_keys(view, name, diagnostics);
  for (const HollowPart& part : parts_of_obstacle(obstacle, form.volume)) {
    scene.world.obstacles.push_back(part.obstacle);
    FixedLook look = look_of(part_of(name, part.name), obstacle, style_of(scene.look).obstacle);
    look.mesh = form.mesh;
    look.inward = part.inward;
    scene.roster.fixed.push_back(look);
  }
}

/// The windows of a motion, with the ends that events set.
struct Windows {
  vector<MotionWindow> all;
  vector<pair<WindowEnd, WindowEnd>> ends;
  double known_until = 0;  // s, the end of the last one that no event sets

  bool wait() const {
    return any_of(ends, [](const auto& of) { return of.first.trigger || of.second.trigger; });
  }
};

/// Adds a window that stands in the file after those of before. `every`: s, after which they repeat.
void add_window(const View& view, double every, Windows& windows, EventDecoder& events, Diagnostics& diagnostics) {
  const auto [given_from, given_until, velocity] = filled<WindowKeys>(view);
  const bool ends = view.given("until") != nullptr;
  const WindowEnd from = events.end(view, "from", given_from);
  const WindowEnd until = events.end(view, "until", given_until.value_or(every));
  const bool is_known = from.time < not_yet && until.time != not_yet;

  if (!is_known && every < infinity)
    diagnostics.add(view.where(), "the windows repeat, but an event happens once", "leave out `every`");

  // A window has a length, lies within a period, and starts after the one before.
  if (!events.check(view, from, until, ends ? "until" : "every")) return;
  if (until.time > every && is_known)
    diagnostics.add(view.place("until"),
                    fmt::format("this window ends at {} s, but the windows repeat every {} s", shortest(until.time),
                                shortest(every)),
                    "expected windows from 0 to `every`");

  if (is_known && from.time < windows.known_until) {
    const double end = windows.known_until;
    diagnostics.add(view.place("from"),
                    fmt::format("this window starts at {} s, but the one before it {}", shortest(from.time),
                                std::isinf(end) ? "never ends" : fmt::format("ends at {} s", shortest(end))),
                    "expected windows in order that do not overlap, each with `until` except the last");
  }

  if (is_known) windows.known_until = until.time;
  if (!velocity) return;
  windows.all.push_back({from.time, until.time, *velocity});
  windows.ends.emplace_back(from, until);
}

/// The windows that repeat after `every` (s).
Windows windows_of(const View& motion, double every, EventDecoder& events, Diagnostics& diagnostics) {
  Windows windows;
  const Node* const list = motion.find("windows");
  if (list == nullptr || !list->is_sequence()) return windows;
  for (const Node& node : list->items)
    if (node.is_map()) add_window(View(&node, kind_named("window"), node.place), every, windows, events, diagnostics);
  return windows;
}

/// The motion on a circle from a place (m) on.
SurfaceMotion on_circle(const View& motion, const CircleKeys& keys, const Vec3& place, Diagnostics& diagnostics) {
  const auto [center, axis, period] = keys;
  if (motion.part("circle").vector("axis").value_or(Vec3::Zero()).isZero(0)) return {};
  SurfaceMotion circle = motion_on_circle(place, center, unit(axis), period);
  // What is left beside the axis by rounding is no circle.
  const double rounding = 0x1p-50 * (place.cwiseAbs().sum() + center.cwiseAbs().sum());
  if (circle.swing && circle.swing->cosine.norm() > rounding) return circle;
  diagnostics.add(motion.place("circle"), "the axis goes through this thing's place, so that it would not move",
                  "expected another `center` or `axis`, or no `motion`");
  return {};
}

/// Lets the things of an entry move, all alike. `place`: m, that of the entry in the file. `places`: m, those of the
/// things, which become those at time 0.
void add_motion(const FixedEntry& entry, const Vec3& place, span<Vec3* const> places, const Inventory& inventory,
                Scene& scene, Diagnostics& diagnostics) {
  const Node* const given = entry.view.find("motion");
  if (given == nullptr || !given->is_map()) return;
  const View view(given, kind_named("motion"), given->place);
  const auto keys = filled<MotionKeys>(view);

  // In one of the three ways.
  SurfaceMotion motion;
  if (keys.sine) {
    motion = motion_on_sine(keys.sine->amplitude, keys.sine->period, keys.sine->phase);
    for (Vec3* const each : places)
      if (motion.swing) *each -= motion.swing->middle;
  } else if (keys.circle) {
    motion = on_circle(view, *keys.circle, place, diagnostics);

  } else {
    const double every = keys.every.value_or(infinity);
    EventDecoder events(inventory, scene, diagnostics);
    const Windows windows = windows_of(view, every, events, diagnostics);
    motion = windows.wait() ? motion_by_events(windows.all) : motion_in_windows(windows.all, every);
    for (Entity k = entry.first; k < entry.first + entry.count; ++k)
      for (size_t w = 0; w < windows.ends.size(); ++w)
        events.wait(TriggeredEnd::Of::motion, k, windows.ends[w].first, windows.ends[w].second, w);
  }

  if (!motion.moves()) return;
  scene.world.motions.resize(entry.first + entry.count);
  std::fill_n(scene.world.motions.begin() + entry.first, entry.count, motion);
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
    World& world = scene.world;
    if (kind == "plane") add_plane(filled<PlaneKeys>(view), name, scene);
    if (kind == "room") add_room(view, name, scene, diagnostics);
    if (kind == "wall") add_wall(view, name, scene, diagnostics);
    if (kind == "obstacle") add_obstacle(view, name, forms, scene, diagnostics);
    if (kind == "room") continue;

    // What may move.
    vector<Vec3*> places;
    if (kind == "plane") places = {&world.planes.back().point};
    if (kind == "wall") places = {&world.walls.back().center};
    for (size_t k = world.obstacles.size() - (kind == "obstacle" ? entry.count : 0); k < world.obstacles.size(); ++k)
      places.push_back(&world.obstacles[k].center);
    const Vec3 place = kind == "obstacle" ? filled<ObstacleKeys>(view).position : *places.front();
    add_motion(entry, place, places, inventory, scene, diagnostics);
  }
  if (scene.world.moves()) scene.world.motions.resize(scene.world.fixed_count());
}

}  // namespace carom
