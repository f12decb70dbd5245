// Bullet, in double precision, with these settings:
// - contacts only where bodies touch: gContactBreakingThreshold and m_linearSlop are 0
// - bounces at any speed: m_restitutionVelocityThreshold is 0
// - overlaps are pushed apart without speed: m_splitImpulse at every depth
// - no start from the impulses of the last step
// They are those of btContactSolverInfo.h and of Bullet's author in issue 3094 of bulletphysics/bullet3. Sweep and
// prune is faster here than the tree of boxes. Continuous collision detection changes nothing.
#include <btBulletDynamicsCommon.h>

#include <cmath>

#include "BulletCollision/NarrowPhaseCollision/btPersistentManifold.h"
#include "benchmark/peers/peer.h"
#include "physics/world.h"
#include "scene/scene.h"

namespace carom {
namespace {

btVector3 bullet_vector(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

constexpr double far = 100;  // m: the broad phase's space

class BulletWorld : public PeerWorld {
 public:
  BulletWorld(const Scene& scene, double step)
      : step_(step),
        broadphase_({-far, -far, -far}, {far, far, far}, static_cast<unsigned>(scene.world.mass.size()) + 100) {
    gContactBreakingThreshold = 0;
    world_.setGravity(bullet_vector(scene.world.gravity));
    btContactSolverInfo& solver = world_.getSolverInfo();
    solver.m_restitutionVelocityThreshold = 0;
    solver.m_splitImpulse = 1;
    solver.m_splitImpulsePenetrationThreshold = 0;
    solver.m_linearSlop = 0;
    solver.m_numIterations = 20;
    solver.m_solverMode &= ~SOLVER_USE_WARMSTARTING;

    const double e = std::sqrt(common_restitution(scene));  // a pair's is the product
    for (const Plane& plane : scene.world.planes)
      add(std::make_unique<btStaticPlaneShape>(bullet_vector(plane.normal), plane.point.dot(plane.normal)), 0,
          Vec3::Zero(), Vec3::Zero(), e);

    first_ = bodies_.size();
    for (std::size_t i = 0; i < scene.world.mass.size(); ++i)
      add(std::make_unique<btSphereShape>(scene.world.radius[i]), scene.world.mass[i], scene.initial.position[i],
          scene.initial.velocity[i], e);
  }
  ~BulletWorld() override {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }

  void advance(int steps) override {
    for (int k = 0; k < steps; ++k) world_.stepSimulation(step_, 0);
  }

  void read(State& state) override {
    for (std::size_t i = 0; i < state.position.size(); ++i) {
      const btRigidBody& body = *bodies_[first_ + i];
      const btVector3 &x = body.getWorldTransform().getOrigin(), &v = body.getLinearVelocity();
      state.position[i] = {x.x(), x.y(), x.z()};
      state.velocity[i] = {v.x(), v.y(), v.z()};
    }
  }

 private:
  void add(std::unique_ptr<btCollisionShape> shape, double mass, const Vec3& x, const Vec3& v, double e) {
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape.get());  // without inertia it does not turn
    info.m_startWorldTransform.setIdentity();
    info.m_startWorldTransform.setOrigin(bullet_vector(x));
    info.m_friction = 0;
    info.m_restitution = e;

    auto body = std::make_unique<btRigidBody>(info);
    body->setLinearVelocity(bullet_vector(v));
    body->setActivationState(DISABLE_DEACTIVATION);
    body->setContactProcessingThreshold(0);

    world_.addRigidBody(body.get());
    shapes_.push_back(std::move(shape));
    bodies_.push_back(std::move(body));
  }

  const double step_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  bt32BitAxisSweep3 broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;  // the planes, then the balls
  std::size_t first_ = 0;                             // ball
};

}  // namespace

Peer bullet() {
  return {"Bullet", CAROM_PEER_BULLET, {60, 240, 960, 3840}, 240, [](const Scene& scene, double step) {
            return std::make_unique<BulletWorld>(scene, step);
          }};
}

}  // namespace carom
