// Checks that doubles can represent the scene.
// How far its things lie, and how far its bodies go, is compared with the smallest size in it (physics/bounds.h).
#include <fmt/format.h>

#include "physics/bounds.h"
#include "physics/world.h"
#include "scene/decode.h"
#include "scene/fields.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

class Reach {
 public:
  Reach(const Node& root, const Inventory& inventory, const Scene& scene, Diagnostics& diagnostics)
      : root_(root),
        inventory_(inventory),
        scene_(scene),
        world_(scene.world),
        diagnostics_(diagnostics),
        smallest_(smallest_size(world_)),
        farthest_(farthest_by_size * smallest_) {}

  void check() {
    for (const FixedEntry& entry : inventory_.fixed) {
      check_places(entry.view, entry.key->text);
      check_motion(entry);
    }
    for (const StringEntry& string : inventory_.strings) check_places(string.view, string.key->text);

    for (const BodyEntry& body : inventory_.bodies) {
      if (body.count == 0) continue;
      const View& view = body.view;
      if (body.group && view.given("members") != nullptr) {
        check_members(body);
        continue;
      }

      check_places(body.group ? view.part("in") : view, body.key->text);
      check_speed(body);
    }

    check_pull();
  }

 private:
  /// Checks a group that lists its balls.
  void check_members(const BodyEntry& body) {
    const Node& list = *body.view.given("members");
    for (size_t i = 0; i < list.items.size(); ++i) {
      const View entry(&list.items[i], kind_named("placed"), list.items[i].place);
      const string name = fmt::format("{}.{}", body.key->text, i);
      check_places(entry, name);
      const View& giver = entry.given("velocity") == nullptr ? body.each : entry;
      check_speed(name, giver.vector("velocity").value_or(Vec3::Zero()).norm() + kick_of(body).norm(),
                  giver.place("velocity"));
    }
  }

  /// `view`: a body, a fixed thing, a string, a group's box or one of its balls.
  void check_places(const View& view, const string& name) {
    for (const string_view key : {"position", "point", "center", "min", "max", "from"}) {
      if (find_field(view.kind(), key) == nullptr) continue;
      const optional<Vec3> at = view.vector(key);
      if (at)
        check_length(at->cwiseAbs().maxCoeff(), view.place(key), "{} is {} m from the origin", name, "bring it nearer");
    }
    for (const string_view key : {"radius", "cylinder", "box", "size", "length"}) {
      if (find_field(view.kind(), key) == nullptr || view.find(key) == nullptr) continue;
      check_length(largest_number(*view.find(key)), view.place(key), "{} is {} m in size", name, "make it smaller");
    }
  }

  void check_motion(const FixedEntry& entry) {
    const Entity e = inventory_.body_count + entry.first;
    if (!world_.moves(e)) return;

    const double end = scene_.simulate.duration;
    double farthest = 0;
    for (const double time : farthest_times(world_.motion(e), 0, end))
      farthest = max(farthest, fixed_position(world_, e, {time, 0}).cwiseAbs().maxCoeff());

    if (const Swing* swing = world_.swing(e); swing != nullptr && !(greatest_speed(*swing) <= largest_speed)) {
      diagnostics_.add(
          entry.view.place("motion"),
          fmt::format("{} moves at up to {} m/s", in_backticks(entry.key->text), shortest(greatest_speed(*swing))),
          fmt::format("expected at most {:g} m/s: a longer period, or a shorter way", largest_speed));
      return;
    }
    check_length(farthest, entry.view.place("motion"), "{} goes as far as {} m from the origin", entry.key->text,
                 "move it less far");
  }

  static double largest_number(const Node& node) {
    double largest = as_number(&node).value_or(0);
    for (const Node& item : node.items) largest = max(largest, as_number(&item).value_or(0));
    return largest;
  }

  void check_length(double length, Place place, string_view message, const string& name, string_view change) {
    if (length <= farthest_) return;
    diagnostics_.add(
        place,
        fmt::format(fmt::runtime(message), in_backticks(name), shortest(length)) +
            fmt::format(", more than {:g} times the smallest size, {} m", farthest_by_size, shortest(smallest_)),
        fmt::format("doubles do not resolve contact there: {}, or make the smallest thing larger", change));
  }

  /// The velocity (m/s) that an impulse gives to a body.
  Vec3 kick_of(const BodyEntry& body) const {
    if (world_.impulse.empty()) return Vec3::Zero();
    const double lightest = ranges::min(span(world_.mass).subspan(body.first, body.count));
    return world_.impulse[body.first] / lightest;
  }

  void check_speed(const BodyEntry& body) {
    const View &view = body.view, &each = body.each;
    const optional<double> deviation = body.group ? view.number("speed") : nullopt;
    const bool common = body.group && view.given("velocity") != nullptr;
    const Vec3 velocity = (common ? view : each).vector("velocity").value_or(Vec3::Zero());
    const Vec3 kick = kick_of(body);
    const string_view key = !kick.isZero(0) ? "impulse" : deviation ? "speed" : "velocity";
    const Place place = (key == "speed" || (common && key == "velocity") ? view : each).place(key);
    check_speed(body.key->text, deviation.value_or(velocity.norm()) + kick.norm(), place);
  }

  /// `speed`: at time 0, in m/s. `place`: of the value that gives it.
  void check_speed(const string& name, double speed, Place place) {
    if (!(speed <= largest_speed)) {
      diagnostics_.add(place, fmt::format("{} starts at {} m/s", in_backticks(name), shortest(speed)),
                       fmt::format("expected at most {:g} m/s", largest_speed));
      return;
    }
    const double way = speed * scene_.simulate.duration;
    if (way <= farthest_) return;
    diagnostics_.add(place,
                     fmt::format("{} travels {} m in the duration, more than {:g} times the smallest size, {} m",
                                 in_backticks(name), shortest(way), farthest_by_size, shortest(smallest_)),
                     "doubles do not resolve its position then: expected a shorter duration, a lower speed, or larger "
                     "things");
  }

  /// Checks the sum of the forces that are the same everywhere.
  void check_pull() {
    for (Entity i = 0; i < world_.body_count(); ++i) {
      double pull = 0;
      for (const Force& force : world_.forces) {
        if (!force.on.empty() && !std::binary_search(force.on.begin(), force.on.end(), i)) continue;
        if (const auto* uniform = std::get_if<UniformForce>(&force.law)) pull += uniform->force.norm() / world_.mass[i];
      }

      if (pull <= largest_acceleration) continue;
      diagnostics_.add(root_.find_key("forces")->place,
                       fmt::format("the uniform forces accelerate {} by {} m/s^2", in_backticks(scene_.roster.name(i)),
                                   shortest(pull)),
                       fmt::format("expected at most {:g} m/s^2", largest_acceleration));
      return;
    }
  }

  const Node& root_;
  const Inventory& inventory_;
  const Scene& scene_;
  const World& world_;
  Diagnostics& diagnostics_;
  double smallest_, farthest_;  // m
};

}  // namespace

void check_reach(const Node& root, const Inventory& inventory, const Scene& scene, Diagnostics& diagnostics) {
  Reach(root, inventory, scene, diagnostics).check();
}

}  // namespace carom
