#pragma once
// A peer: a way to move balls among planes, carom's own or another library's, behind the few calls that the benchmark
// needs. Balls of one mass, radius and restitution, planes and gravity are taken from a Scene; nothing has friction or
// damping, turns or is put to sleep.
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace carom {

/// A scene at work in a peer.
class PeerWorld {
 public:
  virtual ~PeerWorld() = default;
  virtual void advance(int steps) = 0;
  /// Positions and velocities of all bodies; both arrays are there already.
  virtual void read(State& state) = 0;
  /// So far; 0: not counted.
  virtual std::uint64_t collisions() const { return 0; }
};

struct Peer {
  std::string name;
  std::string version;             // empty: not installed
  std::vector<int> steps_per_s{};  // the steps that it is tried with, 60 times powers of two; none: it needs no steps
  int usual = 0;                   // the one of them that its users take

  /// The scene at time 0, to be moved in steps of `step` (s). A null pointer: the scene is beyond the peer. The scene
  /// must outlive what is made.
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

/// The restitution that all impacts of the scene have: peers combine those of two bodies each in its own way.
double common_restitution(const Scene& scene);

}  // namespace carom
