// Decodes what pictures show besides the bodies. Colours by a quantity are checked here, after all bodies, because the
// ends of a scale may follow from these.
#include <fmt/format.h>

#include "physics/world.h"
#include "scene/caption.h"
#include "scene/color_scale.h"
#include "scene/decode.h"
#include "scene/fields.h"
#include "scene/film_layout.h"
#include "scene/label_size.h"
#include "scene/member.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

/// A wider trail would cover the picture, and floats would not resolve its edge.
constexpr double widest_trail = 1000;  // largest radii

void check_width(const View& part, optional<double> width, const World& world, Diagnostics& diagnostics) {
  if (!width || world.radius.empty()) return;
  const double largest = *ranges::max_element(world.radius);
  if (*width <= widest_trail * largest) return;
  diagnostics.add(part.place("width"),
                  fmt::format("trails of {} m are more than {:g} times as wide as the largest radius, {} m",
                              shortest(*width), widest_trail, shortest(largest)),
                  "expected less: such a trail covers the picture");
}

optional<Trails> decode_trails(const View& whole, const Inventory& inventory, const World& world,
                               Diagnostics& diagnostics) {
  if (!whole.wants("trails")) return nullopt;
  const View part = whole.part("trails");
  const auto keys = filled<TrailKeys>(part);
  check_width(part, keys.width, world, diagnostics);
  optional<vector<Entity>> on = find_bodies(keys.on, inventory, "it has no trail", diagnostics);
  if (!on) return nullopt;
  return Trails{keys.seconds, keys.width, std::move(*on)};
}

bool lists(const Node* names, string_view name) {
  return names != nullptr && !names->bad && any_of(names->items, [&](const Node& item) { return item.text == name; });
}

optional<Labels> decode_labels(const View& whole, const Inventory& inventory, const Scene& scene,
                               Diagnostics& diagnostics) {
  if (!whole.wants("labels")) return nullopt;
  const View part = whole.part("labels");
  const auto keys = filled<LabelKeys>(part);
  optional<vector<Entity>> on = find_bodies(keys.on, inventory, "it has no label", diagnostics);
  if (!on) return nullopt;
  Labels labels{lists(keys.show, "name"), lists(keys.show, "speed"), lists(keys.show, "momentum"), std::move(*on)};

  const size_t bodies = labels.on.empty() ? inventory.body_count : labels.on.size();
  const Output& out = scene.output;
  const Size size = out.frames ? out.frames->size : out.video ? layout_of(*out.video).picture : Size{};
  const size_t most = most_labels(size, labels.count());
  if (bodies > most)
    diagnostics.add(
        keys.on != nullptr ? part.place("on") : whole.place("labels"),
        fmt::format("labels of {} bodies do not fit into a picture of {} x {} pixels", bodies, size.width, size.height),
        fmt::format("expected at most {} bodies, such as `labels: {{show: [speed], on: [{}]}}`", most,
                    scene.roster.bodies.empty() ? "red" : scene.roster.name(0)));
  return labels;
}

void check_coloring(const View& body, const Coloring& coloring, const Scene& scene, Diagnostics& diagnostics) {
  if (!coloring.by || !(coloring.min || coloring.max)) return;
  const View view = body.part("color");
  const char* const key = coloring.max ? "max" : "min";

  if (coloring.by == ColorQuantity::group) {
    diagnostics.add(view.place(key), fmt::format("`{}` has no meaning for groups", key),
                    "remove it: each ball, body or group has a colour of its own");
    return;
  }

  // The ends of the scale, of which one may come from the scene.
  const ColorScale scale = scale_of(scene, coloring);
  if (scale.min < scale.max) return;

  const bool both = coloring.min && coloring.max;
  diagnostics.add(
      view.place(key),
      fmt::format("the scale of colours ends at {}, and starts at {}", shortest(scale.max), shortest(scale.min)),
      both ? "expected min < max" : "expected min < max, both given");
}

void check_colors(const Inventory& inventory, const Scene& scene, Diagnostics& diagnostics) {
  for (size_t i = 0; i < min(inventory.bodies.size(), scene.roster.bodies.size()); ++i) {
    const optional<Coloring>& coloring = scene.roster.bodies[i].coloring;
    if (!coloring) continue;
    check_coloring(inventory.bodies[i].each, *coloring, scene, diagnostics);
  }
}

}  // namespace

void decode_overlay(const Node& root, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics) {
  const View whole(&root, kind_named("scene"), Place{});
  Overlay& overlay = scene.overlay;
  overlay.caption = decode_caption(root, diagnostics);
  overlay.trails = decode_trails(whole, inventory, scene.world, diagnostics);
  overlay.flash = whole.flag("flash").value_or(false);
  overlay.velocity_arrows = lists(whole.find("arrows"), "velocity");
  overlay.momentum_arrows = lists(whole.find("arrows"), "momentum");
  overlay.force_arrows = lists(whole.find("arrows"), "force");
  overlay.labels = decode_labels(whole, inventory, scene, diagnostics);
  overlay.scale_bar = whole.flag("scale_bar").value_or(false);
  overlay.shutter = whole.number("shutter").value_or(0);
  if (diagnostics.empty()) check_colors(inventory, scene, diagnostics);
}

}  // namespace carom
