#pragma once
// A peer: a simulator of balls among planes, carom or another library, behind the calls that the benchmark needs. A
// Scene supplies balls of one mass, radius and restitution, planes and gravity. Nothing has friction or damping, turns
// or is put to sleep.
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace carom {

/// A scene loaded in a peer.
class PeerWorld {
 public:
  virtual ~PeerWorld() = default;
  virtual void advance(int steps) = 0;
  /// Positions and velocities of all bodies; both arrays have their size already.
  virtual void read(State& state) = 0;
  /// So far; 0: not counted.
  virtual std::uint64_t collisions() const { return 0; }
};

struct Peer {
  std::string name;
  std::string version;             // empty: not installed
  std::vector<int> steps_per_s{};  // its steps, 60 times powers of two; none: it needs no steps
  int usual = 0;                   // the usual one of these

  /// The scene at time 0, to be moved in steps of `step` (s). A null pointer: the peer does not support the scene. The
  /// scene must outlive the result.
  std::function<std::unique_ptr<PeerWorld>(const Scene& scene, double step)> make{};
};

Peer carom_exact();
Peer bullet();
Peer ode();
Peer mujoco();
Peer lammps();
Peer box2d();

/// All of them, in the order of the tables.
std::vector<Peer> all_peers();

/// The common restitution of all impacts of the scene: each peer combines coefficients in its own way.
double common_restitution(const Scene& scene);

}  // namespace carom
