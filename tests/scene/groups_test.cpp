// Balls made by rule, and the random numbers they are made with.
#include <fmt/format.h>

#include "numerics/random.h"
#include "physics/world.h"
#include "scene/marked_errors.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

/// A group in a cube at the origin.
string group(const string& arrange, const string& count, double radius, double edge, const string& more = "") {
  const string ball = fmt::format("{{mass: 1, radius: {:f}}}", radius);
  const string cube = fmt::format("{{min: [0, 0, 0], max: [{0:f}, {0:f}, {0:f}]}}", edge);
  return start + "groups:\n  gas: {count: " + count + ", ball: " + ball + ", in: " + cube + ", arrange: " + arrange +
         more + "}\noutput: {}\n";
}

/// Greatest overlap of any two balls, relative to the sum of their radii, over all pairs.
double greatest_overlap(const Scene& scene) {
  double greatest = -1;
  for (Entity i = 0; i < scene.world.body_count(); ++i) {
    for (Entity j = 0; j < i; ++j) {
      const double sum = scene.world.radius[i] + scene.world.radius[j];
      greatest = std::max(greatest, 1 - (scene.initial.position[i] - scene.initial.position[j]).norm() / sum);
    }
  }
  return greatest;
}

double greatest_excess(const Scene& scene, const Vec3& min, const Vec3& max) {
  double greatest = -1;
  for (Entity i = 0; i < scene.world.body_count(); ++i) {
    const double r = scene.world.radius[i];
    greatest = std::max({greatest, (min.array() + r - scene.initial.position[i].array()).maxCoeff(),
                         (scene.initial.position[i].array() + r - max.array()).maxCoeff()});
  }
  return greatest;
}

TEST(Groups, LieWhollyInsideWithoutOverlap) {
  for (const char* arrange : {"random", "lattice", "hexagonal"}) {
    for (const char* count : {"1", "2", "37", "300", "800"}) {
      const Scene scene = load_text(group(arrange, count, 0.05, 1));
      EXPECT_EQ(scene.world.body_count(), static_cast<Entity>(std::stoi(count)));
      EXPECT_LT(greatest_overlap(scene), 1e-12) << arrange << count;
      EXPECT_LT(greatest_excess(scene, Vec3(0, 0, 0), Vec3(1, 1, 1)), 1e-15) << arrange << count;
    }
  }
}

TEST(Groups, ExactlyFullBoxesAreFilled) {
  // 0.3 / 0.1 is 2.9999999999999996 in doubles; a box of three diameters still holds 27.
  EXPECT_LT(greatest_overlap(load_text(group("lattice", "27", 0.05, 0.3))), 1e-12);
  EXPECT_EQ(in_parts(errors_of(group("lattice", "28", 0.05, 0.3))),
            (Parts{{"4:16 28", "28 balls of radius 0.05 do not fit into the box of `gas`",
                    "27 would fit as a lattice; `arrange: hexagonal` packs closer"}}));
  EXPECT_EQ(load_text(group("random", "1", 0.5, 1)).initial.position[0], Vec3(0.5, 0.5, 0.5));
}

TEST(Groups, ErrorsHaveTheNumberThatWouldFit) {
  // Close-packed in a box of 10 diameters: 12 layers, since 9 = 11.02 sqrt(2/3), of 11 rows, since 9 = 10.39 sqrt(3)/2.
  // The rows have 10 and 9 balls in turn: 6 (6 * 10 + 5 * 9) + 6 (5 * 10 + 6 * 9).
  for (const char* arrange : {"random", "hexagonal"}) {
    const string error = errors_of(group(arrange, "2000", 0.05, 1));
    const size_t at = error.find("     = ") + 7;
    const int fit = std::stoi(error.substr(at));
    EXPECT_EQ(fit, 1254) << error;
    EXPECT_EQ(load_text(group(arrange, to_string(fit), 0.05, 1)).world.body_count(), 1254u);
    EXPECT_NE(errors_of(group(arrange, to_string(fit + 1), 0.05, 1)), "");
  }

  const string error = errors_of(group("random", "1", 0.6, 1));
  EXPECT_NE(error.find("error: 1 ball of radius 0.6 does not fit into the box of `gas`"), string::npos) << error;
  EXPECT_NE(error.find("= 0 would fit"), string::npos);
}

TEST(Groups, DenseRandomOnesStillHaveRoom) {
  const Scene scene = load_text(group("random", "1000", 0.05, 1));  // 52 % of the volume: one by one stops near 38 %
  EXPECT_LT(greatest_overlap(scene), 1e-12);
  EXPECT_LT(greatest_excess(scene, Vec3(0, 0, 0), Vec3(1, 1, 1)), 1e-15);
}

TEST(Groups, KeepClearOfEverythingElse) {
  const Scene scene = load_text(
      start +
      "balls: {big: {mass: 1, radius: 0.4, position: [0.5, 0.5, 0.5]}}\n"
      "groups:\n"
      "  small: {count: 200, ball: {mass: 1, radius: 0.02}, in: {min: [0, 0, 0], max: [1, 1, 1]}}\n"
      "  large: {count: 8, ball: {mass: 1, radius: 0.1}, in: {min: [0, 0, 0], max: [1, 1, 1]}}\n"
      "  even: {count: 100, ball: {mass: 1, radius: 0.015}, in: {min: [0, 0, 0], max: [1, 1, 1]}, arrange: lattice}\n"
      "planes: {tilted: {point: [0.1, 0, 0], normal: [1, 0.2, 0]}}\n"
      "walls: {screen: {center: [0.9, 0.5, 0.5], normal: [1, 0, 0], size: [0.5, 0.5]}}\n"
      "output: {}\n");

  EXPECT_EQ(scene.world.body_count(), 309u);
  EXPECT_LT(greatest_overlap(scene), 1e-12);

  const Plane& plane = scene.world.planes[0];
  const Wall& wall = scene.world.walls[0];
  for (Entity i = 1; i < scene.world.body_count(); ++i) {
    const Vec3& p = scene.initial.position[i];
    const double r = scene.world.radius[i];
    EXPECT_GT((p - plane.point).dot(plane.normal), r * (1 - 1e-12));
    const bool beside = std::fabs(p.y() - 0.5) > 0.25 || std::fabs(p.z() - 0.5) > 0.25;
    EXPECT_TRUE(beside || std::fabs(p.x() - wall.center.x()) > r * (1 - 1e-12));
  }
}

TEST(Groups, AreTheSameOnEveryMachineAndDifferBySeedAndName) {
  const string text = group("random", "50", 0.05, 1, ", speed: 2");
  const Scene a = load_text(text), b = load_text(text);
  EXPECT_EQ(a.initial.position, b.initial.position);
  EXPECT_EQ(a.initial.velocity, b.initial.velocity);
  LoadOptions other;
  other.seed = 1;
  EXPECT_NE(load_text(text, other).initial.position[0], a.initial.position[0]);
  string renamed = text;
  renamed.replace(renamed.find("gas"), 3, "air");
  EXPECT_NE(load_text(renamed).initial.velocity[0], a.initial.velocity[0]);
  // Positions of the balls do not change their velocities.
  EXPECT_EQ(load_text(group("lattice", "50", 0.05, 1, ", speed: 2")).initial.velocity, a.initial.velocity);
}

/// A group of 300 balls with radii from 0.02 to 0.05.
string with_radii(const string& arrange, const string& in, const string& mass) {
  return start + "seed: 3\ngroups:\n  gas: {count: 300, ball: {" + mass +
         ", radius: {from: 0.02, to: 0.05}}, in: " + in + ", arrange: " + arrange + "}\noutput: {}\n";
}

const pair<const char*, const char*> spaces[] = {
    {"box", "{min: [0, 0, 0], max: [1, 1, 1]}"},
    {"ball", "{radius: 0.7, position: [0.5, 0.5, 0.5]}"},
    {"cylinder", "{cylinder: {radius: 0.6, height: 1}, position: [0.5, 0.5, 0.5]}"}};

/// How far a ball reaches beyond a space of `spaces`, at most (m).
double greatest_excess(const Scene& scene, const string& space) {
  if (space == "box") return greatest_excess(scene, Vec3(0, 0, 0), Vec3(1, 1, 1));
  double greatest = -1;
  for (Entity i = 0; i < scene.world.body_count(); ++i) {
    const Vec3 d = scene.initial.position[i] - Vec3::Constant(0.5);
    const double r = scene.world.radius[i];
    greatest = max(greatest, space == "ball" ? d.norm() + r - 0.7
                                             : max(std::hypot(d.x(), d.z()) + r - 0.6, std::abs(d.y()) + r - 0.5));
  }
  return greatest;
}

TEST(Groups, OfManyRadiiLieWhollyInsideEverySpaceWithoutOverlap) {
  for (const char* arrange : {"random", "lattice", "hexagonal"}) {
    for (const auto& [space, in] : spaces) {
      const Scene scene = load_text(with_radii(arrange, in, "density: 1000"));
      EXPECT_LT(greatest_overlap(scene), 1e-12) << arrange << space;
      EXPECT_LT(greatest_excess(scene, space), 1e-12) << arrange << space;
      EXPECT_EQ(load_text(scene.resolved).resolved, scene.resolved);
      EXPECT_EQ(load_text(scene.resolved).initial.position, scene.initial.position);
    }
  }
}

TEST(Groups, DrawTheirRadiiUniformlyAndTheSameForEveryArrangement) {
  const Scene scene = load_text(with_radii("random", spaces[0].second, "density: 1000"));
  EXPECT_EQ(load_text(with_radii("hexagonal", spaces[1].second, "mass: 1")).world.radius, scene.world.radius);
  double mean = 0;
  for (const double r : scene.world.radius) {
    EXPECT_TRUE(r >= 0.02 && r < 0.05);
    mean += r / 300;
  }
  // Three standard deviations of the mean of 300.
  EXPECT_NEAR(mean, 0.035, 3 * 0.03 / sqrt(12.0 * 300));

  // With a density each ball has its own mass, and with a mass all have the same.
  for (Entity i = 0; i < 300; ++i)
    EXPECT_DOUBLE_EQ(scene.world.mass[i], 1000 * 4.0 / 3 * 3.14159265358979324 * pow(scene.world.radius[i], 3));
  EXPECT_EQ(load_text(with_radii("random", spaces[0].second, "mass: 2")).world.mass, vector<double>(300, 2.0));
}

TEST(Groups, OfOneRadiusAlsoLieInBallsAndCylinders) {
  for (const char* arrange : {"random", "lattice", "hexagonal"}) {
    for (const size_t k : {1, 2}) {
      const Scene scene =
          load_text(start + "groups: {gas: {count: 200, ball: {mass: 1, radius: 0.05}, in: " + spaces[k].second +
                    ", arrange: " + arrange + "}}\noutput: {}\n");
      EXPECT_LT(greatest_overlap(scene), 1e-12) << arrange << k;
      EXPECT_LT(greatest_excess(scene, spaces[k].first), 1e-12) << arrange << k;
    }
  }
}

TEST(Groups, SpacesAndRadiiThatCannotBeAreRefused) {
  const auto errors = [](const string& in, const string& radius) {
    return in_parts(
        errors_of(start + "groups:\n  g: {count: 9, in: " + in + ", ball: {mass: 1, radius: " + radius + "}}\n"));
  };
  const string box = "{min: [0, 0, 0], max: [1, 1, 1]}";
  EXPECT_EQ(errors("{radius: 0.2}", "0.1"),
            (Parts{{"4:14 9", "9 balls of radius 0.1 do not fit into the ball of `g`", "1 would fit"}}));
  EXPECT_EQ(errors("{cylinder: {radius: 0.1, height: 1}}", "{from: 0.05, to: 0.1}"),
            (Parts{{"4:14 9", "9 balls of radii up to 0.0984846362770741 do not fit into the cylinder of `g`",
                    "5 of the largest would fit"}}));
  EXPECT_EQ(errors(box, "{from: 0.2, to: 0.1}"),
            (Parts{{"4:95 0.1", "the radii go from 0.2 to 0.1", "expected `from` below `to`"}}));

  // One end is missing, or no radius.
  EXPECT_EQ(errors(box, "{from: 0.2}"),
            (Parts{{"4:71 radius", "`radius` has no `to`", "expected `to`: a number above 0 in m"}}));
  EXPECT_EQ(errors(box, "{from: 0, to: 1}"), (Parts{{"4:86 0", "`from` is 0", "expected a number above 0 in m"}}));

  EXPECT_EQ(errors("{radius: 1, min: [0, 0, 0], max: [1, 1, 1]}", "0.1"),
            (Parts{{"4:33 min", "`in` has both `radius` and `min`", "remove one of them"},
                   {"4:49 max", "`in` has both `radius` and `max`", "remove one of them"}}));
  EXPECT_EQ(errors("{min: [0, 0, 0]}", "0.1"),
            (Parts{{"4:22 min", "`in` has `min` but no `max`", "expected `max`: [x, y, z], three numbers in m"}}));
  EXPECT_EQ(
      errors("{position: [0, 0, 0]}", "0.1"),
      (Parts{{"4:22 position", "`in` has `position` but no `radius`", "expected `radius`: a number above 0 in m"}}));
  // A ball beside a group has one radius.
  EXPECT_EQ(marked_errors(start + "balls: {a: {mass: 1, radius: {from: 1, to: 2}, position: [0, 0, 0]}}\n"),
            (Marked{{"{", "`radius` is a map of keys"}}));
}

TEST(Groups, VelocityIsTheGroupsOrElseTheBalls) {
  EXPECT_EQ(load_text(group("lattice", "2", 0.1, 1, ", velocity: [1, 2, 3]")).initial.velocity[1], Vec3(1, 2, 3));
  EXPECT_NE(errors_of(group("lattice", "2", 0.1, 1, ", velocity: [1, 2, 3], speed: 1"))
                .find("has both `velocity` and `speed`"),
            string::npos);
}

TEST(Groups, AHundredThousandBallsDoNotCostAllPairs) {
  // All pairs would be 5e9 distances. 11 % of the volume.
  EXPECT_EQ(load_text(group("random", "100000", 0.0065, 1)).world.body_count(), 100'000u);
}

TEST(Random, NormalDeviatesHaveTheMomentsOfTheNormalDistribution) {
  Random random(5, "moments");
  constexpr int n = 1'000'000;
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0;
  int beyond_3 = 0;

  for (int i = 0; i < n; ++i) {
    const double x = random.normal();
    m1 += x / n;
    m2 += x * x / n;
    m3 += x * x * x / n;
    m4 += x * x * x * x / n;
    if (std::fabs(x) > 3) ++beyond_3;
  }

  // Four standard errors each: 1, sqrt 2, sqrt 15, sqrt 96 over sqrt n.
  EXPECT_NEAR(m1, 0, 4e-3);
  EXPECT_NEAR(m2, 1, 4 * 1.4e-3);
  EXPECT_NEAR(m3, 0, 4 * 3.9e-3);
  EXPECT_NEAR(m4, 3, 4 * 9.8e-3);
  EXPECT_NEAR(beyond_3, 2699.8, 4 * 52);  // P(|x| > 3) = 0.0026998
}

TEST(Random, LogarithmIsRightToTwoAndAHalfUnits) {
  Random random(6, "log");
  double worst = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double x = std::ldexp(1 - random.uniform(), -static_cast<int>(random.below(60)));
    const double exact = static_cast<double>(log(static_cast<long double>(x)));
    if (exact != 0) worst = std::max(worst, std::fabs(reproducible_log(x) / exact - 1) / 0x1p-52);
  }
  EXPECT_LT(worst, 2.5);
  EXPECT_EQ(reproducible_log(1), 0);
}

TEST(Random, StreamsAreTheSameForEver) {
  Random a(0, "a"), b(0, "a"), c(0, "b"), d(1, "a"), n(0, "n");
  EXPECT_EQ(n.normal(), 0x1.6e4da3caa4811p+0);  // gcc -O2 and clang -O0 alike
  EXPECT_EQ(n.normal(), -0x1.b92dc2f9954cdp-1);
  const uint64_t first = a.bits();
  EXPECT_EQ(first, 0xED70BC3E66FE33ACull);
  EXPECT_EQ(first, b.bits());
  EXPECT_NE(first, c.bits());
  EXPECT_NE(first, d.bits());
}

TEST(Random, BelowIsEven) {
  Random random(3, "below");
  int counts[7] = {};
  for (int i = 0; i < 70'000; ++i) ++counts[random.below(7)];
  for (const int count : counts) EXPECT_NEAR(count, 10'000, 4 * 93);
}

TEST(Groups, NeedNoBallWhereDefaultsHaveAllOfIt) {
  const string gas = "groups: {gas: {count: 3, in: {min: [0, 0, 0], max: [9, 9, 9]}}}\n";
  const Scene scene = load_text(start + "defaults: {ball: {mass: 2, radius: 0.25}}\n" + gas);
  EXPECT_EQ(scene.world.mass, (vector<double>{2, 2, 2}));
  EXPECT_EQ(scene.world.radius, (vector<double>{0.25, 0.25, 0.25}));
  // By the same places and values as with a ball of its own.
  const Scene own = load_text(
      start + "groups: {gas: {count: 3, in: {min: [0, 0, 0], max: [9, 9, 9]}, ball: {mass: 2, radius: 0.25}}}\n");
  EXPECT_EQ(scene.initial.position, own.initial.position);
  // An expression, a --set and a repeated group reach that ball, too.
  LoadOptions options;
  options.set = {"groups.gas.ball.mass=5"};
  EXPECT_EQ(load_text(start + "let: {r: 0.5}\ndefaults: {ball: {mass: 2, radius: = r}}\n" + gas, options).world.mass[0],
            5);
  EXPECT_EQ(errors_of(start + "defaults: {ball: {mass: 2, radius: 0.1}}\ngroups: {gas: {repeat: 2, count: 1, in: "
                              "{min: [= i, 0, 0], max: [= i + 1, 1, 1]}}}\n"),
            "");
  // What is missing is named.
  EXPECT_EQ(
      in_parts(errors_of(start + "defaults: {ball: {mass: 2}}\n" + gas)),
      (Parts{{"4:10 gas", "`ball` has no `radius`", "expected `radius`: a number above 0 in m, or a map of keys"}}));
  EXPECT_NE(errors_of(start + gas).find("group `gas` has no `ball`"), string::npos);
}

TEST(Groups, AreArrangedInTheirBoxWhateverTheDefaultsArrange) {
  const string groups = "groups: {g: {count: 2, ball: {mass: 1, radius: 0.1}, in: {min: [1, 1, 1], max: [4, 4, 4]}}}\n";
  const string members = "defaults: {group: {members: [{position: [1, 1, 1]}, {position: [3, 1, 1]}]}}\n";
  const Scene scene = load_text(start + members + groups);

  EXPECT_LE(greatest_excess(scene, Vec3(1, 1, 1), Vec3(4, 4, 4)), 0);
  EXPECT_LT(greatest_overlap(scene), 0);
  EXPECT_EQ(scene.initial.position, load_text(start + groups).initial.position);
}

TEST(Groups, AMassThatTheDefaultsCancelIsMissingWhereverTheyStand) {
  const string balls = "balls: {a: {radius: 0.1, position: [0, 0, 0]}}\n";
  const string defaults = "defaults: {ball: {mass: none}}\n";
  const string message = "ball `a` has no `mass` and no `density`";

  for (const string& text : {start + defaults + balls, start + balls + defaults}) {
    const Marked errors = marked_errors(text);
    ASSERT_EQ(errors.size(), 1u) << text;
    EXPECT_EQ(errors[0], pair(string("a"), message));
  }
}

TEST(Groups, ABallThatComesFromTheDefaultsIsWholeToo) {
  const string groups = "groups: {gas: {count: 3, in: {min: [0, 0, 0], max: [9, 9, 9]}}}\n";
  EXPECT_EQ(
      in_parts(errors_of(start + "defaults: {group: {ball: {mass: 1}}}\n" + groups)),
      (Parts{{"4:10 gas", "`ball` has no `radius`", "expected `radius`: a number above 0 in m, or a map of keys"}}));
  EXPECT_EQ(errors_of(start + "defaults: {group: {ball: {mass: 1}}, ball: {radius: 1}}\n" + groups), "");
}

}  // namespace
}  // namespace carom
