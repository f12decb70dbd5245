// The source chapter's two bowling balls, in seven files, against their comments and the closed form.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "paths.h"
#include "physics/energy.h"
#include "physics/world.h"
#include "render/camera.h"
#include "scene/scene.h"
#include "scenes/play.h"
#include "std.h"

namespace carom::testing {
namespace {

constexpr double s = 3, v = 2, r = 0.11, m = 10;
const double meeting = (s - r * sqrt(2)) / v;

struct Variant {
  const char* file;
  double e;
};

class BowlingBalls : public ::testing::TestWithParam<Variant> {};

TEST_P(BowlingBalls, MeetAndPartByTheClosedForm) {
  const auto [file, e] = GetParam();
  const Played run = play(file);
  ASSERT_EQ(run.collisions.size(), 1u);
  EXPECT_NEAR(run.collisions[0].time, meeting, 4e-16);  // measured: 0
  EXPECT_NEAR(run.collisions[0].approach_speed, v * sqrt(2), 1e-15);
  const Vec3 red(-v * (1 - e) / 2, 0, v * (1 + e) / 2), blue(-v * (1 + e) / 2, 0, v * (1 - e) / 2);
  EXPECT_LT((run.velocity("red") - red).norm(), 2e-15);  // measured: 4e-16
  EXPECT_LT((run.velocity("blue") - blue).norm(), 2e-15);
  EXPECT_NEAR(run.tally.energy_lost, m * v * v * (1 - e * e) / 2, 2e-14);
  EXPECT_LT((momentum(run.scene.world, run.end) - Vec3(-20, 0, 20)).norm(), 2e-14);
}

TEST_P(BowlingBalls, TheCommentHasTheSameNumbers) {
  const auto [file, e] = GetParam();
  const string comment = comment_of(file);
  const auto has = [&](const string& words) { EXPECT_NE(comment.find(words), string::npos) << words; };

  EXPECT_NEAR(stated(file, "(s - r sqrt(2)) / v = "), meeting, 5e-16);

  const auto number = [](double x) {
    string text = nlohmann::json(std::round(x * 1e9) / 1e9 + 0.0).dump();
    return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
  };
  const auto vector = [&](double x, double z) { return "(" + number(x) + ", 0, " + number(z) + ") m/s"; };

  has("= " + vector(-v * (1 - e) / 2, v * (1 + e) / 2));
  has("= " + vector(-v * (1 + e) / 2, v * (1 - e) / 2));

  if (e != 1) {
    EXPECT_NEAR(stated(file, "m v^2 (1-e^2)/2 = "), m * v * v * (1 - e * e) / 2, 1e-14);
  } else {
    has("energy lost: none of 40 J");
  }
}

INSTANTIATE_TEST_SUITE_P(ByRestitution, BowlingBalls,
                         ::testing::Values(Variant{"two_bowling_balls_e0", 0}, Variant{"two_bowling_balls_e05", 0.5},
                                           Variant{"two_bowling_balls", 0.9}, Variant{"two_bowling_balls_e1", 1},
                                           Variant{"two_bowling_balls_e11", 1.1}),
                         [](const auto& parameter) { return string(parameter.param.file); });

TEST(TwoBowlingBalls, CommentHasTheApproachSpeedToTwelveDigits) {
  EXPECT_NEAR(stated("two_bowling_balls", "they approach at v sqrt(2) = "), v * sqrt(2), 1e-15);
}

TEST(BookBowlingBalls, ComeFromBeyondTheLeftEdgeAndFromBelowThePicture) {
  const Played run = play("book_bowling_balls");
  const Camera& camera = *run.scene.camera;
  const Size size = run.scene.output.video->size;
  EXPECT_EQ(size.width, size.height);  // the chapter's aspect
  // A sphere of radius r is out of sight beyond an edge's plane through the eye when it is r away from it.
  const Vec3 ahead = (camera.target - camera.eye).normalized();
  const Vec3 right = ahead.cross(camera.up).normalized(), up = right.cross(ahead);
  const double half = camera.fov / 2 * M_PI / 180;
  const auto beyond = [&](const Vec3& x, const Vec3& side) {
    return (x - camera.eye).dot(side * std::cos(half) - ahead * std::sin(half));  // m
  };
  EXPECT_GT(beyond(run.scene.initial.position[run.number("red")], -right), r);
  EXPECT_GT(beyond(run.scene.initial.position[run.number("blue")], -up), r);
  EXPECT_LT(right.x(), -0.99) << "+x is on the left";
}

TEST(TwoBowlingBalls, VariantsDifferInRestitutionAndOutputsOnly) {
  const Played first = play("two_bowling_balls");
  for (const char* name : {"two_bowling_balls_e0", "two_bowling_balls_e05", "two_bowling_balls_e1",
                           "two_bowling_balls_e11", "book_bowling_balls", "book_as_printed"}) {
    const Played other = play(name);
    EXPECT_EQ(other.scene.world.mass, first.scene.world.mass);
    EXPECT_EQ(other.scene.world.radius, first.scene.world.radius);
    EXPECT_EQ(other.scene.world.impulse, first.scene.world.impulse);
    EXPECT_EQ(other.scene.initial.position, first.scene.initial.position);
  }
}

TEST(BookBowlingBalls, CollideInFrame86AndPartExactly) {
  const Played run = play("book_bowling_balls");
  ASSERT_EQ(run.collisions.size(), 1u);

  const double u = s - v * 86 / 60;
  EXPECT_GE(2 * (u + v / 60) * (u + v / 60), 4 * r * r) << "no overlap in frame 85";
  EXPECT_LT(2 * u * u, 4 * r * r);

  const double time = run.collisions[0].time;
  EXPECT_EQ(time, 86 / 60.0);

  EXPECT_NEAR(stated("book_bowling_balls", "t = 86/60 = "), time, 5e-16);
  EXPECT_NEAR(stated("book_bowling_balls", "333 s, "), time - meeting, 5e-16);
  EXPECT_NEAR(stated("book_bowling_balls", "late, at u = "), u, 5e-16);

  EXPECT_NEAR(stated("book_bowling_balls", "2 r - u sqrt(2) = "), run.tally.max_overlap, 2e-14);  // measured: 7e-15
  EXPECT_NEAR(stated("book_bowling_balls", "587 m, "), 100 * run.tally.max_overlap / (2 * r), 0.05);

  EXPECT_LT((run.velocity("red") - Vec3(-0.1, 0, 1.9)).norm(), 1e-13);  // measured: 5e-14, of 86 sums of v dt
  EXPECT_LT((run.velocity("blue") - Vec3(-1.9, 0, 0.1)).norm(), 1e-13);
}

TEST(BookAsPrinted, MakesEnergyAsTheListingsDo) {
  const Played run = play("book_as_printed");
  ASSERT_EQ(run.collisions.size(), 1u);

  const double e = 0.9 * 0.9 / 2;

  EXPECT_EQ(run.collisions[0].time, 86 / 60.0);
  EXPECT_NEAR(run.collisions[0].restitution, stated("book_as_printed", "e = e1 e2 / 2 = "), 1e-15);

  const Vec3 red = 2 * v * Vec3(-(1 - e) / 2, 0, (1 + e) / 2), blue = 2 * v * Vec3(-(1 + e) / 2, 0, (1 - e) / 2);
  EXPECT_LT((run.velocity("red") - red).norm(), 1e-13);
  EXPECT_LT((run.velocity("blue") - blue).norm(), 1e-13);

  const string comment = comment_of("book_as_printed");
  EXPECT_NE(comment.find("(-1.19, 0, 2.81), blue with (-2.81, 0, 1.19) m/s"), string::npos);
  EXPECT_NEAR(red.x(), -1.19, 1e-15);
  EXPECT_NEAR(red.z(), 2.81, 1e-15);

  const double energy = kinetic_energy(run.scene.world, run.end);
  EXPECT_NEAR(energy, stated("book_as_printed", "2 m v^2 (1+e^2) = "), 1e-11);
  EXPECT_NEAR(energy / 40, stated("book_as_printed", "93.122 J, "), 1e-12);
  EXPECT_NEAR(play("two_bowling_balls").tally.energy_lost / 40, 1 - stated("book_as_printed", "exact collision keeps "),
              1e-15);
  // The same numbers, from print.
  const auto slips = nlohmann::json::parse(std::ifstream(DATA_DIR "/references/book_slips.json"));
  const auto& single = slips["closed_form_single_call"];
  EXPECT_NEAR(energy / 40, single["KE_ratio"]["right_angle"]["slip1_3B"].get<double>(), 1e-12);
  EXPECT_NEAR(-run.velocity("red").x() / v, single["right_angle"]["slip1_3B"][0].get<double>(), 1e-13);
}

}  // namespace
}  // namespace carom::testing
