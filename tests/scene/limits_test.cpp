// Numbers beyond the range of doubles are refused before any computation.
#include <fmt/format.h>

#include "physics/bounds.h"
#include "scene/fields.h"
#include "scene/marked_errors.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

/// A ball of these keys, and `more` below it.
string ball(const string& keys, const string& more = "simulate: {duration: 1}\n") {
  return "scene: 1\nballs:\n  red: {" + keys + "}\n" + more;
}

TEST(Limits, ANumberBeyondThoseOfItsUnitIsRefusedWhereItStands) {
  EXPECT_EQ(in_parts(errors_of(ball("mass: 1e154, radius: 1e308, position: [1e200, 0, 0], velocity: [0, 1e155, 0]",
                                    "gravity: [0, -1e154, 0]\nsimulate: {duration: 1e31}\n"))),
            (Parts{{"3:15 1e154", "`mass` is 1e154", "a run takes numbers from 1e-60 to 1e+60 kg"},
                   {"3:30 1e308", "`radius` is 1e308", "a run takes numbers from 1e-30 to 1e+30 m"},
                   {"3:48 1e200", "a number of `position` is 1e200", "a run takes numbers from -1e+30 to 1e+30 m"},
                   {"3:76 1e155", "a number of `velocity` is 1e155", "a run takes numbers from -1e+30 to 1e+30 m/s"},
                   {"4:14 -1e154", "a number of `gravity` is -1e154", "a run takes numbers from -1e+30 to 1e+30 m/s^2"},
                   {"5:22 1e31", "`duration` is 1e31", "a run takes numbers from 0 to 1e+30 s"}}));
}

TEST(Limits, EveryNumberWithAUnitHasALimit) {
  for (const Kind& kind : kinds())
    for (const Field& field : kind.fields) {
      if (field.type != Type::number && field.type != Type::vector && field.type != Type::extent) continue;
      const Range range = limited_range(field);
      EXPECT_TRUE(std::abs(range.min) <= 1e150 && std::abs(range.max) <= 1e150) << kind.name << " " << field.key;
    }
}

TEST(Limits, ASceneThatIsSmallAndOneThatIsLargeLoad) {
  for (const double unit : {1e-15, 1e-6, 1.0, 1e11, 1e17})
    EXPECT_EQ(errors_of(ball(fmt::format("mass: {}, radius: {}, position: [{}, 0, 0], velocity: [{}, 0, 0]", unit, unit,
                                         1e9 * unit, -unit))),
              "");
}

TEST(Limits, APlaceTooFarForTheSmallestSizeIsRefused) {
  EXPECT_EQ(in_parts(errors_of(ball("mass: 1, radius: 0.5, position: [0, 6e11, 0]"))),
            (Parts{{"3:41 [", "`red` is 6e+11 m from the origin, more than 1e+12 times the smallest size, 0.5 m",
                    "doubles do not resolve contact there: bring it nearer, or make the smallest thing larger"}}));
  EXPECT_EQ(errors_of(ball("mass: 1, radius: 0.5, position: [0, 4e11, 0]")), "");
}

TEST(Limits, ARoomAndAGroupThatWideAreRefused) {
  const string room = ball("mass: 1, radius: 1, position: [0, 0, 0]",
                           "room: {min: [-1e13, -9, -9], max: [9, 9, 9]}\nsimulate: {duration: 1}\n");
  EXPECT_NE(errors_of(room).find("scene.yaml:4:13: error: `room` is 1e+13 m from the origin"), string::npos)
      << errors_of(room);
  const string group =
      "scene: 1\ngroups:\n  gas: {count: 9, in: {min: [0, 0, 0], max: [9e29, 1, 9]}, ball: {mass: 1, radius: 0.1}}\n"
      "simulate: {duration: 1}\n";
  EXPECT_NE(errors_of(group).find("scene.yaml:3:45: error: `gas` is 9e+29 m from the origin"), string::npos)
      << errors_of(group);
}

TEST(Limits, AWayTooLongForTheSmallestSizeIsRefused) {
  EXPECT_EQ(
      in_parts(errors_of(
          ball("mass: 1, radius: 0.5, position: [0, 0, 0], velocity: [0, 1e6, 0]", "simulate: {duration: 1e6}\n"))),
      (Parts{
          {"3:62 [", "`red` travels 1e+12 m in the duration, more than 1e+12 times the smallest size, 0.5 m",
           "doubles do not resolve its position then: expected a shorter duration, a lower speed, or larger things"}}));
}

TEST(Limits, AnImpulseThatMakesItTooFastIsRefused) {
  const string text = errors_of(ball("mass: 1e-30, radius: 0.5, position: [0, 0, 0], impulse: [0, 10, 0]"));
  EXPECT_NE(text.find("`red` starts at 1e+31 m/s"), string::npos) << text;
}

TEST(Limits, ForcesWhoseSumIsTooMuchForAMassAreRefused) {
  const string text =
      errors_of(ball("mass: 1e-10, radius: 0.5, position: [0, 0, 0]",
                     "forces: [{uniform: [1e20, 0, 0]}, {uniform: [0, 0, 1e20]}]\nsimulate: {duration: 1}\n"));
  EXPECT_NE(text.find("scene.yaml:4:1: error: the uniform forces accelerate `red` by 2e+30 m/s^2"), string::npos)
      << text;
}

TEST(Limits, ADensityWhoseMassIsNoneIsRefused) {
  const string text = errors_of(ball("density: 1e100, radius: 1e-1, position: [0, 0, 0]"));
  EXPECT_NE(text.find("a run takes numbers from 1e-60 to 1e+60 kg"), string::npos) << text;
}

TEST(Limits, AFilmTooSlowNeedsAHigherSpeed) {
  EXPECT_EQ(in_parts(errors_of(start + "output: {video: {speed: 1e-6, fps: 1}}\n")),
            (Parts{{"3:25 1e-6", "the run would write 1000001 pictures; the limit is 100000",
                    "expected a higher `speed`, a lower `fps` or a shorter duration, or --force to allow it"}}));
  // At full speed there would be too many, too.
  EXPECT_NE(errors_of(start + "output: {video: {speed: 0.5, fps: 1e6}}\n").find("scene.yaml:3:35: "), string::npos);
  EXPECT_NE(errors_of(start + "output: {video: {speed: 0}}\n").find("expected a number from 0.000001 to 1000000\n"),
            string::npos);
}

TEST(Steps, MoreThanTheBudgetAreRefusedUnlessForced) {
  const string text =
      ball("mass: 1, radius: 0.5, position: [0, 0, 0]", "simulate: {duration: 1, engine: stepped, step: 1e-9}\n");
  EXPECT_EQ(in_parts(errors_of(text)),
            (Parts{{"4:48 1e-9", "the run would take 1e+09 time steps; the limit is 100000000",
                    "expected a longer `step` or a shorter duration, or --force to allow it"}}));
  LoadOptions forced;
  forced.budget.enforced = false;
  EXPECT_EQ(errors_of(text, forced), "");
}

TEST(Steps, ThoseThatAForceNeedsAreCountedToo) {
  const string text =
      ball("mass: 1, radius: 0.5, position: [0, 0, 0]",
           "forces: [{spring: {anchor: [0, 9, 0], stiffness: 1e16, rest_length: 1}}]\nsimulate: {duration: 9}\n");
  EXPECT_EQ(in_parts(errors_of(text)),
            (Parts{{"4:1 forces", "the run would take 1.8e+11 time steps; the limit is 100000000",
                    "steps follow the fastest change of a force: expected forces that change more slowly, a `step` or "
                    "a shorter duration, or --force to allow it"}}));
}

TEST(Steps, AreNoneWhereTheEngineGoesFromEventToEvent) {
  EXPECT_FALSE(steps_of(load_text(ball("mass: 1, radius: 0.5, position: [0, 0, 0]"))));
  EXPECT_EQ(steps_of(load_text(ball("mass: 1, radius: 0.5, position: [0, 0, 0]",
                                    "simulate: {duration: 2, engine: book, step: 0.5}\n"))),
            4);
}

TEST(Names, AMemberIsNamedByItsDigitsAlone) {
  const auto with = [](const string& name) {
    return errors_of(
        "scene: 1\ngroups:\n  gas: {count: 3, in: {min: [0, 0, 0], max: [9, 9, 9]}, ball: {mass: 1, radius: 0.1}}\n"
        "forces: [{uniform: [1, 0, 0], on: [" +
        name + "]}]\nsimulate: {duration: 1}\n");
  };
  EXPECT_EQ(with("gas.1"), "");
  for (const char* name : {"gas.1e0", "gas.01", "gas.+1", "gas.1.0", "gas.3"}) EXPECT_NE(with(name), "") << name;
}

}  // namespace
}  // namespace carom
