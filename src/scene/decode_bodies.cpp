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
#include "scene/push.h"
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
      auto keys = filled<BodyKeys>(each);
      const optional<RadiiKeys> radii = radii_of(each);
      if (radii) keys.radius = radii->to;
      const optional<Form> form = forms_.of(keys, keys.color.has_value());

      const string_view family = family_of(body.key->text);
      if (family.empty() || family != last_family) ++things;
      last_family = family;
      const Color chosen = body_color(scene_.look, things - 1);
      const BodyColor color = keys.color.value_or(BodyColor{chosen, nullopt});
      scene_.roster.bodies.push_back({body.key->text, body.first, Entity(body.count), body.group,
                                      color.by ? chosen : color.plain, form ? form->mesh : nullopt, color.by,
                                      Surface{keys.finish, keys.opacity}});

      // A body with an error keeps its number.
      const optional<double> mass = form ? mass_of(keys, form->volume, each) : nullopt;
      if (!mass) continue;
      common(keys, *mass, form->volume, body);
      if (radii) draw_radii(*radii, keys, body);

      if (!body.group) single(body.first, keys, view.place("position"));
      if (body.group && view.given("members") != nullptr)
        members(body, keys);
      else if (body.group && body.count > 0)
        groups_.push_back({form->volume.reach(), &body});
    }

    if (diagnostics_.empty()) {
      check_reach(root_, inventory_, scene_, diagnostics_);
      if (!diagnostics_.empty()) return;
    }

    // Groups are placed when all single bodies are in the grid.
    grid_.reserve(n);
    if (diagnostics_.empty() && !push()) return;
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
    const optional<double> appear = entry.group ? filled<GroupKeys>(entry.view).appear : body.appear;
    if (appear.value_or(0) > 0) fill(appearances(), *appear);
    if (body.impulse.isZero(0)) return;
    if (world_.impulse.empty()) world_.impulse.assign(inventory_.body_count, Vec3::Zero());
    fill(world_.impulse, body.impulse);
  }

  /// When bodies come into the world (s).
  vector<double>& appearances() {
    if (world_.appears.empty()) world_.appears.assign(inventory_.body_count, -infinity);
    return world_.appears;
  }

  /// The range of the radii of a group's balls. None: they have one radius, or an error was reported.
  optional<RadiiKeys> radii_of(const View& ball) {
    const Field* field = find_field(ball.kind(), "radius");
    const Node* node = field == nullptr || field->held == nullptr ? nullptr : ball.find(*field);
    if (node == nullptr || !node->is_map()) return nullopt;
    const auto radii = filled<RadiiKeys>(ball.part(*field));
    if (!radii.from || !radii.to) return nullopt;
    if (*radii.from <= *radii.to) return radii;
    diagnostics_.add(place_of(*node->find("to")),
                     fmt::format("the radii go from {} to {}", shortest(*radii.from), shortest(*radii.to)),
                     "expected `from` below `to`");
    return nullopt;
  }

  /// Each ball has a radius of its own, and the mass that `density` makes of it.
  void draw_radii(const RadiiKeys& radii, const BodyKeys& keys, const BodyEntry& entry) {
    Random random(scene_.seed, entry.key->text + "/radius");
    for (Entity i = entry.first; i < entry.first + entry.count; ++i) {
      const double share = random.uniform();
      set_radius(i, *radii.from + share * (*radii.to - *radii.from), keys);
    }
  }

  /// Gives a ball a radius of its own, and the mass that the density makes of it.
  void set_radius(Entity ball, double radius, const BodyKeys& keys) {
    const Volume volume = Volume::sphere(radius);
    world_.radius[ball] = radius;
    if (!world_.volume.empty()) world_.volume[ball] = volume;
    if (!keys.mass && keys.density) world_.mass[ball] = *keys.density * volume.size();
  }

  void single(Entity body, const BodyKeys& keys, Place place) {
    if (!keys.position || !keys.velocity) return;
    scene_.initial.position[body] = *keys.position;
    scene_.initial.velocity[body] = *keys.velocity;
    singles_.push_back({body, place});
  }

  /// Places the balls of a group that lists them. `common`: of what a ball does not have for itself.
  void members(const BodyEntry& body, const BodyKeys& common) {
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
      keys.velocity = entry.given("velocity") == nullptr ? common.velocity : placed.velocity;
      single(body.first + i, keys, entry.place("position"));
      if (placed.radius) set_radius(body.first + i, *placed.radius, common);
      if (placed.mass) world_.mass[body.first + i] = *placed.mass;
    }
    // What is in the place of one that comes later may leave.
    const auto group = filled<GroupKeys>(body.view);
    if (group.overlap == OverlapRule::push && !(group.appear.value_or(0) > 0)) pushed_.push_back(&body);
  }

  /// Moves balls apart where their groups ask for it, and says how far. False: there is no room, an error was added.
  bool push() {
    vector<Entity> movable, others;
    for (const BodyEntry* group : pushed_)
      for (Entity i = 0; i < group->count; ++i) movable.push_back(group->first + i);
    if (movable.empty()) return true;
    ranges::sort(movable);
    for (const SingleBody& each : singles_)
      if (!ranges::binary_search(movable, each.body) && !world_.comes_later(each.body)) others.push_back(each.body);

    const vector<Vec3> before = scene_.initial.position;
    const optional<PushedPair> left = push_apart(world_, movable, others, scene_.initial.position);
    if (left) refuse_push(*left);
    for (const BodyEntry* group : pushed_)
      if (!left) note_push(*group, before);
    return !left;
  }

  void refuse_push(const PushedPair& pair) {
    const auto found = ranges::lower_bound(singles_, pair.ball, {}, &SingleBody::body);
    diagnostics_.add(found->position,
                     fmt::format("{} and {} cannot be pushed apart: they still overlap by {:.3g} m",
                                 in_backticks(scene_.roster.name(pair.ball)),
                                 in_backticks(scene_.roster.name(pair.other)), pair.depth),
                     "expected room between what `overlap: push` moves apart, or smaller radii");
  }

  void note_push(const BodyEntry& group, const vector<Vec3>& before) {
    uint64_t count = 0;
    Entity furthest = group.first;
    double distance = 0;
    for (Entity i = group.first; i < group.first + group.count; ++i) {
      const double moved = (scene_.initial.position[i] - before[i]).norm();
      if (moved > 0) ++count;
      if (moved > distance) distance = moved, furthest = i;
    }
    if (count == 0) return;
    scene_.made_from.notes.push_back(fmt::format("overlap: push moved {} of {}, the furthest by {:.3g} m: {}",
                                                 how_many(count, "ball", "balls"), group.key->text, distance,
                                                 scene_.roster.name(furthest)));
  }

  /// Groups with large members first, which makes the grid's searches cheap.
  /// The order inside a group and its random stream do not depend on that.
  void groups() {
    ranges::stable_sort(groups_, [](const auto& a, const auto& b) { return a.first > b.first; });
    for (const auto& [largest, body] : groups_) one_group(*body);
  }

  void one_group(const BodyEntry& body) {
    const View& view = body.view;
    const auto group = filled<GroupKeys>(view);
    optional<Placing> placing = space_of(body, group.in);
    if (!placing || !(group.arrange || group.rate)) return;
    placing->count = body.count;
    placing->first = body.first;
    placing->radii = span(world_.radius).subspan(body.first, body.count);
    set_velocities(body, group);
    if (group.rate) return pour(body, group, *placing);

    // Find the places. What is there now may have left when the group appears.
    const bool later = group.appear.value_or(0) > 0;
    placing->arrange = *group.arrange;
    Random random(scene_.seed, body.key->text + "/position");
    const Placed placed = place(*placing, world_, later ? obstacles_ : grid_, random);
    if (placed.centers.size() < body.count) return refuse_count(body, *placing, placed.fit);

    ranges::copy(placed.centers, scene_.initial.position.begin() + body.first);
    if (later) return;
    for (Entity i = 0; i < body.count; ++i)
      grid_.insert({placed.centers[i], world_.radius[body.first + i], body.first + i});
  }

  /// The balls of a group that come one after the other.
  void pour(const BodyEntry& body, const GroupKeys& group, const Placing& space) {
    const double radius = ranges::max(space.radii);
    if (!(space.space.half.array() >= radius).all()) {
      diagnostics_.add(body.view.place("in"),
                       fmt::format("a ball of radius {} does not fit into the space of {}", shortest(radius),
                                   in_backticks(body.key->text)),
                       "expected a space as wide as a ball");
      return;
    }

    for (Entity k = 0; k < body.count; ++k) {
      appearances()[body.first + k] = group.from.value_or(0) + k / *group.rate;
      scene_.initial.position[body.first + k] = space.center;
    }
    Random random(scene_.seed, body.key->text + "/position");
    world_.pours.push_back({body.first, Entity(body.count), *group.rate, space.center, space.space, random.bits()});
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

  /// The space of a group's balls, without the balls. None: it has an error.
  optional<Placing> space_of(const BodyEntry& body, const SpaceKeys& in) {
    Placing placing;
    if (in.radius || in.cylinder) {
      if (in.cylinder && (!in.cylinder->radius || !in.cylinder->height)) return nullopt;
      placing.space =
          in.radius ? Volume::sphere(*in.radius) : Volume::cylinder(*in.cylinder->radius, *in.cylinder->height);
      placing.center = in.position;
      placing.min = in.position - placing.space.half;
      placing.max = in.position + placing.space.half;
      return placing;
    }

    if (!in.min || !in.max) return nullopt;
    placing.min = *in.min;
    placing.max = *in.max;
    const Vec3 edges = placing.max - placing.min;
    placing.space = Volume::box(edges);
    placing.center = placing.min + placing.space.half;
    if ((edges * 2).allFinite() && (edges.array() > 0).all()) return placing;
    diagnostics_.add(body.view.part("in").place("max"),
                     fmt::format("the box of {} has no volume", in_backticks(body.key->text)),
                     "expected min below max on every axis");
    return nullopt;
  }

  /// `fit`: the number that has room.
  void refuse_count(const BodyEntry& body, const Placing& placing, uint64_t fit) {
    const auto [least, greatest] = ranges::minmax(placing.radii);
    const bool alike = least == greatest;
    const string radii =
        alike ? fmt::format("radius {}", shortest(least)) : fmt::format("radii up to {}", shortest(greatest));

    // The words for the space, and for the arrangement that has most room.
    const char* space = placing.space.shape == Shape::sphere     ? "ball"
                        : placing.space.shape == Shape::cylinder ? "cylinder"
                                                                 : "box";
    const char* arranged = placing.arrange == Arrange::lattice ? " as a lattice; `arrange: hexagonal` packs closer"
                           : placing.arrange == Arrange::hexagonal || placing.space.shape != Shape::box
                               ? ""
                               : ", close-packed";
    diagnostics_.add(body.view.place("count"),
                     fmt::format("{} of {} {} not fit into the {} of {}",
                                 body.count == 1 ? "1 ball" : fmt::format("{} balls", body.count), radii,
                                 body.count == 1 ? "does" : "do", space, in_backticks(body.key->text)),
                     fmt::format("{} {}would fit{}", fit, alike ? "" : "of the largest ", arranged));
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
  vector<SingleBody> singles_;       // those without errors, by number
  vector<const BodyEntry*> pushed_;  // groups with `overlap: push`
  /// Those with members and without errors in their balls.
  vector<pair<double, const BodyEntry*>> groups_;  // by the largest radius (m)
  BodyGrid grid_;                                  // bodies and obstacles
  BodyGrid obstacles_;                             // alone
  double default_restitution_ = 1;
};

}  // namespace

void decode_bodies(const Node& root, const Inventory& inventory, Forms& forms, Scene& scene, Diagnostics& diagnostics) {
  Bodies(root, inventory, forms, scene, diagnostics).run();
}

}  // namespace carom
