#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene/colors.h"
#include "scene/decode.h"
#include "scene/grid.h"
#include "scene/placement.h"
#include "scene/random.h"
#include "scene/values.h"

namespace carom {
namespace {

constexpr std::size_t max_overlaps_shown = 20;
constexpr std::size_t max_overlapping_kept = 1000;  // in the grid: a heap of balls in one place must not cost n^2

class Bodies {
 public:
  Bodies(const Node& root, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics)
      : root_(root),
        inventory_(inventory),
        scene_(scene),
        world_(scene.world),
        diagnostics_(diagnostics),
        good_(inventory.body_count, false) {}

  void run() {
    const std::size_t n = inventory_.body_count;
    world_.mass.assign(n, 1);
    world_.radius.assign(n, 1);
    world_.restitution.assign(n, 1);
    scene_.initial.position.assign(n, Vec3::Zero());
    scene_.initial.velocity.assign(n, Vec3::Zero());
    const View laws = scene_part(root_, "restitution");
    default_restitution_ = laws.number("default").value_or(1);

    std::size_t order = 0;
    for (const BodyEntry& body : inventory_.bodies) {
      const View view =
          body.group ? group_view(root_, *body.node, body.key->place) : ball_view(root_, *body.node, body.key->place);
      const Color chosen = *parse_color(body_color(order++));
      const std::optional<Color> color = body.group ? member_view(root_, view).color("color") : view.color("color");
      scene_.roster.bodies.push_back(
          {body.key->text, body.first, static_cast<Entity>(body.count), body.group, color.value_or(chosen)});
      if (!body.group) single(body, view);
    }
    grid_.reserve(n);
    check_singles();
    groups();
  }

 private:
  /// What a ball and a group's ball have in common, for `count` bodies from `first` on. False: something is missing.
  bool common(const View& ball, Entity first, std::uint64_t count) {
    const std::optional<double> mass = ball_mass(ball, diagnostics_);
    const std::optional<double> radius = ball.number("radius");
    if (!mass || !radius) return false;
    const auto fill = [&](auto& values, const auto& value) { std::fill_n(values.begin() + first, count, value); };
    fill(world_.mass, *mass);
    fill(world_.radius, *radius);
    fill(world_.restitution, ball.number("restitution").value_or(default_restitution_));
    if (const std::optional<Vec3> impulse = ball.vector("impulse"); impulse && !impulse->isZero(0)) {
      if (world_.impulse.empty()) world_.impulse.assign(inventory_.body_count, Vec3::Zero());
      fill(world_.impulse, *impulse);
    }
    return true;
  }

  void single(const BodyEntry& body, const View& view) {
    const std::optional<Vec3> position = view.vector("position"), velocity = view.vector("velocity");
    if (!common(view, body.first, 1) || !position || !velocity) return;
    scene_.initial.position[body.first] = *position;
    scene_.initial.velocity[body.first] = *velocity;
    good_[body.first] = true;
  }

  void check_singles() {
    std::vector<const BodyEntry*> by_size;
    for (const BodyEntry& body : inventory_.bodies) {
      if (!body.group && good_[body.first]) by_size.push_back(&body);
    }
    std::stable_sort(by_size.begin(), by_size.end(), [&](const BodyEntry* a, const BodyEntry* b) {
      return world_.radius[a->first] > world_.radius[b->first];
    });
    struct Found {
      Entity later, other;
      double depth;
    };
    std::vector<Found> found;
    for (const BodyEntry* body : by_size) {
      const Vec3& center = scene_.initial.position[body->first];
      const double radius = world_.radius[body->first];
      if (const auto overlap = grid_.find_overlap(center, radius)) {
        found.push_back(
            {std::max(overlap->entity, body->first), std::min(overlap->entity, body->first), overlap->depth});
        if (found.size() > max_overlapping_kept) continue;
      }
      grid_.insert({center, radius, body->first});
    }
    for (const BodyEntry* body : by_size) {
      const Vec3& center = scene_.initial.position[body->first];
      const double radius = world_.radius[body->first];
      for (std::size_t i = 0; i < inventory_.fixed.size(); ++i) {
        const FixedEntry& fixed = inventory_.fixed[i];
        for (Entity k = 0; k < fixed.count; ++k) {
          const Entity surface = inventory_.body_count + fixed.first + k;
          const std::optional<double> depth = world_.is_plane(surface)
                                                  ? overlap_depth(center, radius, world_.plane(surface))
                                                  : overlap_depth(center, radius, world_.wall(surface));
          if (depth) found.push_back({body->first, surface, *depth});
        }
      }
    }
    std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
      return std::tie(a.later, a.other) < std::tie(b.later, b.other);
    });
    for (std::size_t i = 0; i < std::min(found.size(), max_overlaps_shown); ++i) {
      std::string more;
      if (i + 1 == max_overlaps_shown && found.size() > max_overlaps_shown) {
        more = fmt::format("\nand {} more overlaps", found.size() - max_overlaps_shown);
      }
      report(found[i].later, found[i].other, found[i].depth, more);
    }
    if (found.size() > max_overlaps_shown) diagnostics_.add_uncounted(found.size() - max_overlaps_shown);
  }

  void report(Entity later, Entity other, double depth, const std::string& more) {
    const BodyEntry& body = *std::find_if(inventory_.bodies.begin(), inventory_.bodies.end(),
                                          [&](const BodyEntry& b) { return b.first == later && !b.group; });
    const Place place = ball_view(root_, *body.node, body.key->place).place("position");
    const std::string a = quoted(scene_.roster.name(later)), b = quoted(scene_.roster.name(other));
    if (world_.is_plane(other) && depth > 2 * world_.radius[later]) {
      diagnostics_.add(place, fmt::format("{} is behind {} at the start", a, b),
                       "expected it on the side that the normal points to" + more);
      return;
    }
    diagnostics_.add(place, fmt::format("{} overlaps {} by {:.6g} m at the start", a, b, depth),
                     "expected bodies apart, or just touching" + more);
  }

  /// Large members first, so that the grid finds them cheaply; a group's own order and stream do not depend on that.
  void groups() {
    std::vector<const BodyEntry*> by_size;
    for (const BodyEntry& body : inventory_.bodies) {
      if (!body.group || body.count == 0) continue;
      const View group = group_view(root_, *body.node, body.key->place);
      const View member = member_view(root_, group);
      if (common(member, body.first, body.count)) by_size.push_back(&body);
    }
    std::stable_sort(by_size.begin(), by_size.end(), [&](const BodyEntry* a, const BodyEntry* b) {
      return world_.radius[a->first] > world_.radius[b->first];
    });
    for (const BodyEntry* body : by_size) one_group(*body, group_view(root_, *body->node, body->key->place));
  }

  void one_group(const BodyEntry& body, const View& group) {
    const View box = group.part("in", "box");
    const std::optional<Vec3> min = box.vector("min"), max = box.vector("max");
    const std::optional<std::string> arrange = group.text("arrange");
    if (!min || !max || !arrange) return;
    const double radius = world_.radius[body.first];
    if (!((*max - *min) * 2).allFinite() || !((*max - *min).array() > 0).all()) {
      diagnostics_.add(box.place("max"), fmt::format("the box of {} has no inside", quoted(body.key->text)),
                       "expected min below max on every axis");
      return;
    }
    const Placing placing{body.count, radius, *min, *max,
                          *arrange == "lattice"     ? Arrange::lattice
                          : *arrange == "hexagonal" ? Arrange::hexagonal
                                                    : Arrange::random};
    Random random(scene_.seed, body.key->text + "/position");
    const Placed placed = place(placing, world_, grid_, random);
    if (placed.centers.size() < body.count) {
      diagnostics_.add(group.place("count"),
                       fmt::format("{} balls of radius {} do not fit into the box of {}", body.count, shortest(radius),
                                   quoted(body.key->text)),
                       fmt::format("{} would fit{}", placed.fit,
                                   *arrange == "lattice"     ? " as a lattice; `arrange: hexagonal` packs closer"
                                   : *arrange == "hexagonal" ? ""
                                                             : ", close-packed"));
      return;
    }
    std::copy(placed.centers.begin(), placed.centers.end(), scene_.initial.position.begin() + body.first);
    for (Entity i = 0; i < body.count; ++i) grid_.insert({placed.centers[i], radius, body.first + i});
    set_velocities(body, group);
  }

  void set_velocities(const BodyEntry& body, const View& group) {
    Vec3* velocity = scene_.initial.velocity.data() + body.first;
    if (const std::optional<double> speed = group.number("speed")) {
      Random random(scene_.seed, body.key->text + "/velocity");
      for (std::uint64_t i = 0; i < body.count; ++i) {
        for (int axis = 0; axis < 3; ++axis) velocity[i][axis] = *speed * random.normal();
      }
      return;
    }
    const std::optional<Vec3> common_velocity =
        group.given("velocity") != nullptr ? group.vector("velocity") : member_view(root_, group).vector("velocity");
    std::fill_n(velocity, body.count, common_velocity.value_or(Vec3::Zero()));
  }

  const Node& root_;
  const Inventory& inventory_;
  Scene& scene_;
  World& world_;
  Diagnostics& diagnostics_;
  std::vector<bool> good_;  // by body: a single ball without errors
  BallGrid grid_;
  double default_restitution_ = 1;
};

}  // namespace

std::optional<double> ball_mass(const View& ball, Diagnostics& diagnostics) {
  if (const std::optional<double> mass = ball.number("mass")) return mass;
  const std::optional<double> density = ball.number("density"), radius = ball.number("radius");
  if (!density || !radius) return std::nullopt;
  const double mass = *density * (4.0 / 3.0 * 3.14159265358979323846) * *radius * *radius * *radius;
  if (mass > 0 && std::isfinite(mass)) return mass;
  diagnostics.add(ball.place("density"),
                  fmt::format("this density and radius {} make a mass of {} kg", shortest(*radius), mass),
                  "expected a mass above 0 and finite");
  return std::nullopt;
}

void decode_bodies(const Node& root, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics) {
  Bodies(root, inventory, scene, diagnostics).run();
}

}  // namespace carom
