// How long a picture takes. Not part of a test run: test_render --gtest_also_run_disabled_tests
// --gtest_filter='Speed.*', with LP_NUM_THREADS=0 and on one processor (taskset -c 0) for the figure of one core.
// Leaves the last pictures as PPM.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <ctime>

#include "render/scenes.h"

namespace carom {
namespace {

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void measure(const Scene& scene, const char* name, int pictures = 60) {
  Renderer renderer(scene, {1280, 720}, 4);
  State state = scene.initial;
  std::vector<double> times;
  for (int i = 0; i < pictures; ++i) {
    for (Vec3& p : state.position) p.x() += 1e-3;  // no two pictures alike
    const double start = cpu_seconds();
    const Image& image = renderer.draw(state);
    times.push_back(cpu_seconds() - start);
    if (i + 1 == pictures) {
      EXPECT_TRUE(test::write_ppm(image, ::testing::TempDir() + "carom_" + name + ".ppm"));
    }
  }
  std::nth_element(times.begin(), times.begin() + pictures / 2, times.end());
  std::printf("%s: %.1f ms of CPU a picture (median of %d)\n", name,
              1000 * times[static_cast<std::size_t>(pictures / 2)], pictures);
}

TEST(Speed, DISABLED_OfTypicalScenes) {
  measure(test::bowling_balls(), "bowling_balls");
  measure(test::gas(100), "gas_from_outside");
  Scene inside = test::gas(100);
  Camera camera;
  camera.eye = Vec3(-4.5, 2, 4.5);
  camera.target = Vec3(0, -1, 0);
  camera.fov = 70;
  inside.camera = camera;
  measure(inside, "gas_from_inside");
  measure(test::gas(10000, 5 * std::cbrt(100.0)), "gas_10000", 5);
}

}  // namespace
}  // namespace carom
