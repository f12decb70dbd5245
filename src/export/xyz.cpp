// Writes extended XYZ with the species X for all bodies, because ASE accepts no names of bodies as species.
// The room, if there is one, becomes the cell, without periodic boundaries.
#include "export/xyz.h"

#include <fmt/format.h>

#include "export/bodies.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

constexpr size_t row_numbers = 16;  // maximum

/// The coordinate of a plane of the room. None: there is no room.
optional<double> room_side(const Scene& scene, string_view name, int axis) {
  for (size_t i = 0; i < scene.world.planes.size() && i < scene.roster.fixed.size(); ++i)
    if (scene.roster.fixed[i].name == name) return scene.world.planes[i].point[axis];
  return nullopt;
}

/// The cell is the room. Its walls are not periodic boundaries.
string cell_text(const Scene& scene) {
  string edges, corner;
  for (int axis = 0; axis < 3; ++axis) {
    const char letter = "xyz"[axis];
    const auto low = room_side(scene, fmt::format("room.{}_min", letter), axis);
    const auto high = room_side(scene, fmt::format("room.{}_max", letter), axis);
    if (!low || !high) return R"(pbc="F F F")";
    for (int k = 0; k < 3; ++k) edges += (edges.empty() ? "" : " ") + number_cell(k == axis ? *high - *low : 0);
    corner += (corner.empty() ? "" : " ") + number_cell(*low);
  }
  return fmt::format(R"(Lattice="{}" Origin="{}" pbc="F F F")", edges, corner);
}

char* put_vector(char* to, const Vec3& vector) {
  for (int axis = 0; axis < 3; ++axis) {
    *to++ = ' ';
    to = put_number(to, vector[axis]);
  }
  return to;
}

}  // namespace

// The species X is not a chemical element. ASE accepts no other such name.
// OVITO takes colours and sizes from the columns.
XyzWriter::XyzWriter(FolderWriter& folder, const Scene& scene)
    : scene_(scene), solids_(has_solids(scene.world)), file_(folder.place(), "trajectory.xyz") {
  cell_ = cell_text(scene) +
          " Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1:mass:R:1:color:R:3:id:I:1:molecule:I:1:name:S:1" +
          (solids_ ? ":aspherical_shape:R:3" : "");
  for (const BodyRange& range : scene.roster.bodies)
    colors_.push_back(
        fmt::format(" {} {} {}", number_cell(range.color.r), number_cell(range.color.g), number_cell(range.color.b)));
}

void XyzWriter::add(double time, const State& state, span<const ContactForce>) {
  const World& world = scene_.world;
  size_t count = world.body_count();
  for (Entity body = 0; body < world.body_count(); ++body) count -= is_gone(state, body) ? 1 : 0;
  file_.write(fmt::format("{}\n{} Time={}\n", count, cell_, number_cell(time)));

  for (size_t r = 0; r < scene_.roster.bodies.size(); ++r) {
    const BodyRange& range = scene_.roster.bodies[r];
    for (Entity body = range.first; body < range.first + range.count; ++body) {
      if (is_gone(state, body)) continue;

      const Volume volume = volume_now(world, state, body);
      char* to = file_.room(row_numbers * (number_size + 1) + range.name.size() + member_size + 4);
      *to++ = 'X';
      to = put_vector(put_vector(to, state.position[body]), state.velocity[body]);

      for (const double value : {volume.reach(), mass_now(world, state, body)}) {
        *to++ = ' ';
        to = put_number(to, value);
      }

      to = put_text(to, colors_[r]);
      for (const uint64_t value : {uint64_t{body}, uint64_t{r}}) {
        *to++ = ' ';
        to = put_number(to, value);
      }

      *to++ = ' ';
      to = put_member(to, range, body);
      if (solids_) to = put_vector(to, volume.half);
      *to++ = '\n';
      file_.written(to);
    }
  }
}

double XyzWriter::bytes(const Scene& scene, double instants) {
  // Typical values.
  constexpr double row_bytes = 170, comment_bytes = 200;
  return instants * (comment_bytes + row_bytes * scene.world.body_count());
}

}  // namespace carom
