// Decodes bodies in two passes: all single bodies in the order of the file, then the members of groups.
// Groups are placed only after every single body and obstacle is in the grid, so that members avoid them.
// Each group draws from random streams of its own name,
// so that editing one group leaves the numbers of the others unchanged.
#include <fmt/format.h>

#include <numeric>

#include "numerics/random.h"
#include "physics/world.h"
#include "scene/colors.h"
#include "scene/decode.h"
#include "scene/fields.h"
#include "scene/grid.h"
#include "scene/member.h"
#include "scene/overlaps.h"
#include "scene/placement.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/joined.h"
#include "yaml/values.h"

namespace carom {
namespace {

class Bodies {
 public:
  Bodies(const Node& root, const Inventory& inventory, Forms& forms, Scene& scene, Diagnostics& diagnostics)
      : root_(root),
        inventory_(inventory),
        forms_(forms),
        scene_(scene),
        world_(scene.world),
        diagnostics_(diagnostics),
        grid_(&scene.world),
        obstacles_(&scene.world) {}

  void run() {
    const size_t n = inventory_.body_count;
    world_.mass.assign(n, 1);
    world_.radius.assign(n, 1);
    world_.restitution.assign(n, 1);
    scene_.initial.position.assign(n, Vec3::Zero());
    scene_.initial.velocity.assign(n, Vec3::Zero());
    default_restitution_ = filled<RestitutionKeys>(scene_part(root_, "restitution")).coefficient;

    scene_.roster.bodies.reserve(inventory_.bodies.size());
    // Members of a repeated thing have a colour in common, as those of a group have.
    size_t things = 0;
    string_view last_family;
    for (const BodyEntry& body : inventory_.bodies) {
      const View &view = body.view, &each = body.each;
      const auto keys = filled<BodyKeys>(each);
      const optional<Form> form = forms_.of(keys, keys.color.has_value());

      const string_view family = family_of(body.key->text);
      if (family.empty() || family != last_family) ++things;
      last_family = family;
      const Color chosen = body_color(things - 1);
      const BodyColor color = keys.color.value_or(BodyColor{chosen, nullopt});
      scene_.roster.bodies.push_back({body.key->text, body.first, Entity(body.count), body.group,
                                      color.by ? chosen : color.plain, form ? form->mesh : nullopt, color.by});

      // A body with an error keeps its number.
      const optional<double> mass = form ? mass_of(keys, form->volume, each) : nullopt;
      if (!mass) continue;
      common(keys, *mass, form->volume, body);

      if (!body.group) single(body.first, keys, view.place("position"));
      if (body.group && view.given("members") != nullptr)
        members(body, keys.velocity);
      else if (body.group && body.count > 0)
        groups_.push_back(&body);
    }

    if (diagnostics_.empty()) {
      check_reach(root_, inventory_, scene_, diagnostics_);
      if (!diagnostics_.empty()) return;
    }

    // Groups are placed when all single bodies are in the grid.
    grid_.reserve(n);
    check_overlaps(scene_, singles_, grid_, obstacles_, diagnostics_);
    groups();
    hold_back();
  }

 private:
  optional<double> mass_of(const BodyKeys& body, const Volume& volume, const View& view) {
    if (body.mass || !body.density) return body.mass;
    const double mass = *body.density * volume.size();
    const Range limits = limited_range(*find_field(view.kind(), "mass"));
    if (contains(limits, mass)) return mass;
    diagnostics_.add(view.place("density"),
                     fmt::format("this density and a volume of {:.6g} m^3 make a mass of {} kg", volume.size(), mass),
                     limit_text(limits, "kg"));
    return nullopt;
  }

  /// Sets what a ball, a body and a group's balls have in common.
  void common(const BodyKeys& body, double mass, const Volume& volume, const BodyEntry& entry) {
    const auto fill = [&](auto& values, const auto& value) {
      std::fill_n(values.begin() + entry.first, entry.count, value);
    };

    fill(world_.mass, mass);
    fill(world_.radius, volume.reach());

    // Volumes are stored as soon as one is no sphere.
    if (volume.shape != Shape::sphere && world_.volume.empty()) {
      world_.volume.reserve(inventory_.body_count);
      for (const double radius : world_.radius) world_.volume.push_back(Volume::sphere(radius));
    }
    if (!world_.volume.empty()) fill(world_.volume, volume);

    fill(world_.restitution, body.restitution.value_or(default_restitution_));
    if (const double appear = entry.group ? filled<GroupKeys>(entry.view).appear : body.appear; appear > 0)
      fill(appearances(), appear);
    if (body.impulse.isZero(0)) return;
    if (world_.impulse.empty()) world_.impulse.assign(inventory_.body_count, Vec3::Zero());
    fill(world_.impulse, body.impulse);
  }

  /// When bodies come into the world (s).
  vector<double>& appearances() {
    if (world_.appears.empty()) world_.appears.assign(inventory_.body_count, -infinity);
    return world_.appears;
  }

  void single(Entity body, const BodyKeys& keys, Place place) {
    if (!keys.position || !keys.velocity) return;
    scene_.initial.position[body] = *keys.position;
    scene_.initial.velocity[body] = *keys.velocity;
    singles_.push_back({body, place});
  }

  /// Places the balls of a group that lists them. `velocity`: of balls without one, in m/s.
  void members(const BodyEntry& body, const optional<Vec3>& velocity) {
    const Node& list = *body.view.given("members");
    if (!list.is_sequence()) return;

    if (list.items.size() != body.count) {
      diagnostics_.add(body.view.place("members"),
                       fmt::format("`members` of {} has {}, and `count` is {}", in_backticks(body.key->text),
                                   how_many(list.items.size(), "entry", "entries"), body.count),
                       "expected an entry for each ball");
      return;
    }

    const Kind& kind = kind_named("placed");
    for (Entity i = 0; i < body.count; ++i) {
      const View entry(&list.items[i], kind, list.items[i].place);
      BodyKeys keys;
      const auto placed = filled<PlacedKeys>(entry);
      keys.position = placed.position;
      keys.velocity = entry.given("velocity") == nullptr ? velocity : placed.velocity;
      single(body.first + i, keys, entry.place("position"));
    }
  }

  /// Groups with large members first, which makes the grid's searches cheap.
  /// The order inside a group and its random stream do not depend on that.
  void groups() {
    ranges::stable_sort(groups_, [&](const BodyEntry* a, const BodyEntry* b) {
      return world_.radius[a->first] > world_.radius[b->first];
    });
    for (const BodyEntry* body : groups_) one_group(*body);
  }

  void one_group(const BodyEntry& body) {
    const View& view = body.view;
    const auto group = filled<GroupKeys>(view);
    const auto& [min, max] = group.in;
    const optional<Arrange> arrange = group.arrange;
    if (!min || !max || (!arrange && !group.rate)) return;

    const double radius = world_.radius[body.first];
    if (!((*max - *min) * 2).allFinite() || !((*max - *min).array() > 0).all()) {
      diagnostics_.add(view.part("in").place("max"),
                       fmt::format("the box of {} has no volume", in_backticks(body.key->text)),
                       "expected min below max on every axis");
      return;
    }

    set_velocities(body, group);
    if (group.rate) return pour(body, group);

    // Find the places. What is there now may have left when the group appears.
    const bool later = group.appear > 0;
    const Placing placing{body.count, body.first, radius, *min, *max, *arrange};
    Random random(scene_.seed, body.key->text + "/position");
    const Placed placed = place(placing, world_, later ? obstacles_ : grid_, random);

    if (placed.centers.size() < body.count) {
      diagnostics_.add(view.place("count"),
                       fmt::format("{} of radius {} {} not fit into the box of {}",
                                   body.count == 1 ? "1 ball" : fmt::format("{} balls", body.count), shortest(radius),
                                   body.count == 1 ? "does" : "do", in_backticks(body.key->text)),
                       fmt::format("{} would fit{}", placed.fit,
                                   arrange == Arrange::lattice     ? " as a lattice; `arrange: hexagonal` packs closer"
                                   : arrange == Arrange::hexagonal ? ""
                                                                   : ", close-packed"));
      return;
    }

    ranges::copy(placed.centers, scene_.initial.position.begin() + body.first);
    if (later) return;
    for (Entity i = 0; i < body.count; ++i) grid_.insert({placed.centers[i], radius, body.first + i});
  }

  /// The balls of a group that come one after the other.
  void pour(const BodyEntry& body, const GroupKeys& group) {
    const double radius = world_.radius[body.first];
    const auto& [min, max] = group.in;
    const Vec3 half = 0.5 * (*max - *min) - Vec3::Constant(radius);
    if (!(half.array() >= 0).all()) {
      diagnostics_.add(body.view.part("in").place("max"),
                       fmt::format("a ball of radius {} does not fit into the box of {}", shortest(radius),
                                   in_backticks(body.key->text)),
                       "expected a box as wide as a ball on every axis");
      return;
    }

    const Vec3 center = 0.5 * *min + 0.5 * *max;
    for (Entity k = 0; k < body.count; ++k) {
      appearances()[body.first + k] = group.from + k / *group.rate;
      scene_.initial.position[body.first + k] = center;
    }
    Random random(scene_.seed, body.key->text + "/position");
    world_.pours.push_back({body.first, Entity(body.count), *group.rate, center, {Shape::box, half}, random.bits()});
  }

  /// Takes the bodies that come later out of the world at the start.
  void hold_back() {
    if (world_.appears.empty()) return;
    State& initial = scene_.initial;
    initial.mass = world_.mass;
    initial.radius = world_.radius;
    initial.volume = world_.volume;
    initial.part_of.resize(world_.body_count());
    for (Entity i = 0; i < world_.body_count(); ++i) initial.part_of[i] = world_.comes_later(i) ? no_entity : i;
    initial.join_parts();
  }

  void set_velocities(const BodyEntry& body, const GroupKeys& group) {
    Vec3* velocity = scene_.initial.velocity.data() + body.first;
    if (group.speed) {
      Random random(scene_.seed, body.key->text + "/velocity");
      for (uint64_t i = 0; i < body.count; ++i) {
        for (int axis = 0; axis < 3; ++axis) velocity[i][axis] = *group.speed * random.normal();
      }
      return;
    }
    const optional<Vec3> common_velocity = group.velocity ? group.velocity : filled<BodyKeys>(body.each).velocity;
    std::fill_n(velocity, body.count, common_velocity.value_or(Vec3::Zero()));
  }

  const Node& root_;
  const Inventory& inventory_;
  Forms& forms_;
  Scene& scene_;
  World& world_;
  Diagnostics& diagnostics_;
  vector<SingleBody> singles_;  // those without errors, by number
  /// Those with members and without errors in their balls.
  vector<const BodyEntry*> groups_;
  BodyGrid grid_;       // bodies and obstacles
  BodyGrid obstacles_;  // alone
  double default_restitution_ = 1;
};

}  // namespace

void decode_bodies(const Node& root, const Inventory& inventory, Forms& forms, Scene& scene, Diagnostics& diagnostics) {
  Bodies(root, inventory, forms, scene, diagnostics).run();
}

}  // namespace carom
