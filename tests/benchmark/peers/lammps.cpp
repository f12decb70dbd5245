// LAMMPS with granular spheres: pair style gran/hooke and fix wall/gran, springs whose contact lasts so many steps.
// They need far shorter steps than rigid-body engines, and far less time for each. Planes lie across an axis.
#include <fmt/format.h>
#include <lammps/library.h>

#include <array>
#include <utility>

#include "benchmark/peers/peer.h"
#include "benchmark/peers/soft.h"
#include "physics/world.h"
#include "scene/scene.h"

namespace carom {
namespace {

class LammpsWorld : public PeerWorld {
 public:
  LammpsWorld(const Scene& scene, double step) : balls_(scene.world.mass.size()) {
    std::array<const char*, 8> words{"carom", "-log", "none", "-screen", "none", "-nocite", "-suffix", "off"};
    lammps_ = lammps_open_no_mpi(static_cast<int>(words.size()), const_cast<char**>(words.data()), nullptr);
    const World& world = scene.world;
    const double radius = world.radius.front(), mass = world.mass.front();  // of all

    const SoftContact contact = contact_of(common_restitution(scene), true, step, balls_);
    Vec3 low = scene.initial.position.front(), high = low;
    for (const Vec3& x : scene.initial.position) low = low.cwiseMin(x), high = high.cwiseMax(x);
    low -= Vec3::Constant(2 * radius);
    high += Vec3::Constant(2 * radius);

    execute("units si");
    execute("atom_style sphere");
    execute("atom_modify map array");
    execute("boundary m m m");
    execute("newton off");
    execute("comm_modify vel yes");
    execute(fmt::format("region all block {} {} {} {} {} {}", low.x(), high.x(), low.y(), high.y(), low.z(), high.z()));
    execute("create_box 1 all");

    std::vector<int> type(balls_, 1);
    std::vector<double> x, v;
    for (const Vec3& p : scene.initial.position) x.insert(x.end(), p.begin(), p.end());
    for (const Vec3& p : scene.initial.velocity) v.insert(v.end(), p.begin(), p.end());
    lammps_create_atoms(lammps_, static_cast<int>(balls_), nullptr, type.data(), x.data(), v.data(), nullptr, 0);

    execute(fmt::format("set type 1 diameter {}", 2 * radius));
    execute(fmt::format("set type 1 mass {}", mass));
    execute(fmt::format("neighbor {} bin", 0.4 * radius));
    execute("neigh_modify delay 0 every 1 check yes");
    // A pair's reduced mass is half a ball's.
    execute(fmt::format("pair_style gran/hooke {} 0 {} 0 0 0", contact.stiffness * mass / 2, contact.damping));
    execute("pair_coeff * *");

    int walls = 0;
    for (const Plane& plane : world.planes) {
      int axis = 0;
      plane.normal.cwiseAbs().maxCoeff(&axis);
      const double at = plane.point[axis];
      const std::string sides = plane.normal[axis] > 0 ? fmt::format("{} NULL", at) : fmt::format("NULL {}", at);
      execute(fmt::format("fix wall{} all wall/gran hooke {} 0 {} 0 0 0 {}plane {}", ++walls, contact.stiffness * mass,
                          contact.damping, "xyz"[axis], sides));
    }

    const Vec3& g = world.gravity;
    if (g.norm() > 0) execute(fmt::format("fix gravity all gravity {} vector {} {} {}", g.norm(), g.x(), g.y(), g.z()));
    execute("fix move all nve");
    execute(fmt::format("timestep {}", step));
    execute("thermo 1000000000");
    execute("run 0");
  }
  ~LammpsWorld() override { lammps_close(lammps_); }

  void advance(int steps) override { execute(fmt::format("run {} pre no post no", steps)); }

  void read(State& state) override {
    numbers_.resize(3 * balls_);
    for (auto [name, vectors] : {std::pair("x", &state.position), std::pair("v", &state.velocity)}) {
      lammps_gather_atoms(lammps_, const_cast<char*>(name), 1, 3, numbers_.data());
      for (std::size_t i = 0; i < balls_; ++i)
        (*vectors)[i] = {numbers_[3 * i], numbers_[3 * i + 1], numbers_[3 * i + 2]};
    }
  }

 private:
  void execute(const std::string& command) { lammps_command(lammps_, const_cast<char*>(command.c_str())); }

  const std::size_t balls_;
  void* lammps_;
  std::vector<double> numbers_;
};

}  // namespace

Peer lammps() {
  return {"LAMMPS", CAROM_PEER_LAMMPS, {3840, 15360, 61440, 245760}, 15360, [](const Scene& scene, double step) {
            return std::make_unique<LammpsWorld>(scene, step);
          }};
}

}  // namespace carom
