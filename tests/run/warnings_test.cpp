// The advice of warnings names what the scene has.
#include "run/warnings.h"

#include <gtest/gtest.h>

#include "run/account.h"
#include "scene/scene.h"
#include "scene/scenes_in_text.h"
#include "std.h"

namespace carom {
namespace {

/// A scene that has run to its end.
struct Ended {
  explicit Ended(const string& yaml) : scene(load_text("scene: 1\n" + yaml)), engine(choose_engine(scene)) {
    const auto simulator = make_simulator(scene);
    const StoredEnergy start = stored_energy(scene, simulator->state());
    while (simulator->time() < scene.simulate.duration) simulator->advance_to(scene.simulate.duration);
    summary = account_of(scene, engine, start, simulator->state(), simulator->tally());
    warnings = warnings_of(scene, engine, simulator->state(), summary, simulator->tally());
  }
  string texts() const {
    string all;
    for (const Warning& warning : warnings) all += warning.code + ": " + warning.text + '\n';
    return all;
  }
  Scene scene;
  EngineChoice engine;
  Summary summary;
  vector<Warning> warnings;
};

// One whole period of a swing from the horizontal (T = 2.36784... s by its elliptic integral): at both ends all
// energies are 0. In between the bob has g l = 9.81 J.
TEST(EnergyWarning, IsNoneWhereTheMotionEndsAsItBegan) {
  const string gravity = "gravity: [0, -9.81, 0]\n", swing = "strings: {s: {from: [0, 0, 0], to: bob}}\n",
               period = "simulate: {duration: 2.3678419475762374}\n";
  const Ended one(gravity + "balls: {bob: {mass: 1, radius: 0.05, position: [1, 0, 0]}}\n" + swing + period);
  EXPECT_EQ(one.texts(), "");
  EXPECT_NEAR(one.summary.energy.turnover, 9.81, 1e-9);
  // On a rod, in steps, below the origin with a heavier one at rest beside it, and with a lighter and slower one.
  const Ended rod(gravity +
                  "balls: {bob: {mass: 1, radius: 0.05, position: [1, 0, 0]}}\n"
                  "strings: {s: {from: [0, 0, 0], to: bob, rod: true}}\n"
                  "simulate: {duration: 2.3678419475762374, engine: stepped}\n");
  EXPECT_EQ(rod.texts(), "");
  const Ended two(gravity +
                  "balls:\n  bob: {mass: 1, radius: 0.05, position: [1, 0, 0]}\n"
                  "  rests: {mass: 1e9, radius: 0.5, position: [9, 0, 0]}\n"
                  "  dust: {mass: 1e-9, radius: 0.001, position: [20, 0, 0]}\n"
                  "planes: {floor: {point: [0, -0.5, 0], normal: [0, 1, 0]}}\n"
                  "strings: {s: {from: [0, 1.5, 0], to: bob, length: 1.8027756377319946}}\n"
                  "simulate: {duration: 0.1}\n");
  EXPECT_EQ(two.texts(), "");
  // A hop from the origin and back to it, on a plane 1 m below it.
  const Ended hop(gravity +
                  "restitution: 1\nballs: {b: {mass: 3, radius: 0.5, position: [0, 0, 0]}}\n"
                  "planes: {floor: {point: [0, -1.5, 0], normal: [0, 1, 0]}}\n"
                  "simulate: {duration: 0.90304}\n");
  EXPECT_EQ(hop.texts(), "");
}

// It gains energy by too long steps, which its greatest kinetic energy does not hide.
TEST(EnergyWarning, IsGivenForALossOfAllThatSwung) {
  const Ended lost(
      "gravity: [0, 0, 0]\nballs: {b: {mass: 1, radius: 0.05, position: [1, 0, 0]}}\n"
      "forces: [{spring: {anchor: [0, 0, 0], stiffness: 39600}}]\n"
      "simulate: {duration: 2, engine: stepped, integrator: rk4, step: 0.005}\n");
  ASSERT_FALSE(lost.warnings.empty());
  EXPECT_EQ(lost.warnings[0].code, "energy");
}

/// The warning of a run that gained 1 J of 4 J without impacts or work.
string energy_warning(const Scene& scene) {
  Summary summary;
  summary.energy.start = 4;
  summary.energy.end = 5;
  summary.energy.residual = 1;
  summary.energy.turnover = 4;
  EngineChoice engine;
  engine.engine = Engine::exact;
  const vector<Warning> warnings = warnings_of(scene, engine, scene.initial, summary, Tally{});
  return warnings.size() == 1 ? warnings[0].text : "";
}

TEST(EnergyWarning, AdvisesToSoftenAnAttractorOnlyWhereThereIsOne) {
  const string gained = "the method gained 1 J beyond impacts and work, 0.25 of the energy turned over: ";
  Scene scene;
  EXPECT_EQ(energy_warning(scene), gained + "shorten simulate.duration");
  scene.world.forces.push_back({Spring{}});
  EXPECT_EQ(energy_warning(scene), gained + "shorten simulate.duration");
  scene.world.forces.push_back({Attractor{}});
  EXPECT_EQ(energy_warning(scene), gained + "shorten simulate.duration, or soften the attractor");
}

/// The warning of the step, of a ball on this force.
string step_warning(const string& force, const string& method, const string& step) {
  const Ended run(
      "gravity: [0, 0, 0]\nballs: {b: {mass: 4, radius: 0.05, position: [1, 0, 0], velocity: [0, 1, 0]}}\n"
      "forces: [{acceleration: [0, 0, 1.0e-9]}, {" +
      force + "}]\nsimulate: {duration: 0.3, engine: stepped, integrator: " + method + ", step: " + step + "}\n");
  for (const Warning& warning : run.warnings)
    if (warning.code == "step") return warning.text;
  return "";
}

// w = sqrt(k / m) = 199 1/s: verlet is stable up to 2 / w, rk4 up to sqrt(8) / w. c / m = 400 1/s: rk4 up to 2.7853 m /
// c.
TEST(StepWarning, NamesTheForceTheStableStepAndTheRemedy) {
  const string spring = "spring: {anchor: [0, 0, 0], stiffness: 158404}", drag = "drag: {linear: 1600}";
  EXPECT_EQ(step_warning(spring, "rk4", "0.01"),
            "forces turned by 1.99 rad in a step of 0.01 s, most by forces.1.spring on `b`, stable up to 0.0142 s, but "
            "rk4 leaves 0.75 of an amplitude in each step: use steps of at most 0.0005 s, or `integrator: dop853`");
  EXPECT_EQ(step_warning(spring, "verlet", "0.0101"),
            "forces turned by 2.01 rad in a step of 0.0101 s, most by forces.1.spring on `b`, beyond stability: verlet "
            "is stable up to 0.0101 s: use steps of at most 0.0005 s, or `integrator: dop853`");
  EXPECT_EQ(
      step_warning(drag, "rk4", "0.0075"),
      "forces turned by 3 rad in a step of 0.0075 s, most by forces.1.drag on `b`, beyond stability: rk4 is stable "
      "up to 0.00696 s: use steps of at most 0.00025 s, or `integrator: dop853`");
  EXPECT_EQ(step_warning(spring, "rk4", "0.005"), "");
}

/// A light ball on two heavy ones that touch each other, and for so long (s). Each of them pushes a heavy one aside by
/// m g tan(30 degrees) / 2.
string wedge(const string& heavy, const string& duration, const string& engine = "engine: exact") {
  return "gravity: [0, -10, 0]\nrestitution: 0\nballs:\n  l: {mass: " + heavy +
         ", radius: 0.5, position: [-0.4, 0.5, 0]}\n  r: {mass: " + heavy +
         ", radius: 0.5, position: [0.6, 0.5, 0]}\n  m: {mass: 1, radius: 0.5, position: [0.1, 1.3660254037844386, "
         "0]}\n"
         "planes: {f: {point: [0, 0, 0], normal: [0, 1, 0]}}\nsimulate: {duration: " +
         duration + ", " + engine + "}\noutput: {}\n";
}

TEST(RestWarning, IsGivenWhereBalanceHidesAMotion) {
  for (const char* engine : {"engine: exact", "engine: stepped, step: 10"}) {
    const Ended run(wedge("1e12", "345035", engine));
    EXPECT_EQ(
        run.texts(),
        "rest: forces that count as balanced leave `l`, at rest, an acceleration of 2.9e-12 m/s^2, which could move "
        "it by 0.17 m in the rest of the run: make masses less unequal, or shorten simulate.duration\n");
  }
  EXPECT_EQ(Ended(wedge("1e13", "1e5")).warnings.size(), 1u);
  // Between a wall and the rim of a heavy cylinder, at 45 degrees.
  const Ended rim(
      "gravity: [0, -10, 0]\nrestitution: 0\n"
      "bodies: {c: {mass: 1e12, cylinder: {radius: 0.5, height: 1}, position: [0, 0.5, 0]}}\n"
      "balls: {m: {mass: 1, radius: 0.5, position: [0.8535533905932737, 1.3535533905932737, 0]}}\n"
      "planes: {f: {point: [0, 0, 0], normal: [0, 1, 0]}, w: {point: [1.3535533905932737, 0, 0], normal: [-1, 0, 0]}}\n"
      "simulate: {duration: 1e5}\noutput: {}\n");
  ASSERT_EQ(rim.warnings.size(), 1u) << rim.texts();
  EXPECT_NE(
      rim.warnings[0].text.find("leave `c`, at rest, an acceleration of 1e-11 m/s^2, which could move it by 0.05 m"),
      string::npos)
      << rim.texts();
}

TEST(RestWarning, IsNoneWhereBodiesAreInBalanceOrHardlyMove) {
  // 0.5 * 2.9e-12 m/s^2 * (500 s)^2 = 3.6e-7 m, less than a millionth of the radius.
  EXPECT_EQ(Ended(wedge("1e12", "500")).texts(), "");
  // A tower, a ball in a groove of obstacles, and a load that hangs on two strings, far from the origin, for a month.
  EXPECT_EQ(
      Ended("restitution: 0\nballs:\n  t: {repeat: 8, mass: '= 3 + i', radius: 0.1, position: [700.3, '= 0.1 + 0.2 * "
            "i', 0]}\n  g: {mass: 3, radius: 0.5, position: [800.1, 1.3660254037844386, 0]}\n"
            "  h: {mass: 7, radius: 0.1, position: [900.7, 1, 0]}\n"
            "obstacles: {o: {repeat: 2, radius: 0.5, position: ['= 799.6 + i', 0.5, 0]}}\n"
            "planes: {f: {point: [0, 0, 0], normal: [0, 1, 0]}}\n"
            "strings: {s: {repeat: 2, from: ['= 900.3 + 0.8 * i', 1.3, 0], to: h, length: 0.5}}\n"
            "simulate: {duration: 2.6e6}\noutput: {}\n")
          .texts(),
      "");
}

/// The warning of a run with contact problems that were not solved to rounding.
string contact_warning(vector<double> masses, uint64_t problems) {
  Scene scene;
  scene.world.mass = std::move(masses);
  Tally tally;
  tally.doubts.contacts = problems;
  const vector<Warning> warnings = warnings_of(scene, EngineChoice{}, scene.initial, Summary{}, tally);
  return warnings.empty() ? "" : warnings.back().text;
}

TEST(ContactWarning, AdvisesOnMassesOnlyWhereTheyAreUnequal) {
  EXPECT_EQ(contact_warning({1, 1e6, 3}, 2),
            "2 contact problems were not solved to rounding: make masses less unequal, which are from 1 to 1e+06 kg");
  const string other =
      "1 contact problem was not solved to rounding: compare dependent figures with those of a start that differs "
      "slightly";
  EXPECT_EQ(contact_warning({2, 2, 2}, 1), other);
  EXPECT_EQ(contact_warning({1, 5}, 1), other);
  EXPECT_EQ(contact_warning({1, 5}, 0), "");
}

}  // namespace
}  // namespace carom
