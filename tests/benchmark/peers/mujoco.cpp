// MuJoCo. It has no restitution. Contacts are springs that push, given by stiffness and damping (solref with negative
// numbers; Modeling, section Solver parameters). Here a contact lasts a given number of steps and has the restitution.
// The impedance (solimp) is as near to 1 as the solver CG still converges in a gas. Newton's solver needs memory as the
// square of the number of balls. The Runge-Kutta method takes four times as long for nearly the same errors.
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <unistd.h>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "benchmark/peers/peer.h"
#include "benchmark/peers/soft.h"
#include "physics/world.h"
#include "scene/scene.h"

namespace carom {
namespace {

void warn(const char* text) {
  std::fprintf(stderr, "MuJoCo: %s\n", text);
}

[[noreturn]] void give_up(const char* text) {
  warn(text);
  _exit(1);
}

std::string model_text(const Scene& scene, double step) {
  const std::size_t balls = scene.world.mass.size();
  const SoftContact contact = contact_of(common_restitution(scene), false, step, balls);
  const Vec3& g = scene.world.gravity;
  std::string text = fmt::format(
      "<mujoco><option timestep='{}' gravity='{} {} {}' integrator='Euler' solver='CG' tolerance='1e-12' "
      "iterations='100'/><size njmax='{}' nconmax='{}' nstack='{}'/>"
      "<default><geom condim='1' solref='{} {}' solimp='0.99 0.99 0.001'/></default><worldbody>",
      step, g.x(), g.y(), g.z(), 8 * balls + 100, 8 * balls + 100, 20000 * balls + 1'000'000, -contact.stiffness,
      -contact.damping);

  for (const Plane& plane : scene.world.planes) {
    const Vec3 &x = plane.point, &n = plane.normal;
    text += fmt::format("<geom type='plane' size='1 1 1' pos='{} {} {}' zaxis='{} {} {}'/>", x.x(), x.y(), x.z(), n.x(),
                        n.y(), n.z());
  }

  for (std::size_t i = 0; i < balls; ++i)
    text += fmt::format(
        "<body><joint type='slide' axis='1 0 0'/><joint type='slide' axis='0 1 0'/><joint type='slide' axis='0 0 1'/>"
        "<geom type='sphere' size='{}' mass='{}'/></body>",
        scene.world.radius[i], scene.world.mass[i]);
  return text + "</worldbody></mujoco>";
}

class MujocoWorld : public PeerWorld {
 public:
  MujocoWorld(const Scene& scene, double step) {
    mju_user_error = give_up;  // the default handler waits for a key, and both write MUJOCO_LOG.TXT
    mju_user_warning = warn;

    const std::string text = model_text(scene, step);
    // A file in memory.
    auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(text.size()));
    std::memcpy(files->filedata[0], text.data(), text.size());
    char error[1000] = "";
    model_ = mj_loadXML("scene.xml", files.get(), error, sizeof(error));
    mj_deleteFileVFS(files.get(), "scene.xml");
    if (model_ == nullptr) throw std::runtime_error(error);

    data_ = mj_makeData(model_);
    for (std::size_t i = 0; i < scene.world.mass.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        data_->qpos[3 * i + static_cast<std::size_t>(k)] = scene.initial.position[i][k];
        data_->qvel[3 * i + static_cast<std::size_t>(k)] = scene.initial.velocity[i][k];
      }
  }
  ~MujocoWorld() override {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }

  void advance(int steps) override {
    for (int k = 0; k < steps; ++k) mj_step(model_, data_);
  }

  void read(State& state) override {
    for (std::size_t i = 0; i < state.position.size(); ++i) {
      const mjtNum *x = data_->qpos + 3 * i, *v = data_->qvel + 3 * i;
      state.position[i] = {x[0], x[1], x[2]};
      state.velocity[i] = {v[0], v[1], v[2]};
    }
  }

 private:
  mjModel* model_;
  mjData* data_;
};

}  // namespace

Peer mujoco() {
  return {"MuJoCo",
          CAROM_PEER_MUJOCO,
          {60, 240, 960, 3840},
          240,
          [](const Scene& scene, double step) -> std::unique_ptr<PeerWorld> {
            // The constraints' Jacobian is kept with its zeros: 19 GB for 10,000 balls.
            if (scene.world.mass.size() > 3000) return nullptr;
            return std::make_unique<MujocoWorld>(scene, step);
          }};
}

}  // namespace carom
