// Writes VTK's XML with arrays in base64: a count of bytes, then the numbers, little-endian.
// Text numbers would be larger and slower, and appended raw data would not be valid XML.
#include "export/vtk.h"

#include <fmt/format.h>
#include <nettle/base64.h>

#include <bit>
#include <cstring>

#include "export/bodies.h"
#include "physics/world.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say LittleEndian");

constexpr string_view head = "<?xml version=\"1.0\"?>\n";

/// Numbers in VTK's base64 form: the number of bytes, then the bytes.
class Bytes {
 public:
  template <typename Number>
  void add(Number value) {
    const size_t at = bytes_.size();
    bytes_.resize(at + sizeof value);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }
  void add(const Vec3& v) {
    for (int axis = 0; axis < 3; ++axis) add(v[axis] == 0 ? 0.0 : v[axis]);
  }
  void add(const Color& color) {
    for (const double part : {color.r, color.g, color.b}) add(uint8_t(std::lround(part * 255)));
  }
  void add_text(string_view text) {
    bytes_ += text;
    bytes_ += '\0';
  }
  string base64() {
    const uint64_t size = bytes_.size() - sizeof(uint64_t);
    std::memcpy(bytes_.data(), &size, sizeof size);
    string text(BASE64_ENCODE_RAW_LENGTH(bytes_.size()), ' ');
    base64_encode_raw(text.data(), bytes_.size(), reinterpret_cast<const uint8_t*>(bytes_.data()));
    return text;
  }

 private:
  string bytes_ = string(sizeof(uint64_t), '\0');
};

/// <DataArray ...>...</DataArray>
string data_array(string_view type, string_view name, int components, Bytes& bytes) {
  return fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}</DataArray>\n",
                     type, name, components, bytes.base64());
}

string begin(string_view type) {
  return fmt::format("{}<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n",
                     head, type);
}

/// A file of points, with either vertices or triangles.
string poly_data(const string& field, size_t points, const string& point_data, const string& coordinates,
                 string_view cells, size_t cell_count, int corners, Bytes& connectivity, const string& cell_data) {
  Bytes offsets;
  for (size_t i = 1; i <= cell_count; ++i) offsets.add(int32_t(i * size_t(corners)));
  return begin("PolyData") + "<PolyData>\n" + field +
         fmt::format("<Piece NumberOfPoints=\"{}\" NumberOf{}=\"{}\">\n", points, cells, cell_count) + point_data +
         "<Points>\n" + coordinates + "</Points>\n" + fmt::format("<{}>\n", cells) +
         data_array("Int32", "connectivity", 1, connectivity) + data_array("Int32", "offsets", 1, offsets) +
         fmt::format("</{}>\n", cells) + cell_data + "</Piece>\n</PolyData>\n</VTKFile>\n";
}

string bodies_text(const Scene& scene, double time, const State& state, bool solids) {
  const World& world = scene.world;
  Bytes instant, position, velocity, radius, mass, id, color, name, shape, size, vertices;
  instant.add(time);

  int32_t points = 0;
  for (const BodyRange& range : scene.roster.bodies) {
    for (Entity body = range.first; body < range.first + range.count; ++body) {
      if (is_gone(state, body)) continue;

      const Volume volume = volume_now(world, state, body);
      position.add(state.position[body]);
      velocity.add(state.velocity[body]);
      radius.add(volume.reach());
      mass.add(mass_now(world, state, body));
      id.add(int32_t(body));
      color.add(range.color);
      name.add_text(range.group ? fmt::format("{}.{}", range.name, body - range.first) : range.name);

      if (solids) {
        shape.add(uint8_t(volume.shape));
        size.add(Vec3(2 * volume.half));
      }
      vertices.add(points++);
    }
  }

  string data = "<PointData Scalars=\"radius\" Vectors=\"velocity\">\n" +
                data_array("Float64", "velocity", 3, velocity) + data_array("Float64", "radius", 1, radius) +
                data_array("Float64", "mass", 1, mass) + data_array("Int32", "id", 1, id) +
                data_array("UInt8", "color", 3, color) + data_array("String", "name", 1, name);
  if (solids) data += data_array("UInt8", "shape", 1, shape) + data_array("Float64", "size", 3, size);
  data += "</PointData>\n";

  const string field =
      "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"binary\">" +
      instant.base64() + "</DataArray>\n</FieldData>\n";
  return poly_data(field, size_t(points), data, data_array("Float64", "position", 3, position), "Verts", size_t(points),
                   1, vertices, "");
}

string surfaces_text(const vector<StillThing>& things) {
  Bytes position, normal, id, color, name, corners;
  int32_t points = 0, number_of_thing = 0;
  size_t triangles = 0;

  for (const StillThing& thing : things) {
    for (const Vec3& vertex : thing.mesh.vertices) position.add(vertex);
    for (const Vec3& n : thing.mesh.normals) normal.add(n);
    for (const uint32_t corner : thing.mesh.triangles) corners.add(points + int32_t(corner));

    // Cells have values of their own.
    for (size_t i = 0; i < thing.mesh.triangles.size(); i += 3) {
      id.add(number_of_thing);
      color.add(thing.color);
      name.add_text(thing.name);
      ++triangles;
    }

    points += int32_t(thing.mesh.vertices.size());
    ++number_of_thing;
  }

  return poly_data("", size_t(points),
                   "<PointData Normals=\"normal\">\n" + data_array("Float64", "normal", 3, normal) + "</PointData>\n",
                   data_array("Float64", "position", 3, position), "Polys", triangles, 3, corners,
                   "<CellData>\n" + data_array("Int32", "id", 1, id) + data_array("UInt8", "color", 3, color) +
                       data_array("String", "name", 1, name) + "</CellData>\n");
}

}  // namespace

VtkWriter::VtkWriter(FolderWriter& folder, const Scene& scene, const ModelMakers& makers)
    : scene_(scene),
      makers_(makers),
      solids_(has_solids(scene.world)),
      bodies_(folder, vtk_files),
      collection_(folder.place(), "trajectory.pvd"),
      surfaces_(folder.place(), "surfaces.vtp") {
  collection_.write(begin("Collection"));
  collection_.write("<Collection>\n");
}

void VtkWriter::add(double time, const State& state, span<const ContactForce>) {
  for (Entity body = 0; body < scene_.world.body_count(); ++body)
    extent_.include(state.position[body], volume_now(scene_.world, state, body).half);
  const string file = bodies_.put(instants_++, bodies_text(scene_, time, state, solids_));
  collection_.write(fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", number_cell(time), file));
}

vector<OutputFile*> VtkWriter::files() {
  collection_.write("</Collection>\n</VTKFile>\n");
  surfaces_.write(surfaces_text(makers_.still_things(scene_, extent_)));
  return {&collection_, &surfaces_};
}

double VtkWriter::bytes(const Scene& scene, double instants) {
  // Typical values.
  constexpr double body_bytes = 118, solid_bytes = 33, file_bytes = 2000, surface_bytes = 3000;
  const double row_bytes = body_bytes + (has_solids(scene.world) ? solid_bytes : 0);
  return instants * (file_bytes + row_bytes * scene.world.body_count()) + surface_bytes * scene.world.fixed_count();
}

}  // namespace carom
