// Names of a group's members are composed on request. Stored names would cost memory for every body of a group.

#include "scene/caption.h"
#include "scene/engines.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {

string_view family_of(string_view name) {
  const size_t dot = name.rfind('.');
  return dot != string_view::npos && parse_index(name.substr(dot + 1)) ? name.substr(0, dot) : string_view();
}

string_view BodyRange::thing() const {
  const string_view family = family_of(name);
  return family.empty() ? string_view(name) : family;
}

const BodyRange& Roster::range_of(Entity body) const {
  // Find the last range that begins at or before this body.
  // Empty groups begin where the next range does, and come before it.
  const auto after = std::upper_bound(bodies.begin(), bodies.end(), body,
                                      [](Entity e, const BodyRange& range) { return e < range.first; });
  return *(after - 1);
}

string Roster::name(Entity e) const {
  if (!bodies.empty() && e < bodies.back().first + bodies.back().count) {
    const BodyRange& range = range_of(e);
    return range.group ? range.name + "." + to_string(e - range.first) : range.name;
  }
  const Entity body_count = bodies.empty() ? 0 : bodies.back().first + bodies.back().count;
  const size_t after_bodies = e - body_count;
  return after_bodies < fixed.size() ? fixed[after_bodies].name : strings.at(after_bodies - fixed.size());
}

bool may_stop(const Scene& scene) {
  const vector<WorldRegion>& regions = scene.world.regions;
  return scene.simulate.stop_at_rest || scene.simulate.stop_collisions ||
         any_of(regions, [](const WorldRegion& region) { return region.stops; });
}

bool colors_by_collisions(const Scene& scene) {
  const vector<BodyRange>& bodies = scene.roster.bodies;
  return any_of(
      bodies, [](const BodyRange& range) { return range.coloring && range.coloring->by == ColorQuantity::collisions; });
}

bool drawings_show_collisions(const Scene& scene) {
  const Overlay& overlay = scene.overlay;
  const bool sampled_trails = overlay.trails && !goes_along_parabolas(scene.world, scene.simulate);
  return frames_motion(scene) || overlay.flash || sampled_trails || slows_down(scene) || sounds(scene) ||
         colors_by_collisions(scene) || has_name(overlay.caption, "collisions") ||
         ((scene.output.charts() || scene.requested.charts()) && may_stop(scene));
}

}  // namespace carom
