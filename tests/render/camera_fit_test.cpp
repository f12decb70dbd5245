// What a camera that frames the motion has in view, and how near it comes.
#include "render/camera_fit.h"

#include <gtest/gtest.h>

#include "render/eye.h"
#include "render/scenes.h"
#include "std.h"

namespace carom {
namespace {

constexpr Size size{1280, 720};

/// How far balls and points extend in the picture: the largest part of half its width or height, 1 at its edge.
class Filled {
 public:
  explicit Filled(const Camera& camera) : eye_(camera, size) {}

  void add(const Vec3& center, double radius) {
    const Vec3 p = eye_.point(center);
    // The tangent planes through the eye: |x| cos - z sin = radius on the outline.
    x = std::max(x, tangent(std::abs(p.x()), p.z(), radius) / eye_.tan_x);
    y = std::max(y, tangent(std::abs(p.y()), p.z(), radius) / eye_.tan_y);
    in_front = in_front && p.z() - radius > eye_.camera.near && p.z() + radius < eye_.camera.far;
  }
  double most() const { return std::max(x, y); }

  double x = 0, y = 0;
  bool in_front = true;

 private:
  static double tangent(double across, double depth, double radius) {
    return std::tan(std::atan2(across, depth) + std::asin(radius / hypot(across, depth)));
  }

  Eye eye_;
};

/// `position`: of each body as a function of time. Instants every 1/30 s.
template <typename Position>
Camera camera_for(const Scene& scene, double duration, const Position& position) {
  CameraFit fit(scene, size);
  State state = scene.initial;
  for (int i = 0; i <= 30 * duration; ++i) {
    state.time = i / 30.0;
    for (Entity body = 0; body < state.position.size(); ++body) {
      const double h = 1e-6;
      state.position[body] = position(body, state.time);
      state.velocity[body] = (state.position[body] - position(body, state.time - h)) / h;
    }
    fit.add(state);
  }
  return fit.views().camera;
}

/// A marble bounces down a stair for 3 s.
Vec3 marble(Entity, double t) {
  const double hop = t - 0.5 * floor(t / 0.5);
  return Vec3(1.5 * t, 3 - floor(t / 0.5) * 0.4 + hop * (2.8 - 7.2 * hop), 0.1 * t);
}

Scene one_ball(double radius = 0.05) {
  Scene scene;
  test::add_ball(scene, Vec3::Zero(), radius, test::red);
  return scene;
}

TEST(CameraFit, HasTheWholeWayInViewAndNoMore) {
  const Scene scene = one_ball();
  const Camera camera = camera_for(scene, 3, marble);
  Filled filled(camera);
  for (int i = 0; i <= 90; ++i) filled.add(marble(0, i / 30.0), 0.05);
  EXPECT_TRUE(filled.in_front);
  EXPECT_NEAR(filled.most(), 0.9, 1e-9);
  EXPECT_EQ(view_of(camera, size).right, Vec3(1, 0, 0));
  EXPECT_LT(view_of(camera, size).forward.y(), 0);
}

TEST(CameraFit, TouchesBothMarginsOfTheTighterSide) {
  const Scene scene = one_ball();
  const Eye eye(camera_for(scene, 3, marble), size);
  double bottom = 0, top = 0;
  for (int i = 0; i <= 90; ++i) {
    const Vec3 p = eye.point(marble(0, i / 30.0));
    const double turn = std::asin(0.05 / hypot(p.y(), p.z())), at = std::atan2(p.y(), p.z());
    bottom = std::min(bottom, std::tan(at - turn));
    top = std::max(top, std::tan(at + turn));
  }
  EXPECT_NEAR(bottom / eye.tan_y, -0.9, 1e-9);
  EXPECT_NEAR(top / eye.tan_y, 0.9, 1e-9);
}

TEST(CameraFit, TakesTheCamerasAngleAndUp) {
  Scene scene = one_ball();
  CameraPlan plan;
  plan.fit = true;
  plan.fov = 10;
  plan.up = Vec3(1, 0, 0);
  scene.camera = plan;
  const Camera camera = camera_for(scene, 3, marble);
  EXPECT_EQ(camera.fov, 10);
  EXPECT_GT(view_of(camera, size).up.x(), 0.9);
  Filled filled(camera);
  for (int i = 0; i <= 90; ++i) filled.add(marble(0, i / 30.0), 0.05);
  EXPECT_NEAR(filled.most(), 0.9, 1e-9);
}

TEST(CameraFit, AWallThatIsMetIsInViewAndOneFarBehindIsNot) {
  Scene scene = one_ball();
  test::add_wall(scene, Vec3(4, 1, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), 2, 2, test::green);
  test::add_wall(scene, Vec3(40, 1, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), 2, 2, test::blue);
  // To the wall and back. It touches the wall at the instant 1 s.
  const auto there_and_back = [](Entity, double t) { return Vec3(t < 1 ? 3.95 * t : 3.95 * (2 - t), 1, 0); };
  Filled filled(camera_for(scene, 2, there_and_back));
  for (const double y : {0.0, 2.0})
    for (const double z : {-1.0, 1.0}) filled.add(Vec3(4, y, z), 0);
  filled.add(Vec3(0, 1, 0), 0.05);
  EXPECT_NEAR(filled.most(), 0.9, 1e-9);
}

TEST(CameraFit, AnInvisibleWallIsNotFramed) {
  Scene scene = one_ball(0.12);
  test::add_wall(scene, Vec3(1.5, 2, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), 3, 3, test::green);
  const Camera with = camera_for(scene, 3, marble);
  scene.roster.fixed[0].visible = false;
  const Camera without = camera_for(scene, 3, marble);
  EXPECT_GT((with.eye - with.target).norm(), (without.eye - without.target).norm());
  EXPECT_EQ(without, camera_for(one_ball(0.12), 3, marble));
}

TEST(CameraFit, ThePointOfAStringIsInView) {
  Scene scene = one_ball();
  const Camera alone = camera_for(scene, 3, marble);
  scene.world.strings.push_back({0, no_entity, Vec3(2, 9, 0), 12, 0, false});
  const Camera with = camera_for(scene, 3, marble);
  Filled filled(with), before(alone);
  filled.add(Vec3(2, 9, 0), 0);
  before.add(Vec3(2, 9, 0), 0);
  EXPECT_LT(filled.most(), 0.9 + 1e-9);
  EXPECT_GT(before.most(), 1);
  scene.overlay.hidden_strings = {0};
  EXPECT_EQ(camera_for(scene, 3, marble), alone);
}

TEST(CameraFit, ThePointOfASpringIsInView) {
  Scene scene = one_ball();
  const Camera alone = camera_for(scene, 3, marble);
  scene.world.forces.push_back({Spring{Vec3(2, 9, 0), 1, 1, 0}});
  Filled filled(camera_for(scene, 3, marble));
  filled.add(Vec3(2, 9, 0), 0);
  EXPECT_LT(filled.most(), 0.9 + 1e-9);
  scene.overlay.hidden_springs = {0};
  EXPECT_EQ(camera_for(scene, 3, marble), alone);
}

TEST(CameraFit, AFloorOfAnySizeLeavesTheCameraWithTheBodies) {
  Scene scene = one_ball();
  const Camera alone = camera_for(scene, 3, marble);
  test::add_obstacle(scene, Vec3(0, -0.5, 0), Volume::box(Vec3(2000, 1, 2000)), test::green);
  test::add_wall(scene, Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), 500, 500, test::green);
  EXPECT_EQ(camera_for(scene, 3, marble), alone);
}

TEST(CameraFit, TheFloorBelowIsInViewUnlessItIsFarAway) {
  Scene scene = one_ball(0.12);
  const Camera alone = camera_for(scene, 3, marble);
  test::add_plane(scene, Vec3(0, -2, 0), Vec3(0, 1, 0), test::green);
  Filled filled(camera_for(scene, 3, marble));
  filled.add(Vec3(2.25, -2, 0.15), 0);
  EXPECT_LT(filled.most(), 0.9 + 1e-9);
  scene.world.planes[0].point.y() = -30;
  EXPECT_EQ(camera_for(scene, 3, marble), alone);
}

TEST(CameraFit, ObstaclesAmongTheBodiesAreInView) {
  Scene scene = one_ball();
  test::add_obstacle(scene, Vec3(2, 2, 0.4), Volume::cylinder(0.5, 3), test::green);
  Filled filled(camera_for(scene, 3, marble));
  for (const double y : {0.5, 3.5}) filled.add(Vec3(2, y, 0.9), 0);
  EXPECT_LT(filled.most(), 0.9 + 1e-9);
  EXPECT_GT(filled.y, 0.89);
}

TEST(CameraFit, OneThatFliesAwayForEverLeavesTheOthersInView) {
  Scene scene;
  for (int i = 0; i < 5; ++i) test::add_ball(scene, Vec3::Zero(), 0.05, test::red);
  const auto around = [](Entity body, double t) { return Vec3(std::cos(t + body), 0.5, std::sin(2 * t + body)); };
  const auto and_one_away = [&](Entity body, double t) {
    return body == 4 ? Vec3(around(4, 0) + t * Vec3(300, 0, 0)) : around(body, t);
  };

  const Camera all = camera_for(scene, 10, around), camera = camera_for(scene, 10, and_one_away);
  EXPECT_LT((camera.eye - camera.target).norm(), 1.5 * (all.eye - all.target).norm());

  Filled filled(camera);
  for (int i = 0; i <= 300; ++i)
    for (Entity body = 0; body < 4; ++body) filled.add(around(body, i / 30.0), 0.05);
  filled.add(and_one_away(4, 0), 0.05);  // where it leaves from
  EXPECT_LT(filled.most(), 0.9 + 1e-9);
  EXPECT_GT(filled.most(), 0.8);
}

TEST(CameraFit, OneThatGoesSomewhatFartherThanTheOthersStaysInView) {
  Scene scene;
  for (int i = 0; i < 5; ++i) test::add_ball(scene, Vec3::Zero(), 0.05, test::red);
  const auto position = [](Entity body, double t) {
    return body == 4 ? Vec3(0.7 * t, 0.5, 0) : Vec3(std::cos(t + body), 0.5, std::sin(2 * t + body));
  };
  Filled filled(camera_for(scene, 10, position));
  filled.add(position(4, 10), 0.05);
  EXPECT_LT(filled.most(), 0.9 + 1e-9);
}

TEST(CameraFit, WhatFliesAndReturnsIsInView) {
  Scene scene;
  for (int i = 0; i < 5; ++i) test::add_ball(scene, Vec3::Zero(), 0.001, test::red);
  // Thrown 80 m high, back after 8 s; the others lie at the start.
  const auto position = [](Entity body, double t) {
    return body == 4 ? Vec3(0, 40 * t - 5 * t * t, 0) : Vec3(0.01 * body, 0, 0);
  };
  Filled filled(camera_for(scene, 8, position));
  filled.add(Vec3(0, 80, 0), 0.001);
  EXPECT_LT(filled.most(), 0.9 + 1e-9);
}

TEST(CameraFit, OfBodiesThatAllFlyApartHalfStayInView) {
  Scene scene;
  for (int i = 0; i < 9; ++i) test::add_ball(scene, Vec3::Zero(), 0.001, test::red);
  const auto apart = [](Entity body, double t) {
    const double speed = pow(2, body);
    return Vec3(speed * t * std::cos(2.4 * body), 0, speed * t * std::sin(2.4 * body));
  };
  const Camera camera = camera_for(scene, 10, apart);
  Filled half(camera), most(camera);
  for (Entity body = 0; body < 5; ++body) half.add(apart(body, 10), 0.001);
  EXPECT_LT(half.most(), 0.9 + 1e-9);
  for (Entity body = 0; body < 8; ++body) most.add(apart(body, 10), 0.001);
  EXPECT_FALSE(most.in_front && most.most() < 1);
}

TEST(CameraFit, APartOfAJointBodyCountsAsThatBody) {
  Scene scene;
  for (int i = 0; i < 2; ++i) test::add_ball(scene, Vec3(i, 0, 0), 0.1, test::red);
  CameraFit fit(scene, size);
  fit.add(scene.initial);

  State merged = scene.initial;
  merged.time = 1;
  merged.position = {Vec3(0.5, 0, 0), Vec3(0.5, 0, 0)};
  merged.part_of = {0, 0};
  merged.radius = {1.5, 0.1};
  fit.add(merged);
  State far = merged;
  far.position = {Vec3(20, 0, 0), Vec3(20, 0, 0)};
  fit.add(far);

  Filled filled(fit.views().camera);
  for (const double x : {0.5, 20.0}) filled.add(Vec3(x, 0, 0), 1.5);
  EXPECT_NEAR(filled.most(), 0.9, 1e-9);
}

TEST(CameraFit, AFlatMotionIsSeenFromHigherUp) {
  Scene scene = one_ball();
  const auto around = [](Entity, double t) { return Vec3(std::cos(t), 0.05, std::sin(t)); };
  const auto upright = [](Entity, double t) { return Vec3(std::cos(t), std::sin(t), 0.05); };
  const auto elevation = [](const Camera& camera) {
    return std::asin((camera.eye - camera.target).normalized().y()) * 180 / M_PI;
  };
  EXPECT_NEAR(elevation(camera_for(scene, 7, around)), 45, 1e-9);
  EXPECT_NEAR(elevation(camera_for(scene, 7, upright)), 18, 1e-9);
}

TEST(CameraFit, FarFromTheOriginAndAtAnyScaleItIsTheSameView) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const Vec3 away = 1e6 * scale * Vec3(1, -2, 3);
    const auto position = [&](Entity body, double t) { return Vec3(away + scale * marble(body, t)); };
    const Scene scene = one_ball(0.05 * scale);
    Filled filled(camera_for(scene, 3, position));
    for (int i = 0; i <= 90; ++i) filled.add(position(0, i / 30.0), 0.05 * scale);
    EXPECT_TRUE(filled.in_front);
    EXPECT_NEAR(filled.most(), 0.9, 1e-8) << scale;  // measured: 6e-10
  }
}

}  // namespace
}  // namespace carom
