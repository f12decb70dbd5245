// What a camera that frames the motion makes of collisions: what it holds, how large, from where, and how it moves.
#include <gtest/gtest.h>

#include "render/camera_fit.h"
#include "render/eye.h"
#include "render/moving_camera.h"
#include "render/scenes.h"
#include "std.h"

namespace carom {
namespace {

constexpr Size picture{1280, 720};

/// Balls on straight ways, which turn at collisions.
struct Course {
  struct Leg {
    double from;  // s
    Vec3 at, velocity;
  };
  vector<vector<Leg>> legs;  // by ball

  const Leg& leg(size_t ball, double time) const {
    const Leg* found = &legs[ball].front();
    for (const Leg& leg : legs[ball])
      if (leg.from <= time) found = &leg;
    return *found;
  }
};

/// The views of balls on their course. Collisions are where legs begin.
CameraViews views_of(const Scene& scene, const Course& course, double duration) {
  CameraFit fit(scene, picture);
  State state = scene.initial;
  const int count = 1000;
  for (int i = 0; i <= count; ++i) {
    const double before = duration * (i - 1) / count;
    state.time = duration * i / count;
    vector<Collision> collisions;

    for (Entity ball = 0; ball < course.legs.size(); ++ball) {
      const Course::Leg& leg = course.leg(ball, state.time);
      state.position[ball] = leg.at + (state.time - leg.from) * leg.velocity;
      state.velocity[ball] = leg.velocity;
      if (leg.from > before && leg.from > 0)
        collisions.push_back(
            {leg.from, CollisionKind::body_fixed, ball, scene.world.body_count(), leg.at, Vec3(0, 1, 0), 1, 1, 1});
    }

    fit.strike(collisions);
    fit.add(state);
  }
  return fit.views();
}

Scene balls(size_t count, double radius = 0.1) {
  Scene scene;
  for (size_t i = 0; i < count; ++i) test::add_ball(scene, Vec3::Zero(), radius, test::red);
  scene.world.gravity = Vec3::Zero();
  return scene;
}

/// Two balls meet at the origin at 1 s, and slide away at `speed`.
Course meeting(double speed, double scale = 1, const Vec3& middle = Vec3::Zero()) {
  const Vec3 side = scale * Vec3(0.1, 0, 0), v = scale * speed * Vec3(1, 0, 0);
  return {{{{0, middle - side - v, v}, {1, middle - side, -v}}, {{0, middle + side + v, -v}, {1, middle + side, v}}}};
}

/// The part of the picture's height that a ball has, and whether all of it is in the picture.
struct InPicture {
  double height;
  bool whole;
};

InPicture in_picture(const Camera& camera, const Vec3& center, double radius) {
  const Eye eye(camera, picture);
  const Vec3 p = eye.point(center);
  const bool whole = std::abs(p.x()) + radius < eye.tan_x * p.z() && std::abs(p.y()) + radius < eye.tan_y * p.z();
  return {radius / (p.z() * eye.tan_y), whole};
}

TEST(CameraStory, ShowsACollisionLargeHoweverFarTheBallsGo) {
  const Scene scene = balls(2);
  for (const double duration : {2.0, 20.0, 200.0}) {
    const CameraViews views = views_of(scene, meeting(3), duration);
    const MovingCamera camera = [&] {
      MovingCamera moving(scene, picture);
      moving.frame(views);
      return moving;
    }();

    State state = scene.initial;
    state.time = 1;
    for (const double x : {-0.1, 0.1}) {
      const InPicture ball = in_picture(camera.at(state), Vec3(x, 0, 0), 0.1);
      EXPECT_TRUE(ball.whole);
      EXPECT_GE(ball.height, 0.03) << duration;
    }
  }
}

TEST(CameraStory, StandsStillWhereAllIsLargeEnough) {
  const CameraViews views = views_of(balls(2), meeting(1), 2);
  EXPECT_TRUE(views.path.empty());
  EXPECT_TRUE(views.faded.empty());
  // From 1.1 m to the left and to the right of the middle: nothing is cut.
  for (const double x : {-1.1, 1.1}) EXPECT_TRUE(in_picture(views.camera, Vec3(x, 0, 0), 0.1).whole);
}

/// A ball that bounces between rails of 40 m on its way along, and so collides all the way.
Course travelling(double speed) {
  Course course{{{}}};
  for (int i = 0; i < 40; ++i)
    course.legs[0].push_back({0.5 * i, Vec3(0.5 * i * speed, i % 2 ? 0.5 : 0, 0), Vec3(speed, i % 2 ? -1 : 1, 0)});
  return course;
}

TEST(CameraStory, GoesAlongWithABodyThatCollidesOnALongWay) {
  const Scene scene = balls(1);
  const Course course = travelling(2);
  const CameraViews views = views_of(scene, course, 20);
  ASSERT_FALSE(views.path.empty());

  MovingCamera camera(scene, picture);
  camera.frame(views);
  State state = scene.initial;
  for (const Course::Leg& leg : course.legs[0]) {
    if (leg.from > 20) break;
    state.time = leg.from;
    const InPicture ball = in_picture(camera.at(state), leg.at, 0.1);
    EXPECT_TRUE(ball.whole) << leg.from;
    EXPECT_GE(ball.height, 0.02) << leg.from;
  }
}

TEST(CameraStory, PansAndComesNearerNoFasterThanAHand) {
  for (const double speed : {1.0, 3.0, 30.0}) {
    const Scene scene = balls(1);
    MovingCamera camera(scene, picture);
    camera.frame(views_of(scene, travelling(speed), 20));

    const double h = 1.0 / 30;
    State state = scene.initial;
    Vec3 before = Vec3::Zero();
    for (int i = 0; i < 600; ++i) {
      state.time = i * h;
      const Camera now = camera.at(state);
      state.time += h;
      const Camera then = camera.at(state);

      const Eye eye(now, picture);
      const double depth = (now.target - now.eye).norm(), deeper = (then.target - then.eye).norm();
      const Vec3 way = eye.direction(then.eye - now.eye) / (2 * depth * eye.tan_y);
      const Vec3 velocity = Vec3(way.x(), way.y(), std::log(deeper / depth)) / h;

      EXPECT_LT(hypot(velocity.x(), velocity.y()), 1.01) << speed;
      EXPECT_LT(std::abs(velocity.z()), 1.01) << speed;
      const double gain = i > 0 ? ((velocity - before) / h).head<2>().norm() : 0;
      EXPECT_LT(gain, 2.2) << speed << " " << state.time;
      before = velocity;
    }
  }
}

TEST(CameraStory, IsTheSameForAnyOrderOfBodies) {
  Course course = meeting(3);
  course.legs.push_back({{0, Vec3(0, 0.5, 0), Vec3(0, 0, -5)}});
  const Scene scene = balls(3);
  const CameraViews views = views_of(scene, course, 20);
  std::swap(course.legs[0], course.legs[2]);
  const CameraViews other = views_of(scene, course, 20);
  EXPECT_EQ(other.path.size(), views.path.size());
  EXPECT_LT((other.camera.eye - views.camera.eye).norm(), 1e-12 * views.camera.eye.norm());
}

TEST(CameraStory, IsTheSameAtAnyPlaceAndScale) {
  const CameraViews views = views_of(balls(2), meeting(3), 20);
  for (const double scale : {1e-3, 1.0, 1e4}) {
    const Vec3 middle = scale * Vec3(70, -20, 300);
    const CameraViews moved = views_of(balls(2, 0.1 * scale), meeting(3, scale, middle), 20);
    EXPECT_EQ(moved.path.size(), views.path.size());
    EXPECT_LT(((moved.camera.eye - middle) / scale - views.camera.eye).norm(), 1e-9) << scale;
  }
}

double elevation(const Camera& camera) {
  return std::asin((camera.eye - camera.target).normalized().y()) * 180 / M_PI;
}

TEST(CameraStory, LooksOverAWallThatHides) {
  Scene scene = balls(2);
  EXPECT_NEAR(elevation(views_of(scene, meeting(1), 2).camera), 18, 1e-9);
  // In front, so near and high that a line of 30 degrees over its edge meets the balls.
  test::add_wall(scene, Vec3(0, 0, 0.6), Vec3(0, 0, 1), Vec3(0, 1, 0), 6, 0.4, test::green);
  const CameraViews low = views_of(scene, meeting(1), 2);
  EXPECT_NEAR(elevation(low.camera), 30, 1e-9);
  EXPECT_TRUE(low.faded.empty());
}

TEST(CameraStory, FadesWhatHidesFromEverywhere) {
  Scene scene = balls(2);
  test::add_wall(scene, Vec3(0, 0, 0.3), Vec3(0, 0, 1), Vec3(0, 1, 0), 6, 9, test::green);
  test::add_wall(scene, Vec3(0, 0, -0.3), Vec3(0, 0, 1), Vec3(0, 1, 0), 6, 9, test::green);
  EXPECT_EQ(views_of(scene, meeting(1), 2).faded, vector<uint32_t>{0});
}

TEST(CameraStory, FramesNamedBodiesAlone) {
  Scene scene = balls(3);
  Course course = meeting(1);
  course.legs.push_back({{0, Vec3(0, 30, 0), Vec3(0, 0, 0)}, {1, Vec3(0, 30, 0), Vec3(0, 1, 0)}});
  CameraPlan plan;
  plan.fit = true;
  plan.fit_on = {0, 1};
  scene.camera = plan;
  const CameraViews views = views_of(scene, course, 2);
  EXPECT_EQ(views.camera, views_of(balls(2), meeting(1), 2).camera);
  EXPECT_FALSE(in_picture(views.camera, Vec3(0, 30, 0), 0.1).whole);
}

TEST(CameraStory, GoingRoundItKeepsAllInView) {
  Scene scene = balls(2);
  CameraPlan plan;
  plan.fit = true;
  plan.orbit = 2;
  scene.camera = plan;

  MovingCamera camera(scene, picture);
  camera.frame(views_of(scene, meeting(1), 2));
  EXPECT_FALSE(camera.stands_still());
  State state = scene.initial;
  for (int i = 0; i <= 100; ++i) {
    state.time = 0.02 * i;
    for (const double x : {-1.1, 1.1}) EXPECT_TRUE(in_picture(camera.at(state), Vec3(x, 0, 0), 0.1).whole) << i;
  }
}

}  // namespace
}  // namespace carom
