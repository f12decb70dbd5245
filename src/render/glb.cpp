// Builds an assimp scene from a Scene and its keyframes, and exports it as binary glTF 2.
// The exporter writes meshes, materials and animation. The functions of glb_nodes.h add cameras and lights, and correct
// nodes. Volumes of one shape and colour share a mesh of half size 1, scaled by the node.
#include "render/glb.h"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Exporter.hpp>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "physics/world.h"
#include "render/camera.h"
#include "render/glb_meshes.h"
#include "render/glb_nodes.h"
#include "render/lighting.h"
#include "render/render_error.h"
#include "render/still_things.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

/// Moves a vector's pointers to an array that assimp deletes.
template <typename Item, typename Count>
void hand_over(vector<Item*>& items, Item**& to, Count& count) {
  to = new Item*[items.size()];
  std::ranges::copy(items, to);
  count = static_cast<Count>(items.size());
  items.clear();
}

aiVector3D vector_of(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

// A matt surface that faces a light of intensity 1 has its own colour: pi W/m^2, and 683 lm/W.
constexpr double usual = std::numbers::pi * 683;  // lux

class GlbBuilder {
 public:
  GlbBuilder(const Scene& scene, const KeyedMotion& motion)
      : scene_(scene), motion_(motion), out_(make_unique<aiScene>()) {}

  string build() {
    for (const BodyRange& range : scene_.roster.bodies)
      for (Entity body = range.first; body < range.first + range.count; ++body) add_body(range, body);
    for (const StillThing& thing : still_things(scene_, motion_.extent, true)) add_still(thing);
    if (meshes_.empty()) throw RenderError("the scene has nothing to show in animation.glb");
    add_camera_and_lights();
    animate();
    return exported();
  }

 private:
  /// A free name for the camera or a light. A thing may already have the name.
  string free_name(const string& name) const {
    string free = name;
    const auto taken = [&](const GlbNode& node) { return node.name == free; };
    for (int i = 2; std::ranges::any_of(nodes_, taken); ++i) free = fmt::format("{} {}", name, i);
    return free;
  }

  void add_body(const BodyRange& range, Entity body) {
    const Volume volume = scene_.world.volume_of(body);
    GlbNode node{scene_.roster.name(body), scene_.initial.position[body]};
    node.meshes = range.mesh ? meshes_.file(*range.mesh, range.color) : meshes_.volume(volume.shape, range.color);
    if (!range.mesh) node.scale = volume.half;
    nodes_.push_back(std::move(node));
  }

  /// The corners are relative to the centre, so that they fit into floats.
  void add_still(const StillThing& thing) {
    Extent extent;
    for (const Vec3& vertex : thing.mesh.vertices) extent.include(vertex);
    GlbNode node{thing.name, 0.5 * (extent.low + extent.high)};
    node.meshes =
        meshes_.single(placed(thing.mesh, Vec3::Ones(), -node.translation), thing.color, thing.two_sided, thing.name);
    if (const Entity e = scene_.world.body_count() + static_cast<Entity>(thing.fixed); scene_.world.moves(e))
      moving_.emplace_back(nodes_.size(), e);
    nodes_.push_back(std::move(node));
  }

  /// The positions of a fixed thing that moves, at both ends of the film and where its velocity changes. They are
  /// linear in between. A plane moves along its normal, as its pattern does in pictures.
  aiNodeAnim* channel_of_fixed(size_t node, Entity fixed) const {
    const World& world = scene_.world;

    // A key wherever the thing's motion changes.
    vector<double> times{motion_.times.front()};
    for (const MotionLeg& leg : world.legs(fixed))
      if (leg.from > times.front() && leg.from < motion_.times.back()) times.push_back(leg.from);
    if (motion_.times.back() > times.back()) times.push_back(motion_.times.back());

    auto* channel = new aiNodeAnim;
    channel->mNodeName = exported_name(node);
    channel->mNumPositionKeys = static_cast<unsigned>(times.size());
    channel->mPositionKeys = new aiVectorKey[times.size()];

    for (size_t key = 0; key < times.size(); ++key) {
      Vec3 way = fixed_position(world, fixed, {times[key], 0}) - world.fixed_position(fixed);
      if (world.is_plane(fixed)) way = world.plane(fixed).normal.dot(way) * world.plane(fixed).normal;
      channel->mPositionKeys[key] = {times[key], vector_of(nodes_[node].translation + way)};
    }

    return channel;
  }

  void add_camera_and_lights() {
    const Camera camera = motion_.cameras.empty() ? camera_of(scene_) : motion_.cameras.front();
    const Size size = picture_size(scene_.output);
    const CameraFrame view = view_of(camera, size);

    camera_node_ = nodes_.size();
    GlbNode eye{free_name("camera"), camera.eye, rotation_of(camera)};
    eye.camera = GlbCamera{static_cast<double>(size.width) / size.height, view.fov_y * std::numbers::pi / 180,
                           camera.near, camera.far};
    nodes_.push_back(std::move(eye));

    for (const Light& light : scene_.lights) {
      if (light.direction) {
        add_sun(light.name, -light.direction->normalized(), linear(light.color), light.intensity);
      } else {
        // The light weakens with distance in glTF. Its brightness is right at the camera's target.
        const double distance2 = (camera.target - *light.position).squaredNorm();
        GlbNode node{free_name(light.name), *light.position};
        node.light = GlbLight{light.name, false, linear(light.color), usual * light.intensity * distance2};
        nodes_.push_back(std::move(node));
      }
    }

    if (scene_.lights.empty()) {
      const KeyLight light = default_light(view);
      add_sun("sun", light.towards, light.radiance, 1);
    }
  }

  /// Of the camera's node: it looks along its -z.
  array<double, 4> rotation_of(const Camera& camera) const {
    const CameraFrame view = view_of(camera, picture_size(scene_.output));
    return rotation_to(view.right, view.up, -view.forward);
  }

  void add_sun(const string& name, const Vec3& towards, const array<float, 3>& color, double intensity) {
    const Vec3 right = (std::abs(towards.y()) < 0.9 ? Vec3(0, 1, 0) : Vec3(1, 0, 0)).cross(towards).normalized();
    GlbNode node{free_name(name)};
    node.rotation = rotation_to(right, towards.cross(right), towards);
    node.light = GlbLight{name, true, color, usual * intensity};
    nodes_.push_back(std::move(node));
  }

  void animate() {
    const Entity bodies = scene_.world.body_count();
    const bool camera_moves = std::ranges::any_of(motion_.cameras, [&](const Camera& camera) {
      return camera.eye != motion_.cameras.front().eye || camera.target != motion_.cameras.front().target;
    });
    if (motion_.times.empty() || (bodies == 0 && !camera_moves && moving_.empty())) return;

    auto animation = make_unique<aiAnimation>();
    animation->mName = "motion";
    animation->mTicksPerSecond = 1;
    animation->mDuration = motion_.times.back();

    vector<vector<aiVectorKey>> scales(bodies);
    for (const KeyedMotion::Change& change : motion_.changes) add_scale(scales[change.body], change);

    vector<aiNodeAnim*> channels;
    for (Entity body = 0; body < bodies; ++body) {
      auto* channel = new aiNodeAnim;
      channels.push_back(channel);
      channel->mNodeName = exported_name(body);

      channel->mNumPositionKeys = static_cast<unsigned>(motion_.times.size());
      channel->mPositionKeys = new aiVectorKey[motion_.times.size()];
      for (size_t key = 0; key < motion_.times.size(); ++key) {
        const array<float, 3>& p = motion_.position[key * bodies + body];
        channel->mPositionKeys[key] = {motion_.times[key], {p[0], p[1], p[2]}};
      }

      channel->mNumScalingKeys = static_cast<unsigned>(scales[body].size());
      if (scales[body].empty()) continue;
      channel->mScalingKeys = new aiVectorKey[scales[body].size()];
      std::ranges::copy(scales[body], channel->mScalingKeys);
    }

    if (camera_moves) channels.push_back(camera_channel());
    for (const auto& [node, fixed] : moving_) channels.push_back(channel_of_fixed(node, fixed));

    hand_over(channels, animation->mChannels, animation->mNumChannels);
    vector<aiAnimation*> animations = {animation.release()};
    hand_over(animations, out_->mAnimations, out_->mNumAnimations);
  }

  /// The camera's position and direction at each keyframe.
  aiNodeAnim* camera_channel() const {
    const size_t keys = motion_.times.size();

    auto* channel = new aiNodeAnim;
    channel->mNodeName = exported_name(camera_node_);
    channel->mNumPositionKeys = channel->mNumRotationKeys = static_cast<unsigned>(keys);
    channel->mPositionKeys = new aiVectorKey[keys];
    channel->mRotationKeys = new aiQuatKey[keys];

    array<double, 4> before{};
    for (size_t key = 0; key < keys; ++key) {
      array<double, 4> q = rotation_of(motion_.cameras[key]);

      // q and -q are one rotation. Between two of one sign the turn is the shorter one.
      const double cosine = std::inner_product(q.begin(), q.end(), before.begin(), 0.0);
      if (cosine < 0)
        for (double& part : q) part = -part;

      channel->mPositionKeys[key] = {motion_.times[key], vector_of(motion_.cameras[key].eye)};
      channel->mRotationKeys[key] = {
          motion_.times[key],
          {static_cast<float>(q[3]), static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2])}};
      before = q;
    }

    return channel;
  }

  /// Adds a keyframe for the scale: a mesh grows as its volume does.
  void add_scale(vector<aiVectorKey>& keys, const KeyedMotion::Change& change) const {
    const Vec3& at_first = nodes_[change.body].scale;
    if (keys.empty()) keys.push_back({motion_.times.front(), vector_of(at_first)});
    const Vec3 grown = change.volume ? Vec3(change.volume->half.cwiseQuotient(scene_.world.volume_of(change.body).half))
                                     : Vec3(Vec3::Zero());
    const aiVectorKey key{motion_.times[change.key], vector_of(at_first.cwiseProduct(grown))};
    if (change.key == 0)
      keys.back() = key;
    else
      keys.push_back(key);
  }

  string exported() {
    out_->mRootNode = new aiNode("scene");
    vector<aiNode*> children;

    for (size_t i = 0; i < nodes_.size(); ++i) {
      auto* child = new aiNode(exported_name(i));
      children.push_back(child);
      child->mParent = out_->mRootNode;

      const vector<unsigned>& meshes = nodes_[i].meshes;
      if (meshes.empty()) continue;
      child->mNumMeshes = static_cast<unsigned>(meshes.size());
      child->mMeshes = new unsigned[meshes.size()];
      std::ranges::copy(meshes, child->mMeshes);
    }

    hand_over(children, out_->mRootNode->mChildren, out_->mRootNode->mNumChildren);
    meshes_.hand_over(*out_);

    Assimp::Exporter exporter;
    const aiExportDataBlob* blob = exporter.ExportToBlob(out_.get(), "glb2");
    if (blob == nullptr) throw RenderError(fmt::format("cannot make animation.glb: {}", exporter.GetErrorString()));
    return mended_glb({static_cast<const char*>(blob->data), blob->size}, scene_.title, nodes_);
  }

  const Scene& scene_;
  const KeyedMotion& motion_;
  unique_ptr<aiScene> out_;
  vector<GlbNode> nodes_;                     // the bodies first
  vector<std::pair<size_t, Entity>> moving_;  // nodes of fixed things that move
  size_t camera_node_ = 0;
  GlbMeshes meshes_;
};

}  // namespace

string glb(const Scene& scene, const KeyedMotion& motion) {
  return GlbBuilder(scene, motion).build();
}

}  // namespace carom
