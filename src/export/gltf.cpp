// Collects positions as floats, which is what glTF stores, and the changes of volume of bodies that merge.
// The file needs all keyframes at once, so they stay in memory until the run's end.
#include "export/gltf.h"

#include "export/bodies.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

void GltfWriter::add(double time, const State& state, span<const ContactForce>) {
  const World& world = scene_.world;
  const size_t key = motion_.times.size();
  motion_.times.push_back(time);
  motion_.fired = state.fired;
  motion_.cameras.push_back(makers_.camera(state));

  for (Entity body = 0; body < world.body_count(); ++body) {
    const Vec3& p = state.position[body];
    motion_.position.push_back({float(p.x()), float(p.y()), float(p.z())});
    motion_.extent.include(p, volume_now(world, state, body).half);
  }

  // The volumes that have changed since the keyframe before.
  if (state.part_of.empty()) return;
  if (volumes_.empty())
    for (Entity body = 0; body < world.body_count(); ++body) volumes_.emplace_back(world.volume_of(body));

  for (Entity body = 0; body < world.body_count(); ++body) {
    optional<Volume> now;
    if (!is_gone(state, body)) now = volume_now(world, state, body);
    optional<Volume>& before = volumes_[body];
    if (now.has_value() == before.has_value() && (!now || now->half == before->half)) continue;
    motion_.changes.push_back({key, body, now});
    before = now;
  }
}

vector<OutputFile*> GltfWriter::files() {
  file_.write(makers_.glb(scene_, motion_));
  return {&file_};
}

double GltfWriter::bytes(const Scene& scene, double instants) {
  // Typical values. There is one mesh for each colour.
  constexpr double key_bytes = 12, body_bytes = 900, mesh_bytes = 40000;
  return scene.world.body_count() * (key_bytes * instants + body_bytes) +
         mesh_bytes * double(scene.roster.bodies.size() + 1);
}

}  // namespace carom
