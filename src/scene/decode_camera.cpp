// Decodes the camera: still, going with bodies, on a path, or framing the motion. The checks here are those of lines of
// sight: a camera that looks along its up direction has no defined roll. Between keyframes the line of sight is a cubic
// in time, so that its distance from the up direction is known for every instant.
#include <fmt/format.h>

#include "numerics/monotone_path.h"
#include "numerics/polynomial.h"
#include "physics/center_of_mass.h"
#include "scene/decode.h"
#include "scene/fields.h"
#include "scene/member.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

/// The sine of the smallest allowed angle between the line of sight and the up direction.
constexpr double least_sine = 1e-9;

using Cubic = array<double, 4>;

void add_square(Polynomial& sum, const Cubic& c) {
  for (size_t i = 0; i < c.size(); ++i)
    for (size_t j = 0; j < c.size(); ++j) sum.c[i + j] += c[i] * c[j];
}

double value(const Cubic& c, double s) {
  return c[0] + s * (c[1] + s * (c[2] + s * c[3]));
}

/// The part of a piece of a path, from 0 to 1, at which target less eye comes to lie along the unit vector `up`. None:
/// it never does.
optional<double> touches(const array<Cubic, 3>& eye, const array<Cubic, 3>& target, const Vec3& up) {
  array<Cubic, 3> sight{}, across{};  // across: sight x up
  for (size_t i = 0; i < 3; ++i)
    for (size_t power = 0; power < 4; ++power) sight[i][power] = target[i][power] - eye[i][power];

  // The square of the distance of the line of sight from `up`.
  Polynomial distance2;
  distance2.degree = 6;
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3, k = (i + 2) % 3;
    for (size_t power = 0; power < 4; ++power)
      across[i][power] = sight[j][power] * up[int(k)] - sight[k][power] * up[int(j)];
    add_square(distance2, across[i]);
  }

  const auto at = [](const array<Cubic, 3>& of, double s) {
    return Vec3(value(of[0], s), value(of[1], s), value(of[2], s));
  };
  const double length = max(at(sight, 0).norm(), at(sight, 1).norm());
  // The distance itself from its vector: the polynomial of its square cancels.
  const Roots turning = roots_between(distance2.derivative(), 0, 1);

  for (int i = 0; i < turning.count; ++i) {
    const double s = turning.at[size_t(i)];
    if (!(at(across, s).norm() > least_sine * length)) return s;
  }
  return nullopt;
}

class CameraDecoder {
 public:
  CameraDecoder(const Node& root, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics)
      : inventory_(inventory),
        scene_(scene),
        diagnostics_(diagnostics),
        view_(scene_part(root, "camera")),
        keys_(filled<CameraKeys>(view_)),
        plan_(keys_) {}

  void run() {
    const Node* path = view_.given("path");
    plan_.orthographic = keys_.orthographic;
    if (keys_.orbit) plan_.orbit = keys_.orbit->period;
    // A round or a projection alone is one of the camera that frames the motion.
    const array others = {"eye", "target", "path", "follow"};
    plan_.fit = keys_.fit || ranges::none_of(others, [&](const char* key) { return view_.given(key) != nullptr; });
    if (keys_.fit && keys_.fit->on != nullptr) fit_on(*keys_.fit->on);

    if (keys_.follow != nullptr) {
      follow(*keys_.follow);
    } else if (path != nullptr && path->is_sequence()) {
      for (const Node& node : path->items) add_keyframe(node);
      check_between(path->items);
    } else if (view_.vector("eye") && view_.vector("target")) {
      check_sight(plan_.eye, plan_.target, view_);
    }
    check_depth();
    scene_.camera = plan_;
  }

 private:
  void fit_on(const Node& names) {
    if (names.bad) return;
    for (const Node& name : names.items) {
      const auto range = find_range(name, inventory_, Sought::anything, diagnostics_);
      if (!range || !inventory_.fits) continue;

      const World& world = scene_.world;
      const bool is_string = diagnostics_.empty() && range->first >= world.body_count() + world.fixed_count();
      if (range->count == 0 || is_string) {
        diagnostics_.add(name.place,
                         fmt::format("{} {}: there is nothing to frame", in_backticks(name.text),
                                     is_string ? fmt::format("is {}", inventory_.word_for(*range)) : "has no members"),
                         "expected balls, bodies, groups, members (gas.3) or fixed things");
        continue;
      }

      for (Entity i = 0; i < range->count; ++i) plan_.fit_on.push_back(range->first + i);
    }

    ranges::sort(plan_.fit_on);
    plan_.fit_on.erase(std::unique(plan_.fit_on.begin(), plan_.fit_on.end()), plan_.fit_on.end());
  }

  void follow(const Node& name) {
    const auto range = find_range(name, inventory_, Sought::bodies, diagnostics_);
    if (!range || !inventory_.fits) return;
    if (range->first >= inventory_.body_count || range->count == 0) {
      diagnostics_.add(
          name.place,
          fmt::format("{} {}: there is nothing to follow", in_backticks(name.text),
                      range->count == 0 ? "has no balls" : fmt::format("is {}", inventory_.word_for(*range))),
          "expected a ball, body, group or member (gas.3)");
      return;
    }
    const bool has_eye = view_.given("eye") != nullptr;
    plan_.follow = {range->first, range->count, has_eye};
    // Positions are right only in a scene without errors.
    if (!diagnostics_.empty()) return;
    if (view_.given("target") == nullptr)
      plan_.target = center_of_mass(scene_.world, range->first, range->count, scene_.initial.position);
    if (has_eye) check_sight(plan_.eye, plan_.target, view_);
  }

  void add_keyframe(const Node& node) {
    const View view(&node, kind_named("keyframe"), node.place);
    const auto keys = filled<KeyframeKeys>(view);
    if (!keys.eye || !keys.target || !view.number("at")) return;
    if (!plan_.path.empty() && !(keys.at > plan_.path.back().at))
      diagnostics_.add(view.place("at"),
                       fmt::format("{} s is not later than the keyframe before, at {} s", shortest(keys.at),
                                   shortest(plan_.path.back().at)),
                       "expected ascending times");
    check_sight(*keys.eye, *keys.target, view);
    plan_.path.push_back({keys.at, *keys.eye, *keys.target, keys.fov.value_or(plan_.fov)});
  }

  /// `view`: the map with eye and target.
  void check_sight(const Vec3& eye, const Vec3& target, const View& view) {
    const Vec3 sight = target - eye;
    const bool said = view_.given("up") != nullptr;
    if (sight.isZero(0)) {
      diagnostics_.add(view.place("target"), "the camera's target is where its eye is", "expected a point to look at");
    } else if (unit(sight).cross(unit(plan_.up)).norm() < least_sine) {
      diagnostics_.add(
          (said ? view_ : view).place(said ? "up" : "target"), "the camera looks along its up direction",
          said ? "expected another direction" : "expected `up` across the line of sight, such as up: [0, 0, 1]");
    }
  }

  /// The pieces between the keyframes that `nodes` give.
  void check_between(const vector<Node>& nodes) {
    if (!diagnostics_.empty()) return;

    vector<double> at;
    vector<Vec3> eye, target;
    for (const Keyframe& key : plan_.path) {
      at.push_back(key.at);
      eye.push_back(key.eye);
      target.push_back(key.target);
    }

    const MonotonePath eyes(at, eye), targets(at, target);
    for (size_t i = 0; i + 1 < at.size(); ++i) {
      const optional<double> s = touches(eyes.piece(i), targets.piece(i), unit(plan_.up));
      if (!s) continue;

      diagnostics_.add(nodes[i + 1].place,
                       fmt::format("on the way to this keyframe, at {:.4g} s, the camera looks along its up direction",
                                   at[i] + *s * (at[i + 1] - at[i])),
                       "the picture would turn over: expected a keyframe between the two, beside that direction");
    }
  }

  void check_depth() {
    if (!view_.number("near") || !view_.number("far") || plan_.near < plan_.far) return;
    diagnostics_.add(view_.place(view_.given("far") != nullptr ? "far" : "near"),
                     fmt::format("far ({}) is not beyond near ({})", shortest(plan_.far), shortest(plan_.near)),
                     "expected near < far");
  }

  const Inventory& inventory_;
  Scene& scene_;
  Diagnostics& diagnostics_;
  View view_;
  CameraKeys keys_;
  CameraPlan plan_;
};

}  // namespace

void decode_camera(const Node& root, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics) {
  if (root.find("camera") != nullptr) CameraDecoder(root, inventory, scene, diagnostics).run();
}

}  // namespace carom
