// Box2D, which is two-dimensional, for scenes whose balls stay in z = 0. Settings: bounces at any speed (fixtures'
// restitutionThreshold 0); lines lie deeper by b2_polygonRadius, the skin that Box2D adds to them.
#include <box2d/box2d.h>

#include "benchmark/peers/peer.h"
#include "physics/world.h"
#include "scene/scene.h"

namespace carom {
namespace {

b2Vec2 flat(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y())};
}

class Box2dWorld : public PeerWorld {
 public:
  Box2dWorld(const Scene& scene, double step) : step_(static_cast<float>(step)), world_(flat(scene.world.gravity)) {
    world_.SetAllowSleeping(false);
    b2FixtureDef fixture;
    fixture.friction = 0;
    fixture.restitution = static_cast<float>(common_restitution(scene));
    fixture.restitutionThreshold = 0;

    b2BodyDef fixed;
    b2Body* ground = world_.CreateBody(&fixed);

    for (const Plane& plane : scene.world.planes) {
      const double half_length = 50;  // m
      const Vec3 middle = plane.point - b2_polygonRadius * plane.normal;
      const Vec3 along = half_length * plane.normal.cross(Vec3(0, 0, 1));
      b2EdgeShape line;
      line.SetTwoSided(flat(middle - along), flat(middle + along));
      fixture.shape = &line;
      ground->CreateFixture(&fixture);
    }

    for (std::size_t i = 0; i < scene.world.mass.size(); ++i) {
      b2BodyDef ball;
      ball.type = b2_dynamicBody;
      ball.position = flat(scene.initial.position[i]);
      ball.linearVelocity = flat(scene.initial.velocity[i]);
      ball.fixedRotation = true;

      b2CircleShape circle;
      circle.m_radius = static_cast<float>(scene.world.radius[i]);
      fixture.shape = &circle;
      fixture.density = 1;

      b2Body* body = world_.CreateBody(&ball);
      body->CreateFixture(&fixture);

      b2MassData mass{static_cast<float>(scene.world.mass[i]), {0, 0}, 0};
      body->SetMassData(&mass);
      bodies_.push_back(body);
    }
  }

  void advance(int steps) override {
    for (int k = 0; k < steps; ++k) world_.Step(step_, 20, 10);
  }

  void read(State& state) override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const b2Vec2 x = bodies_[i]->GetPosition(), v = bodies_[i]->GetLinearVelocity();
      state.position[i] = {x.x, x.y, 0};
      state.velocity[i] = {v.x, v.y, 0};
    }
  }

 private:
  const float step_;
  b2World world_;
  std::vector<b2Body*> bodies_;
};

bool is_flat(const Scene& scene) {
  for (const Vec3& x : scene.initial.position)
    if (x.z() != 0) return false;
  return true;
}

}  // namespace

Peer box2d() {
  return {"Box2D",
          CAROM_PEER_BOX2D,
          {60, 240, 960, 3840},
          240,
          [](const Scene& scene, double step) -> std::unique_ptr<PeerWorld> {
            if (!is_flat(scene)) return nullptr;
            return std::make_unique<Box2dWorld>(scene, step);
          }};
}

}  // namespace carom
