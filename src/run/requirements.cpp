// Calls the functions that a run calls when it needs each thing, so that a run finds nothing missing later. The heads
// of textures alone would not show a damaged one.
#include "run/requirements.h"

#include "export/film_file.h"
#include "export/gnuplot.h"
#include "overlay/inscription.h"
#include "render/mesh.h"
#include "render/osmesa.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

/// The mesh files that pictures show in colours of their own.
set<string> painted_meshes(const Scene& scene) {
  set<string> files;
  const auto add = [&](const optional<MeshUse>& mesh) {
    if (mesh && mesh->own_colors) files.insert(mesh->file);
  };
  for (const BodyRange& range : scene.roster.bodies) add(range.mesh);
  for (const FixedLook& fixed : scene.roster.fixed)
    if (fixed.visible) add(fixed.mesh);
  return files;
}

bool has_mesh(const Scene& scene) {
  const auto has = [](const auto& thing) { return thing.mesh.has_value(); };
  return ranges::any_of(scene.roster.bodies, has) || ranges::any_of(scene.roster.fixed, has);
}

string fault_of(const function<void()>& find) {
  try {
    find();
  } catch (const runtime_error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

const string& Requirements::fault_of_colors(const string& mesh) {
  const auto known = faults_.find(mesh);
  if (known != faults_.end()) return known->second;
  return faults_[mesh] = fault_of([&] { read_painted_mesh(mesh); });
}

void Requirements::check(const SceneFile& file, const Scene& scene, const Output& outputs) {
  vector<SceneFault> faults;
  const auto add = [&](const optional<Place>& place, const string& text) {
    if (text.empty()) return;
    const TextRemedy parts = fault_and_remedy(text);
    faults.push_back({place, parts.fault, parts.remedy});
  };

  if (outputs.pictures() || outputs.gltf) {
    const set<string> painted = painted_meshes(scene);
    for (const MeshFile& mesh : scene.meshes)
      if (painted.contains(mesh.file)) add(mesh.uncolored, fault_of_colors(mesh.file));
  }
  if (outputs.pictures()) add({}, fault_of([&] { check_font(scene); }));
  if (outputs.pictures() && has_mesh(scene)) add({}, fault_of([] { find_osmesa(); }));
  if (outputs.video) add({}, fault_of([] { find_film_tools(); }));
  if (outputs.charts()) add({}, fault_of([] { find_gnuplot(); }));
  if (!faults.empty()) throw RequirementError(file.error(faults));
}

}  // namespace carom
