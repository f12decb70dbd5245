// In text, things with equal volumes share one entry, and a group has one entry. JSON has an entry for each name.
#include "commands/volumes_report.h"

#include <fmt/format.h>

#include <filesystem>
#include <unordered_map>

#include "commands/text.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/joined.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

constexpr size_t kinds_shown = 10, names_shown = 3;

string volume_text(const Volume& volume) {
  switch (volume.shape) {
    case Shape::sphere:
      return fmt::format("a sphere of radius {}", quantity(volume.half.x(), "m"));
    case Shape::cylinder:
      return fmt::format("a cylinder of radius {} and height {}", quantity(volume.half.x(), "m"),
                         quantity(2 * volume.half.y(), "m"));
    case Shape::box:
      break;
  }
  return fmt::format("a box of {:.4g} x {:.4g} x {}", 2 * volume.half.x(), 2 * volume.half.y(),
                     quantity(2 * volume.half.z(), "m"));
}

Json volume_json(const Volume& volume) {
  switch (volume.shape) {
    case Shape::sphere:
      return {{"radius", volume.half.x()}};
    case Shape::cylinder:
      return {{"cylinder", {{"radius", volume.half.x()}, {"height", 2 * volume.half.y()}}}};
    case Shape::box:
      break;
  }
  return {{"box", {2 * volume.half.x(), 2 * volume.half.y(), 2 * volume.half.z()}}};
}

/// The least and the greatest radius of a ball, a body or a group's balls (m).
pair<double, double> radii_of(const World& world, const BodyRange& range) {
  const auto [least, greatest] = ranges::minmax(span(world.radius).subspan(range.first, range.count));
  return {least, greatest};
}

}  // namespace

string volumes_text(const Scene& scene) {
  struct Alike {
    string text;
    vector<string> names;
  };

  vector<Alike> all;
  std::unordered_map<string, size_t> numbers;  // in `all`, by text
  const World& world = scene.world;

  const auto add = [&](const string& volume, const string& name, const optional<MeshUse>& mesh) {
    string text = volume;
    if (mesh) text += fmt::format(", drawn as {}", printable(std::filesystem::path(mesh->file).filename().string()));
    const auto [found, fresh] = numbers.emplace(text, all.size());
    if (fresh) all.push_back({text, {}});
    vector<string>& names = all[found->second].names;
    // All members of a repeated thing are named once.
    const string_view family = family_of(name), thing = family.empty() ? string_view(name) : family;
    if (names.empty() || names.back() != thing) names.emplace_back(thing);
  };

  for (const BodyRange& range : scene.roster.bodies) {
    if (range.count == 0) continue;
    const bool ball = world.volume_of(range.first).shape == Shape::sphere;
    const auto [least, greatest] = radii_of(world, range);
    const string text = least == greatest
                            ? volume_text(world.volume_of(range.first))
                            : fmt::format("spheres of radius {:.4g} to {}", least, quantity(greatest, "m"));
    if (!ball || range.mesh) add(text, range.name, range.mesh);
  }
  for (auto i = Entity(world.planes.size() + world.walls.size()); i < world.fixed_count(); ++i) {
    const FixedLook& fixed = scene.roster.fixed[i];
    add(volume_text(world.volume_of(world.body_count() + i)), fixed.name, fixed.mesh);
  }

  vector<string> texts;
  for (const Alike& alike : all) {
    if (texts.size() == kinds_shown) break;
    texts.push_back(
        fmt::format("{} {}{}", listed(alike.names, names_shown), alike.names.size() > 1 ? "each " : "", alike.text));
  }
  const string text = joined(texts, "; ");
  return all.size() > texts.size() ? text + fmt::format("; and {} more kinds", grouped(all.size() - texts.size()))
                                   : text;
}

Json volumes_json(const Scene& scene) {
  Json volumes = Json::object();
  const World& world = scene.world;
  for (const BodyRange& range : scene.roster.bodies) {
    if (range.count == 0) continue;
    const auto [least, greatest] = radii_of(world, range);
    volumes[range.name] = least == greatest ? volume_json(world.volume_of(range.first))
                                            : Json{{"radius", {{"from", least}, {"to", greatest}}}};
  }

  const auto first = Entity(world.planes.size() + world.walls.size());
  for (Entity i = first; i < world.fixed_count(); ++i) {
    volumes[scene.roster.fixed[i].name] = volume_json(world.volume_of(world.body_count() + i));
  }
  return volumes;
}

}  // namespace carom
