#include <stdexcept>

#include "benchmark/peers/peer.h"
#include "physics/world.h"
#include "scene/scene.h"

namespace carom {

std::vector<Peer> all_peers() {
  // A peer that is not installed has a name only.
  return {
      carom_exact(),
#ifdef CAROM_PEER_BULLET
      bullet(),
#else
      {"Bullet", ""},
#endif

#ifdef CAROM_PEER_ODE
      ode(),
#else
      {"ODE", ""},
#endif
#ifdef CAROM_PEER_MUJOCO
      mujoco(),
#else
      {"MuJoCo", ""},
#endif

#ifdef CAROM_PEER_LAMMPS
      lammps(),
#else
      {"LAMMPS", ""},
#endif
#ifdef CAROM_PEER_BOX2D
      box2d(),
#else
      {"Box2D", ""},
#endif
  };
}

double common_restitution(const Scene& scene) {
  const double e = scene.world.restitution.front();
  for (double other : scene.world.restitution)
    if (other != e) throw std::logic_error("peers are given one restitution");
  for (const Plane& plane : scene.world.planes)
    if (plane.restitution.value_or(e) != e) throw std::logic_error("peers are given one restitution");
  return e;
}

}  // namespace carom
