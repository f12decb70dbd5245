// ODE. Settings, by the sections of its manual:
// - bounces at any speed (Contact: bounce_vel 0)
// - hard contacts (World: CFM 0, contact surface layer 0)
// - dWorldQuickStep (Stepping Functions)
// dWorldStep finds no solution for a row of touching balls. Its time grows as the cube of a pile's contacts.
#include <ode/ode.h>

#include "benchmark/peers/peer.h"
#include "physics/world.h"
#include "scene/scene.h"

namespace carom {
namespace {

class OdeWorld : public PeerWorld {
 public:
  OdeWorld(const Scene& scene, double step) : step_(step), restitution_(common_restitution(scene)) {
    dInitODE2(0);
    world_ = dWorldCreate();
    space_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
    planes_ = dSimpleSpaceCreate(nullptr);
    contacts_ = dJointGroupCreate(0);

    const Vec3& g = scene.world.gravity;
    dWorldSetGravity(world_, g.x(), g.y(), g.z());
    dWorldSetCFM(world_, 0);
    dWorldSetContactSurfaceLayer(world_, 0);
    dWorldSetAutoDisableFlag(world_, 0);
    dWorldSetQuickStepNumIterations(world_, 20);

    for (const Plane& plane : scene.world.planes) {
      const Vec3& n = plane.normal;
      dCreatePlane(planes_, n.x(), n.y(), n.z(), n.dot(plane.point));
    }

    for (std::size_t i = 0; i < scene.world.mass.size(); ++i) {
      const Vec3 &x = scene.initial.position[i], &v = scene.initial.velocity[i];
      const dBodyID body = dBodyCreate(world_);
      dMass mass;
      dMassSetSphereTotal(&mass, scene.world.mass[i], scene.world.radius[i]);

      dBodySetMass(body, &mass);
      dBodySetPosition(body, x.x(), x.y(), x.z());
      dBodySetLinearVel(body, v.x(), v.y(), v.z());
      dGeomSetBody(dCreateSphere(space_, scene.world.radius[i]), body);
      bodies_.push_back(body);
    }
  }
  ~OdeWorld() override {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dSpaceDestroy(planes_);
    dWorldDestroy(world_);
    dCloseODE();
  }

  void advance(int steps) override {
    for (int k = 0; k < steps; ++k) {
      dSpaceCollide(space_, this, add_contact);
      dSpaceCollide2(reinterpret_cast<dGeomID>(space_), reinterpret_cast<dGeomID>(planes_), this, add_contact);
      dWorldQuickStep(world_, step_);
      dJointGroupEmpty(contacts_);
    }
  }

  void read(State& state) override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const dReal *x = dBodyGetPosition(bodies_[i]), *v = dBodyGetLinearVel(bodies_[i]);
      state.position[i] = {x[0], x[1], x[2]};
      state.velocity[i] = {v[0], v[1], v[2]};
    }
  }

 private:
  static void add_contact(void* self, dGeomID a, dGeomID b) {
    OdeWorld& world = *static_cast<OdeWorld*>(self);
    dContact contact{};
    if (dCollide(a, b, 1, &contact.geom, sizeof(dContact)) == 0) return;
    contact.surface.mode = dContactBounce;
    contact.surface.bounce = world.restitution_;
    contact.surface.bounce_vel = 0;
    contact.surface.mu = 0;
    dJointAttach(dJointCreateContact(world.world_, world.contacts_, &contact), dGeomGetBody(a), dGeomGetBody(b));
  }

  const double step_, restitution_;
  dWorldID world_;
  dSpaceID space_, planes_;
  dJointGroupID contacts_;
  std::vector<dBodyID> bodies_;
};

}  // namespace

Peer ode() {
  return {"ODE", CAROM_PEER_ODE, {60, 240, 960, 3840}, 240, [](const Scene& scene, double step) {
            return std::make_unique<OdeWorld>(scene, step);
          }};
}

}  // namespace carom
