// CPU time of a picture of 1280 x 720 by number of balls, on one thread: drawing, and the same with its PNG. Balls fly
// above a floor, as many as fit into a cube at a tenth of its volume, so that their size falls with their number.
//
//    carom_pictures                              the table, as CSV
//    carom_pictures N                            its row of N balls
//    carom_pictures N FILE.png                   one picture of N balls
//    carom_pictures N FILE.json                  the scene of N balls, for other programs
//    carom_pictures N PICTURES [WIDTH HEIGHT]    so many pictures of N balls, and the peak of memory after each tenth
#include <fmt/format.h>
#include <time.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "export/png.h"
#include "physics/world.h"
#include "render/camera.h"
#include "render/lighting.h"
#include "render/renderer.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

constexpr Size picture{1280, 720};

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double noise(uint64_t& seed) {
  seed = seed * 6364136223846793005U + 1442695040888963407U;
  return static_cast<double>(seed >> 11U) * 0x1p-53;
}

Scene cloud(int balls) {
  Scene scene;
  // N (4/3) pi r^3 = 0.1 of a cube of 2 m.
  const double radius = std::cbrt(0.8 * 3 / (4 * M_PI * balls)) * (balls == 1 ? 0.7 : 1);
  uint64_t seed = 7;
  const Color palette[] = {{0.90, 0.30, 0.26}, {0.20, 0.55, 0.85}, {0.95, 0.75, 0.25}, {0.35, 0.70, 0.45}};
  const auto cells = static_cast<int>(ceil(std::cbrt(balls)));

  for (int i = 0; i < balls; ++i) {
    // One in each cell of a grid, so that they do not overlap.
    const double side = 2.0 / cells, room = std::max(side - 2 * radius, 0.0);
    const auto along = [&](int k) { return k * side + radius + room * noise(seed); };

    scene.initial.position.emplace_back(along(i % cells) - 1, along(i / cells % cells), along(i / cells / cells) - 1);
    scene.initial.velocity.push_back(Vec3::Zero());
    scene.world.mass.push_back(1);
    scene.world.radius.push_back(radius);
    scene.world.restitution.push_back(1);
    scene.roster.bodies.push_back({"b" + to_string(i), static_cast<Entity>(i), 1, false, palette[i % 4]});
  }

  scene.world.planes.push_back({Vec3::Zero(), Vec3(0, 1, 0), {}});
  scene.roster.fixed.push_back({"floor", {0.82, 0.80, 0.76}, true});
  Camera camera;
  camera.eye = Vec3(0.9, 2.2, 4.2);
  camera.target = Vec3(0, 0.8, 0);
  scene.camera = camera;
  return scene;
}

void move(State& state, int number) {
  for (Vec3& p : state.position) p.y() += (number % 2 ? -1 : 1) * 1e-3;
}

struct Cost {
  double draw, write;  // ms
};

Cost cost_of(int balls) {
  const Scene scene = cloud(balls);
  Renderer renderer(scene, picture, 4);
  State state = scene.initial;
  PngEncoder png;
  vector<double> draws, writes;

  renderer.draw(state);
  for (int i = 0; i < 15; ++i) {
    move(state, i);
    const double start = processor_ms();
    const Image& image = renderer.draw(state);
    const double drawn = processor_ms();
    png.take(image);
    png.encode();
    draws.push_back(drawn - start);
    writes.push_back(processor_ms() - drawn);
  }

  const auto median = [](vector<double>& times) {
    std::nth_element(times.begin(), times.begin() + 7, times.end());
    return times[7];
  };
  return {median(draws), median(writes)};
}

void print_row(int balls) {
  const Cost cost = cost_of(balls);
  fmt::print("{},{:.2f},{:.2f},{:.2f}\n", balls, cost.draw, cost.write, cost.draw + cost.write);
  std::fflush(stdout);
}

string json_of(const Scene& scene) {
  const auto triple = [](const auto& v) { return nlohmann::json{v[0], v[1], v[2]}; };
  const auto color = [&](const Color& c) { return triple(linear(c)); };
  const Camera camera = camera_of(scene);
  const KeyLight light = default_light(scene.look, view_of(camera, picture));

  nlohmann::json json = {{"size", {picture.width, picture.height}},
                         {"eye", triple(camera.eye)},
                         {"target", triple(camera.target)},
                         {"fov", camera.fov},
                         {"towards_light", triple(light.towards)},
                         {"light", triple(light.radiance)},
                         {"floor", color(scene.roster.fixed[0].color)}};

  for (size_t i = 0; i < scene.world.radius.size(); ++i)
    json["balls"].push_back(
        {triple(scene.initial.position[i]), scene.world.radius[i], color(scene.roster.bodies[i].color)});
  return json.dump();
}

/// Since this program's start. getrusage() would count what the parent process had before it.
long peak_kb() {
  std::ifstream status("/proc/self/status");
  string word;
  while (status >> word && word != "VmHWM:") {
  }
  long peak = 0;
  status >> peak;
  return peak;
}

void print_peaks(const Scene& scene, int pictures, Size size) {
  Renderer renderer(scene, size, 4);
  PngEncoder png;
  State state = scene.initial;
  fmt::print("pictures,peak_kB\n");
  for (int i = 1; i <= pictures; ++i) {
    move(state, i);
    png.take(renderer.draw(state));
    png.encode();
    if (i % std::max(1, pictures / 10) == 0) fmt::print("{},{}\n", i, peak_kb());
  }
}

int run(int argc, char** argv) {
  setenv("LP_NUM_THREADS", "0", 1);
  if (argc <= 2) {
    fmt::print("balls,draw_ms,png_ms,picture_ms\n");
    if (argc == 2) print_row(std::atoi(argv[1]));
    for (const int balls : {1, 100, 1000, 10000, 100000})
      if (argc == 1) print_row(balls);
    return 0;
  }

  if (argc != 3 && argc != 5) return 2;
  const Scene scene = cloud(std::max(1, std::atoi(argv[1])));
  const string what = argv[2];

  if (what.ends_with(".json")) {
    std::ofstream(what) << json_of(scene);
  } else if (what.ends_with(".png")) {
    Renderer renderer(scene, picture, 4);
    std::ofstream(what, std::ios::binary) << encode_png(renderer.draw(scene.initial));
  } else {
    print_peaks(scene, std::atoi(argv[2]), argc == 5 ? Size{std::atoi(argv[3]), std::atoi(argv[4])} : picture);
  }
  return 0;
}

}  // namespace
}  // namespace carom

int main(int argc, char** argv) {
  return carom::run(argc, argv);
}
