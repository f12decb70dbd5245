// Collects the nodes of a glTF file, and its animation from the keyframes. Volumes of one shape and colour share a mesh
// of half size 1, scaled by the node.
#include "render/glb.h"

#include <fmt/format.h>

#include <numbers>

#include "physics/world_now.h"
#include "render/camera.h"
#include "render/eye.h"
#include "render/glb_file.h"
#include "render/glb_meshes.h"
#include "render/lighting.h"
#include "render/parallel.h"
#include "render/renderer.h"
#include "render/still_things.h"
#include "render/surfaces.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

using Json = nlohmann::ordered_json;

// A matt surface that faces a light of intensity 1 has its own colour: pi W/m^2, and 683 lm/W.
constexpr double usual = std::numbers::pi * 683;  // lux

constexpr const char* lights_extension = "KHR_lights_punctual";

/// The rotation with these axes x, y, z, which are orthogonal unit vectors.
Eigen::Quaterniond rotation_to(const Vec3& x, const Vec3& y, const Vec3& z) {
  return Eigen::Quaterniond((Eigen::Matrix3d() << x, y, z).finished());
}

array<float, 4> xyzw(const Eigen::Quaterniond& q) {
  return {float(q.x()), float(q.y()), float(q.z()), float(q.w())};
}

class GlbBuilder {
 public:
  GlbBuilder(const Scene& scene, const KeyedMotion& motion) : scene_(scene), motion_(motion) {}

  string build() {
    for (const BodyRange& range : scene_.roster.bodies)
      for (Entity body = range.first; body < range.first + range.count; ++body) add_body(range, body);
    for (const StillThing& thing : still_things(scene_, motion_.extent, true)) add_still(thing);
    if (nodes().empty()) throw RenderError("the scene has nothing to show in animation.glb");
    add_camera();
    add_lights();
    if (!motion_.times.empty()) animate();

    // The root.
    Json children = Json::array();
    for (size_t node = 0; node < nodes().size(); ++node) children.push_back(node);
    const size_t root = file_.add("nodes", {{"name", "scene"}, {"children", std::move(children)}});
    file_.json()["scene"] = file_.add("scenes", {{"name", scene_.title}, {"nodes", {root}}});
    return file_.finished();
  }

 private:
  Json& nodes() { return file_.json()["nodes"]; }

  /// A free name for the camera or a light. A thing may already have the name.
  string free_name(const string& name) {
    string free = name;
    const auto taken = [&](const Json& node) { return node["name"] == free; };
    for (int i = 2; any_of(nodes(), taken); ++i) free = fmt::format("{} {}", name, i);
    return free;
  }

  void add_body(const BodyRange& range, Entity body) {
    const Volume volume = scene_.world.volume_of(body);
    const double radius = scene_.world.radius[body];
    first_scales_.push_back(range.mesh ? Vec3(Vec3::Constant(range.mesh->scale_for(radius) / range.mesh->scale))
                                       : volume.half);
    const Coat coat{range.color, range.surface};
    file_.add("nodes", {{"name", scene_.roster.name(body)},
                        {"mesh", range.mesh ? meshes_.file(*range.mesh, coat) : meshes_.volume(volume.shape, coat)},
                        {"translation", floats(scene_.initial.position[body])},
                        {"scale", floats(first_scales_.back())}});
  }

  /// The corners are relative to the centre, so that they fit into floats.
  void add_still(const StillThing& thing) {
    Extent extent;
    for (const Vec3& vertex : thing.mesh.vertices) extent.include(vertex);
    const Vec3 middle = extent.middle();
    const Mesh mesh = placed(thing.mesh, Vec3::Ones(), -middle);
    const Coat coat{thing.color, look_of_fixed(scene_, thing.fixed).surface};
    const size_t node = file_.add("nodes", {{"name", thing.name},
                                            {"mesh", meshes_.single(mesh, coat, thing.two_sided, thing.name)},
                                            {"translation", floats(middle)}});
    if (const Entity e = scene_.world.body_count() + Entity(thing.fixed); scene_.world.moves(e))
      moving_.push_back({node, e, middle});
  }

  void add_camera() {
    const CameraFrame view = view_of(camera_, size_);
    const size_t number = file_.add("cameras", parallel() ? orthographic(view) : perspective(view));
    camera_node_ = file_.add("nodes", {{"name", free_name("camera")},
                                       {"translation", floats(eye_of(camera_))},
                                       {"rotation", xyzw(rotation_of(camera_))},
                                       {"camera", number}});
  }

  bool parallel() const { return scene_.camera && scene_.camera->orthographic; }

  /// The place of the camera's node. Programs know parallel projections, which need no eye far away.
  Vec3 eye_of(const Camera& camera) const { return parallel() ? from_near(camera).eye : camera.eye; }

  Json perspective(const CameraFrame& view) const {
    return {{"type", "perspective"},
            {"perspective",
             {{"yfov", float(view.fov_y * std::numbers::pi / 180)},
              {"aspectRatio", float(size_.width) / float(size_.height)},
              {"zfar", float(camera_.far)},
              {"znear", float(camera_.near)}}}};
  }

  Json orthographic(const CameraFrame& view) const {
    const Camera near = from_near(camera_);
    const double distance = (camera_.target - camera_.eye).norm();
    const auto half = [&](double angle) { return float(distance * std::tan(angle * std::numbers::pi / 360)); };
    return {{"type", "orthographic"},
            {"orthographic",
             {{"xmag", half(view.fov_x)},
              {"ymag", half(view.fov_y)},
              {"zfar", float(near.far)},
              {"znear", float(max(near.near, 0.0))}}}};
  }

  /// Of the camera's node: it looks along its -z.
  Eigen::Quaterniond rotation_of(const Camera& camera) const {
    const CameraFrame view = view_of(camera, size_);
    return rotation_to(view.right, view.up, -view.forward);
  }

  void add_lights() {
    for (const Light& light : scene_.lights) {
      if (light.direction) {
        add_sun(light.name, -light.direction->normalized(), linear(light.color), light.intensity);
      } else {
        // The light weakens with distance in glTF. Its brightness is right at the camera's target.
        const double distance2 = (camera_.target - *light.position).squaredNorm();
        add_light(light.name, "point", linear(light.color), light.intensity * distance2,
                  {{"translation", floats(*light.position)}});
      }
    }
    if (!scene_.lights.empty()) return;
    const KeyLight light = default_light(scene_.look, view_of(camera_, size_));
    add_sun("sun", light.towards, light.radiance, 1);
  }

  /// It shines along the -z of its node.
  void add_sun(const string& name, const Vec3& towards, const array<float, 3>& color, double intensity) {
    const Vec3 right = (std::abs(towards.y()) < 0.9 ? Vec3(0, 1, 0) : Vec3(1, 0, 0)).cross(towards).normalized();
    add_light(name, "directional", color, intensity,
              {{"rotation", xyzw(rotation_to(right, towards.cross(right), towards))}});
  }

  /// `node`: where its node is, or how it is turned.
  void add_light(const string& name, const char* type, const array<float, 3>& color, double intensity, Json node) {
    file_.json()["extensionsUsed"] = {lights_extension};
    Json& lights = file_.json()["extensions"][lights_extension]["lights"];
    node["name"] = free_name(name);
    node["extensions"][lights_extension]["light"] = lights.size();
    file_.add("nodes", std::move(node));
    // Lux, or candela.
    lights.push_back({{"name", name}, {"type", type}, {"color", color}, {"intensity", float(usual * intensity)}});
  }

  void animate() {
    const Entity bodies = scene_.world.body_count();
    for (Entity body = 0; body < bodies; ++body) {
      vector<array<float, 3>> places;
      for (size_t key = 0; key < motion_.times.size(); ++key) places.push_back(motion_.position[key * bodies + body]);
      add_channel(body, "translation", motion_.times, places);
    }
    animate_scales();

    // The camera, and fixed things, if they move.
    const auto moved = [&](const Camera& camera) {
      return camera.eye != camera_.eye || camera.target != camera_.target;
    };
    if (any_of(motion_.cameras, moved)) animate_camera();
    for (const MovingThing& thing : moving_) animate_thing(thing);

    if (!channels_.empty())
      file_.add("animations", {{"name", "motion"}, {"channels", channels_}, {"samplers", samplers_}});
  }

  template <size_t width>
  void add_channel(size_t node, const char* path, const vector<double>& times, const vector<array<float, width>>& rows,
                   const char* interpolation = "LINEAR") {
    const auto [known, is_new] = times_.try_emplace(times);
    if (is_new) {
      vector<array<float, 1>> seconds;
      for (const double time : times) seconds.push_back({float(time)});
      known->second = file_.add_rows(seconds, GlbFile::Use::data);
    }
    channels_.push_back({{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers_.push_back({{"input", known->second},
                         {"interpolation", interpolation},
                         {"output", file_.add_rows(rows, GlbFile::Use::data)}});
  }

  /// A mesh grows in steps, as its volume does.
  void animate_scales() {
    struct Steps {
      vector<double> times;
      vector<array<float, 3>> scales;
    };
    map<Entity, Steps> steps;

    for (const KeyedMotion::Change& change : motion_.changes) {
      const Vec3& first = first_scales_[change.body];
      auto& [times, scales] = steps[change.body];
      if (times.empty() && change.key > 0) times = {motion_.times.front()}, scales = {floats(first)};

      Vec3 scale = Vec3::Zero();
      if (change.volume)
        scale = first.cwiseProduct(change.volume->half.cwiseQuotient(scene_.world.volume_of(change.body).half));
      times.push_back(motion_.times[change.key]);
      scales.push_back(floats(scale));
    }
    for (const auto& [body, of] : steps) add_channel(body, "scale", of.times, of.scales, "STEP");
  }

  /// The camera's position and direction at each keyframe.
  void animate_camera() {
    vector<array<float, 3>> places;
    vector<array<float, 4>> turns;
    Eigen::Quaterniond before = rotation_of(camera_);
    for (const Camera& camera : motion_.cameras) {
      Eigen::Quaterniond turn = rotation_of(camera);
      // q and -q are one rotation. Between two of one sign the turn is the shorter one.
      if (turn.dot(before) < 0) turn.coeffs() *= -1;
      places.push_back(floats(eye_of(camera)));
      turns.push_back(xyzw(turn));
      before = turn;
    }
    add_channel(camera_node_, "translation", motion_.times, places);
    add_channel(camera_node_, "rotation", motion_.times, turns);
  }

  struct MovingThing {
    size_t node;
    Entity fixed;
    Vec3 middle;  // m, at time 0
  };

  /// Its positions at both ends of the film, where its velocity jumps, and along a swing. They are linear in between. A
  /// plane moves along its normal, as its pattern does in pictures.
  void animate_thing(const MovingThing& thing) {
    const World& world = world_.at(motion_.fired);
    const double start = motion_.times.front(), end = motion_.times.back();
    // Of motions that repeat too often for keyframes of their own, the pictures have some.
    const SurfaceMotion& moves = world.motion(thing.fixed);
    const double period = moves.swing ? moves.swing->period : moves.every;
    const bool many = (end - start) / period > 1000;
    const vector<double> times = many ? motion_.times : key_times(moves, start, end);

    vector<array<float, 3>> places;
    for (const double time : times) {
      Vec3 way = fixed_position(world, thing.fixed, {time, 0}) - world.fixed_position(thing.fixed);
      if (world.is_plane(thing.fixed)) way = world.plane(thing.fixed).normal.dot(way) * world.plane(thing.fixed).normal;
      places.push_back(floats(thing.middle + way));
    }
    add_channel(thing.node, "translation", times, places);
  }

  const Scene& scene_;
  const KeyedMotion& motion_;
  WorldNow world_{scene_.world};
  const Size size_ = picture_size(scene_.output);
  const Camera camera_ = motion_.cameras.empty() ? camera_of(scene_) : motion_.cameras.front();
  GlbFile file_;
  GlbMeshes meshes_{file_};
  vector<Vec3> first_scales_;  // by body, whose node has the same number
  vector<MovingThing> moving_;
  size_t camera_node_ = 0;
  Json channels_ = Json::array(), samplers_ = Json::array();
  map<vector<double>, size_t> times_;  // accessors
};

}  // namespace

string glb(const Scene& scene, const KeyedMotion& motion) {
  return GlbBuilder(scene, motion).build();
}

}  // namespace carom
