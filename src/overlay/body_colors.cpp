// Each body has a rule or a constant colour. A rule is one for all bodies with equal keys, so that they share a scale.
#include "overlay/body_colors.h"

#include "physics/body_now.h"
#include "std.h"

namespace carom {

Color ColorRule::color_of(double value) const {
  if (coloring.by != ColorQuantity::group) return color_in(coloring.map, (value - scale.min) / (scale.max - scale.min));
  // One name alone has the middle of the map.
  const auto last = double(names.size()) - 1;
  return color_in(coloring.map, last > 0 ? value / last : 0.5);
}

vector<ColorRule> color_rules(const Scene& scene) {
  vector<ColorRule> rules;
  for (const BodyRange& range : scene.roster.bodies) {
    if (!range.coloring) continue;
    auto rule = ranges::find_if(rules, [&](const ColorRule& other) { return other.coloring == *range.coloring; });
    if (rule == rules.end()) rule = rules.insert(rules.end(), {*range.coloring, scale_of(scene, *range.coloring), {}});
    // Members of a repeated thing follow one another.
    if (rule->names.empty() || rule->names.back() != range.thing()) rule->names.emplace_back(range.thing());
  }
  return rules;
}

BodyColors::BodyColors(const Scene& scene) : scene_(scene), rules_(color_rules(scene)) {
  const Entity bodies = scene.world.body_count();
  color_.resize(bodies);
  if (!rules_.empty()) {
    rule_.assign(bodies, plain);
    name_.assign(bodies, 0);
  }

  vector<uint32_t> names(rules_.size(), 0);  // up to the body, by rule
  for (const BodyRange& range : scene.roster.bodies) {
    std::fill_n(color_.begin() + range.first, range.count, range.color);
    if (!range.coloring) continue;

    const auto rule =
        ranges::find_if(rules_, [&](const ColorRule& other) { return other.coloring == *range.coloring; }) -
        rules_.begin();
    std::fill_n(rule_.begin() + range.first, range.count, uint32_t(rule));

    uint32_t& name = names[size_t(rule)];
    if (rules_[size_t(rule)].names[name] != range.thing()) ++name;
    std::fill_n(name_.begin() + range.first, range.count, name);
  }
}

vector<Color> BodyColors::at(const State& state, const History& history) const {
  if (rule_.empty()) return {};
  vector<Color> colors(color_.size());
  for (Entity i = 0; i < colors.size(); ++i) colors[i] = of(i, state.time, state.velocity[i], state, history);
  return colors;
}

Color BodyColors::of(Entity body, double time, const Vec3& velocity, const State& state, const History& history) const {
  if (rule_.empty() || rule_[body] == plain) return color_[body];
  const ColorRule& rule = rules_[rule_[body]];
  const double mass = mass_now(scene_.world, state, body);

  switch (rule.coloring.by.value_or(ColorQuantity::group)) {
    case ColorQuantity::speed:
      return rule.color_of(velocity.norm());
    case ColorQuantity::kinetic:
      return rule.color_of(0.5 * mass * velocity.squaredNorm());
    case ColorQuantity::collisions:
      return rule.color_of(double(history.collisions_of(body, time)));

    case ColorQuantity::mass:
      return rule.color_of(mass);
    case ColorQuantity::radius:
      return rule.color_of(radius_now(scene_.world, state, body));
    case ColorQuantity::group:
      break;
  }
  return rule.color_of(name_[body]);
}

}  // namespace carom
