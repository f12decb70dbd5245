// Decodes strings and rods: first their ends, and when the bodies have their positions, their lengths.
// A string with an error still gets a number, so that the numbers of the others do not shift.
#include <fmt/format.h>

#include "physics/world.h"
#include "scene/decode.h"
#include "scene/events.h"
#include "scene/member.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

/// Share of coordinates and length: places and lengths are rounded, and so are the expressions that they come from.
/// Ends whose distance differs from the length by less are as far apart as the string is long.
constexpr double rounding_of_lengths = 0x1p-48;
/// The same for the state of a former run, which has the errors of its paths. Speeds along rods may be such a state in
/// any scene: in that of a run which began so.
constexpr double rounding_of_runs = 1e-9;

constexpr string_view good_end = "expected a ball, a body or a member (gas.3)";

}  // namespace

optional<Entity> body_at(const Node& name, const Inventory& inventory, string_view what, Diagnostics& diagnostics) {
  const auto range = find_range(name, inventory, Sought::bodies, diagnostics);
  if (!range) return nullopt;
  if (range->count == 0) {
    diagnostics.add(name.place, fmt::format("{} has no balls: there is nothing to tie", in_backticks(name.text)),
                    string(good_end));
    return nullopt;
  }

  if (range->first >= inventory.body_count) {
    diagnostics.add(
        name.place,
        fmt::format("{} is {}: no {} is tied to it", in_backticks(name.text), inventory.word_for(*range), what),
        fmt::format("{}; a fixed end is a point: `from: [x, y, z]`", good_end));
    return nullopt;
  }

  if (range->count > 1) {
    diagnostics.add(
        name.place,
        fmt::format("{} has {} bodies: a {} has one at each end", in_backticks(name.text), range->count, what),
        fmt::format("expected one of them, such as {0}.0; for a {1} to each `repeat`, and '{0}.{{i}}'", name.text,
                    what));
    return nullopt;
  }

  return range->first;
}

namespace {

/// A string without a length. With an error it may lack a body.
String decode_string(const View& view, const Inventory& inventory, Diagnostics& diagnostics) {
  const auto keys = filled<StringKeys>(view);
  String string;
  string.body = no_entity;
  string.restitution = keys.restitution;
  string.rod = keys.rod;
  string.until = keys.until;

  const bool good = keys.from != nullptr && keys.to != nullptr && !keys.from->bad && !keys.to->bad;
  const bool is_point = keys.from != nullptr && keys.from->is_sequence();
  if (!good) return string;

  // Its ends.
  if (is_point) string.anchor = as_vector(keys.from).value_or(Vec3::Zero());
  const optional<Entity> from = is_point ? optional(no_entity) : body_at(*keys.from, inventory, "string", diagnostics);
  const optional<Entity> to = body_at(*keys.to, inventory, "string", diagnostics);
  if (!from || !to) return string;

  if (*from == *to) {
    diagnostics.add(keys.to->place, fmt::format("{} is tied to itself", in_backticks(keys.to->text)),
                    "expected two bodies, or a point and a body");
    return string;
  }
  // Both directions are the same string. no_entity is the largest number.
  string.body = min(*from, *to);
  string.other = max(*from, *to);
  return string;
}

/// Finds lengths and checks them.
class Lengths {
 public:
  Lengths(const Inventory& inventory, Scene& scene, Diagnostics& diagnostics)
      : inventory_(inventory), scene_(scene), diagnostics_(diagnostics), bodies_are_good_(diagnostics.empty()) {}

  void run() {
    for (size_t i = 0; i < inventory_.strings.size(); ++i)
      one(scene_.world.strings[i], inventory_.strings[i].view, inventory_.strings[i].key->text);
  }

 private:
  void one(String& string, const View& view, const std::string& name) {
    if (string.body == no_entity) return;
    for (const Entity end : {string.body, string.other}) {
      if (end == no_entity || !scene_.world.comes_later(end)) continue;
      diagnostics_.add(view.place("to"),
                       fmt::format("{} is tied to {}, which appears at {} s", in_backticks(name),
                                   in_backticks(scene_.roster.name(end)), shortest(scene_.world.appears[end])),
                       "expected bodies that are there from the start");
      return;
    }

    const optional<Vec3> a = position_of(string.body);
    const optional<Vec3> b = string.other == no_entity ? string.anchor : position_of(string.other);
    const optional<double> given = view.number("length");
    string.length = given.value_or(0);
    if (!a || !b || (view.given("length") != nullptr && !given)) return;

    if (!given && scene_.made_from.start) {
      diagnostics_.add(
          view.where(),
          fmt::format("{} has no `length`, and its ends begin where a former run had them", in_backticks(name)),
          "expected `length`: that of scene.yaml in the folder of the former run");
      return;
    }

    const double distance = (*a - *b).norm();
    const double far = max(a->cwiseAbs().maxCoeff(), b->cwiseAbs().maxCoeff());
    if (!given && distance == 0) {
      diagnostics_.add(view.where(), fmt::format("the ends of {} are at the same point at time 0", in_backticks(name)),
                       "expected `length`: a number above 0 in m");
      return;
    }

    string.length = given.value_or(distance);
    const double length = string.length;
    if (length < least_share_of_coordinates * far) {
      diagnostics_.add(
          view.place("length"),
          fmt::format("{} is {} m long and {} m from the origin", in_backticks(name), shortest(length), shortest(far)),
          "doubles do not resolve it there: bring it nearer, or make it longer");
      return;
    }

    // The length against the distance of the ends.
    const double off = std::fabs(distance - length) / (far + length);
    if (off <= rounding()) {
      // The resolved scene has this length and no `start`: it must be understood alike.
      if (distance > length || string.rod || off <= rounding_of_lengths) string.length = distance;
    } else if (distance > length || string.rod) {
      diagnostics_.add(view.place("length"),
                       fmt::format("{} is {} m long, but its ends are {} m apart at time 0", in_backticks(name),
                                   shortest(length), shortest(distance)),
                       string.rod
                           ? "the ends of a rod are as far apart as it is long: leave out `length`, or move an end"
                           : "expected a length of at least that distance; without `length` it is the distance");
      return;
    }
    if (string.rod && bodies_are_good_) check_rod(string, *a - *b, far, view, name);
  }

  double rounding() const { return scene_.made_from.start ? rounding_of_runs : rounding_of_lengths; }

  /// Impulses of time 0 may act along a rod, which passes them on. Velocities along it contradict it.
  /// `way`: m, from the other end to the body. `far`: m, the largest coordinate.
  void check_rod(const String& string, const Vec3& way, double far, const View& view, const std::string& name) {
    const Vec3& of_body = scene_.initial.velocity[string.body];
    const Vec3 of_other = string.other == no_entity ? Vec3(Vec3::Zero()) : scene_.initial.velocity[string.other];
    const double parting = (of_body - of_other).dot(way) / string.length;
    // The direction of the rod has the rounding of places, too.
    const double speeds = of_body.norm() + of_other.norm();  // m/s
    if (std::fabs(parting) <= (rounding_of_runs + rounding_of_lengths * far / string.length) * speeds) return;
    diagnostics_.add(view.place("rod"),
                     fmt::format("the ends of {} {} at {} m/s at time 0", in_backticks(name),
                                 parting > 0 ? "part" : "approach", shortest(std::fabs(parting))),
                     "a rod keeps its length: expected velocities across it, such as the same at both ends");
  }

  /// At time 0 (m). None: the body has an error.
  optional<Vec3> position_of(Entity body) const {
    if (bodies_are_good_) return scene_.initial.position[body];
    const vector<BodyEntry>& all = inventory_.bodies;
    const auto after = std::upper_bound(all.begin(), all.end(), body,
                                        [](Entity e, const BodyEntry& entry) { return e < entry.first; });
    const BodyEntry& entry = *(after - 1);
    return entry.group ? nullopt : entry.view.vector("position");
  }

  const Inventory& inventory_;
  Scene& scene_;
  Diagnostics& diagnostics_;
  bool bodies_are_good_;
};

}  // namespace

void decode_strings(const Inventory& inventory, Scene& scene, Diagnostics& diagnostics) {
  scene.world.strings.reserve(inventory.strings.size());
  for (const StringEntry& entry : inventory.strings) {
    const View& view = entry.view;
    if (!view.flag("visible").value_or(true)) scene.overlay.hidden_strings.push_back(scene.world.strings.size());
    String string = decode_string(view, inventory, diagnostics);
    EventDecoder events(inventory, scene, diagnostics);
    const WindowEnd until = events.end(view, "until", string.until);
    string.until = until.time;
    events.wait(TriggeredEnd::Of::string, scene.world.strings.size(), {0}, until);
    scene.world.strings.push_back(string);
    scene.roster.strings.push_back(entry.key->text);
  }
}

void decode_lengths(const Inventory& inventory, Scene& scene, Diagnostics& diagnostics) {
  Lengths(inventory, scene, diagnostics).run();
}

}  // namespace carom
