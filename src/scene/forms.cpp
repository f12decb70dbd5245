// Fits volumes to meshes. Each file is read once, and each fit of a file and a shape is computed once.
// A mesh either defines the volume (`fit`, at its own size) or is scaled to lie inside a given volume.
#include "scene/forms.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <fstream>

#include "scene/check.h"
#include "scene/fields.h"
#include "scene/member.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

constexpr string_view shape_names[] = {"sphere", "cylinder", "box"};

/// Whether a run may write a file of this name besides the copies of meshes.
bool is_taken(const string& name, const string& film) {
  return is_reserved(name) || name == VideoOutput{}.file || name == film;
}

/// Mesh files and their readers use floats: 0.381 in a file is read as 0.38100001215934753.
/// The shortest decimal with the same float is the number that was written.
/// With it, a body that is 0.381 m high stands on a floor 0.1905 m below its centre.
double as_written(double value) {
  const auto single = float(value);
  if (double(single) != value) return value;
  char text[32];
  const char* end = std::to_chars(text, text + sizeof text, single).ptr;
  double decimal = value;
  std::from_chars(text, end, decimal);
  return decimal;
}

optional<Volume> given_volume(const VolumeKeys& thing) {
  if (thing.radius) return Volume::sphere(*thing.radius);
  if (thing.box) return Volume::box(*thing.box);
  if (!thing.cylinder || !thing.cylinder->radius || !thing.cylinder->height) return nullopt;
  return Volume::cylinder(*thing.cylinder->radius, *thing.cylinder->height);
}

/// Whether a line of a Wavefront file names a file of materials.
bool names_materials(const std::filesystem::path& file) {
  std::ifstream in(file);
  string line;
  while (std::getline(in, line)) {
    const size_t start = line.find_first_not_of(" \t");
    if (start != string::npos && line.compare(start, 6, "mtllib") == 0) return true;
  }
  return false;
}

/// A .gltf, or an .obj with materials, refers to files beside it, which would have to be copied too.
bool has_further_files(const std::filesystem::path& file, bool own_colors) {
  string ending = file.extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? char(c + 32) : c;
  return ending == ".gltf" || (ending == ".obj" && own_colors && names_materials(file));
}

}  // namespace

optional<Form> Forms::of(const VolumeKeys& thing, bool colored) {
  optional<Form> form = plain(thing);
  if (!form || !form->mesh || colored) return form;
  form->mesh->own_colors = true;
  own_colors_.emplace(form->mesh->file, place_of(*given(*thing.mesh)->file));
  return form;
}

optional<Form> Forms::plain(const VolumeKeys& thing) {
  const Node* node = thing.mesh;
  const optional<Given> mesh = node == nullptr ? nullopt : given(*node);
  if (node != nullptr && !mesh) return nullopt;
  if (thing.fit) return mesh ? fitted(*thing.fit, *mesh) : nullopt;
  const optional<Volume> volume = given_volume(thing);
  if (!volume || !mesh) return volume ? optional(Form{*volume, nullopt}) : nullopt;
  return drawn(*volume, *mesh);
}

optional<Forms::Given> Forms::given(const Node& mesh) {
  if (mesh.bad) return nullopt;
  if (!mesh.is_map()) return Given{&mesh, 1, no_turn};
  const auto keys = filled<MeshKeys>(View(&mesh, kind_named("mesh"), mesh.place));
  if (keys.file == nullptr || keys.file->bad || !keys.up) return nullopt;
  return Given{keys.file, keys.scale, mesh_turn(*keys.up, keys.turn)};
}

/// The volume is the tightest one around the mesh. The mesh has its own size.
optional<Form> Forms::fitted(Shape shape, const Given& mesh) {
  const optional<Fit> tight = fit(shape, mesh);
  if (!tight) return nullopt;
  const Volume volume{shape, mesh.scale * tight->volume.half};
  if (!check_size(volume, mesh)) return nullopt;
  Form form = form_of(volume, mesh, *tight, mesh.scale);
  form.mesh->is_volume = true;
  return form;
}

/// The mesh is scaled so that its tightest volume of that shape lies in the given volume, with equal centres.
optional<Form> Forms::drawn(const Volume& volume, const Given& mesh) {
  const optional<Fit> tight = fit(volume.shape, mesh);
  if (!tight) return nullopt;
  return form_of(volume, mesh, *tight, (volume.half.array() / tight->volume.half.array()).minCoeff());
}

Form Forms::form_of(const Volume& volume, const Given& mesh, const Fit& tight, double scale) const {
  MeshUse use{path_of(*mesh.file), tight.center, scale};
  use.turn = mesh.turn;
  use.reach = volume.reach();
  return {volume, std::move(use)};
}

/// Whether a run computes with a volume of this size. A scale may make it too small or too large.
bool Forms::check_size(const Volume& volume, const Given& mesh) {
  const Range limits = limited_range(*find_field(kind_named("cylinder"), "radius"));
  for (const double size : {volume.half.minCoeff(), volume.half.maxCoeff()}) {
    if (contains(limits, size)) continue;
    diagnostics_.add(place_of(*mesh.file),
                     fmt::format("the mesh {} has a size of {} m", in_backticks(mesh.file->text), size),
                     limit_text(limits, "m"));
    return false;
  }
  return true;
}

optional<Fit> Forms::fit(Shape shape, const Given& mesh) {
  const vector<Vec3>* vertices = points(*mesh.file);
  if (vertices == nullptr) return nullopt;
  array<double, 9> turn;
  for (size_t k = 0; k < 9; ++k) turn[k] = mesh.turn[k / 3][ptrdiff_t(k % 3)];
  const auto key = std::tuple(path_of(*mesh.file), shape, turn);
  if (const auto known = fits_.find(key); known != fits_.end()) return known->second;

  vector<Vec3> own;
  if (mesh.turn != no_turn)
    for (const Vec3& vertex : *vertices) own.push_back(turned(mesh.turn, vertex));

  optional<Fit> tight;
  try {
    tight = tightest(shape, own.empty() ? *vertices : own);
  } catch (const std::invalid_argument&) {
    diagnostics_.add(place_of(*mesh.file),
                     fmt::format("the mesh {} is flat: its tightest {} has no volume", in_backticks(mesh.file->text),
                                 shape_names[size_t(shape)]),
                     "expected a mesh with width, height and depth");
  }

  return fits_.emplace(key, tight).first->second;
}

const vector<Vec3>* Forms::points(const Node& file) {
  const string path = path_of(file);
  const auto [entry, is_new] = points_.try_emplace(path);
  if (!is_new) return entry->second.empty() ? nullptr : &entry->second;
  order_.push_back(path);

  const auto refuse = [&](const string& what) {
    const TextRemedy parts = fault_and_remedy(what);
    diagnostics_.add(place_of(file),
                     fmt::format("the mesh {} cannot be used: {}", in_backticks(file.text), parts.fault),
                     parts.remedy.empty() ? "expected a file of triangles with finite vertices" : parts.remedy);
    return nullptr;
  };

  // Read the file.
  if (!options_.mesh_points) return refuse("there is no reader of meshes here");
  vector<Vec3> vertices;
  try {
    vertices = options_.mesh_points(path);
  } catch (const runtime_error& error) {
    return refuse(error.what());
  }

  if (vertices.empty()) return refuse("it has no vertices");
  if (!all_of(vertices, [](const Vec3& v) { return (v * 4).allFinite(); })) {
    return refuse("it has a vertex that is not finite");
  }

  for (Vec3& vertex : vertices) {
    for (int k = 0; k < 3; ++k) vertex[k] = as_written(vertex[k]);
  }
  entry->second = std::move(vertices);
  return &entry->second;
}

string Forms::path_of(const Node& file) const {
  return std::filesystem::path(beneath(folder_, file.text)).lexically_normal().string();
}

vector<MeshFile> Forms::files(const string& film) const {
  vector<MeshFile> out;
  set<string> used;
  for (const string& path : order_) {
    const std::filesystem::path name = std::filesystem::path(path).filename();
    const auto use = own_colors_.find(path);
    const optional<Place> uncolored = use == own_colors_.end() ? nullopt : optional(use->second);
    if (has_further_files(path, uncolored.has_value())) {
      out.push_back({path, "", uncolored});
      continue;
    }
    // The name must not be hidden, look like an option, contain a path of another system, or exceed the length limit.
    string stem = name.stem().string();
    if (stem.starts_with('.') || stem.starts_with('-') || stem.find('\\') != string::npos || stem.size() > 150) {
      stem = "mesh";
    }
    string copy = stem + name.extension().string();
    for (int i = 2; is_taken(copy, film) || used.contains(copy); ++i) {
      copy = fmt::format("{}-{}{}", stem, i, name.extension().string());
    }
    used.insert(copy);
    out.push_back({path, copy, uncolored});
  }
  return out;
}

}  // namespace carom
