// Decodes planes, rooms, walls and obstacles.
// A thing with an error still gets a number, so that the numbers of the others do not shift.
#include <cmath>

#include "physics/world.h"
#include "scene/colors.h"
#include "scene/decode.h"
#include "scene/scene.h"

namespace carom {
namespace {

constexpr std::string_view face_names[] = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};

std::optional<double> restitution_of(const View& view) {
  return view.number("restitution");
}

void add_plane(const View& view, const std::string& name, Scene& scene) {
  const std::optional<Vec3> point = view.vector("point"), normal = view.vector("normal");
  // A plane with errors keeps its number, so that messages about the others stay correct.
  scene.world.planes.push_back(
      {point.value_or(Vec3::Zero()), normal ? unit(*normal) : Vec3::UnitY(), restitution_of(view)});
  scene.roster.fixed.push_back(
      {name, view.color("color").value_or(*parse_color(plane_color)), view.flag("visible").value_or(true)});
}

void add_room(const View& view, const std::string& name, Scene& scene, Diagnostics& diagnostics) {
  const std::optional<Vec3> min = view.vector("min"), max = view.vector("max");
  for (int axis = 0; min && max && axis < 3; ++axis) {
    if ((*min)[axis] < (*max)[axis]) continue;
    const char letter = "xyz"[axis];
    diagnostics.add(view.place("max"), "the room's max." + std::string(1, letter) + " is not above its min." + letter,
                    "expected min below max on every axis");
  }
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    Vec3 normal = Vec3::Zero();
    normal[axis] = side % 2 == 0 ? 1 : -1;
    const std::optional<Vec3>& corner = side % 2 == 0 ? min : max;
    scene.world.planes.push_back({corner.value_or(Vec3::Zero()), normal, restitution_of(view)});
    scene.roster.fixed.push_back({name + "." + std::string(face_names[side]),
                                  view.color("color").value_or(*parse_color(room_color)),
                                  view.flag("visible").value_or(true)});
  }
}

/// Whether `unit_up` is so nearly parallel to the normal that it does not define the direction of the height.
bool is_parallel(const Vec3& unit_up, const Vec3& unit_normal) {
  return unit_up.cross(unit_normal).norm() <= 1e-9;
}

void add_wall(const View& view, const std::string& name, Scene& scene, Diagnostics& diagnostics) {
  const Vec3 center = view.vector("center").value_or(Vec3::Zero());
  const Vec3 normal = unit(view.vector("normal").value_or(Vec3::UnitZ()));
  Vec3 up = unit(view.vector("up").value_or(default_up(normal)));
  if (is_parallel(up, normal)) {
    diagnostics.add(view.place("up"), "up is parallel to the normal", "expected a direction along the wall");
    up = std::fabs(normal.x()) < 0.5 ? Vec3::UnitX() : Vec3::UnitY();
  }
  up = unit(up - normal * up.dot(normal));
  // right x up = normal.
  const Vec3 right = unit(up.cross(normal));

  double half_width = 0.5, half_height = 0.5;
  if (const Node* size = view.find("size"); size != nullptr && !size->bad && size->items.size() == 2) {
    half_width = as_number(&size->items[0]).value_or(1) / 2;
    half_height = as_number(&size->items[1]).value_or(1) / 2;
  }
  scene.world.walls.push_back({center, normal, right, up, half_width, half_height, restitution_of(view)});
  scene.roster.fixed.push_back(
      {name, view.color("color").value_or(*parse_color(wall_color)), view.flag("visible").value_or(true)});
}

void add_obstacle(const View& view, const std::string& name, Forms& forms, Scene& scene) {
  // An obstacle with errors keeps its number, as planes do. Its volume is then empty.
  const std::optional<Form> form = forms.of(view);
  scene.world.obstacles.push_back(
      {view.vector("position").value_or(Vec3::Zero()), form ? form->volume : Volume{}, restitution_of(view)});
  scene.roster.fixed.push_back({name, view.color("color").value_or(*parse_color(obstacle_color)),
                                view.flag("visible").value_or(true), form ? form->mesh : std::nullopt});
}

}  // namespace

Vec3 default_up(const Vec3& unit_normal) {
  return is_parallel(Vec3::UnitY(), unit_normal) ? Vec3::UnitZ() : Vec3::UnitY();
}

Vec3 unit(const Vec3& v) {
  const Vec3 scaled = v / v.cwiseAbs().maxCoeff();
  return scaled / std::sqrt(scaled.x() * scaled.x() + scaled.y() * scaled.y() + scaled.z() * scaled.z());
}

void decode_fixed(const Node& root, const Inventory& inventory, Forms& forms, Scene& scene, Diagnostics& diagnostics) {
  for (const FixedEntry& entry : inventory.fixed) {
    const View view = fixed_view(root, entry);
    const std::string& name = entry.key->text;
    if (entry.kind->name == "plane") add_plane(view, name, scene);
    if (entry.kind->name == "room") add_room(view, name, scene, diagnostics);
    if (entry.kind->name == "wall") add_wall(view, name, scene, diagnostics);
    if (entry.kind->name == "obstacle") add_obstacle(view, name, forms, scene);
  }
}

}  // namespace carom
