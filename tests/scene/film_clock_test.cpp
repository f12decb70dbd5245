// The time of a film that slows down: both ways, its length, and what decides how slow it becomes.
#include "scene/film_clock.h"

#include <gtest/gtest.h>

#include "scene/marked_errors.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

constexpr double reaction = 0.25;  // s, as the page has it

/// By how much (s) a film is longer that shows the whole slowdown.
double delay_of(int halvings) {
  const double n = std::exp2(halvings);
  return 2 * reaction * (halvings + 2 - 2 / n - (1 - 1 / n) / std::log(2.0));
}

TEST(FilmClock, OfAnEvenFilmShowsTheMotionAtItsSpeed) {
  const FilmClock clock(0.5, 2);
  EXPECT_EQ(clock.shown(3.7), 3.7);
  EXPECT_EQ(clock.plain(3.7), 3.7);
  EXPECT_EQ(clock.film(3), 2);
  EXPECT_EQ(clock.pace(3), 1);
  EXPECT_EQ(clock.text(3), "");
}

TEST(FilmClock, GoesBothWays) {
  for (int halvings = 1; halvings <= 6; ++halvings)
    for (const double speed : {0.1, 1.0, 7.0})
      for (const double from : {0.0, 2.9, 3.0}) {
        const FilmClock clock(speed, from, Slowdown{3, halvings});
        for (int i = 0; i <= 1000; ++i) {
          const double plain = from + 0.02 * speed * i;
          EXPECT_NEAR(clock.plain(clock.shown(plain)), plain, 1e-12);  // measured: 1.1e-13
        }
      }
}

TEST(FilmClock, MovesOnWithoutAJumpOfItsPace) {
  const FilmClock clock(1, 0, Slowdown{3, 4});
  constexpr double step = 1e-6;
  double before = 1;
  for (int i = 1; i <= 80'000; ++i) {
    const double plain = 1e-4 * i;
    const double pace = (clock.shown(plain + step) - clock.shown(plain - step)) / (2 * step);
    EXPECT_NEAR(pace, clock.pace(clock.shown(plain)), 1e-5);  // measured: 2.8e-6
    EXPECT_NEAR(pace, before, 3e-4);                          // measured: 2.8e-4: ln 2 in 0.25 s
    EXPECT_GT(pace, 0.0624);
    before = pace;
  }
}

TEST(FilmClock, IsPlainBeforeTheSlowdownBitForBit) {
  const FilmClock clock(0.125, 0.4, Slowdown{3, 3});
  // It begins T' ((1 - 1/n) / ln 2 + 2/n) before, with T' = 0.25 s x 0.125.
  const double begin = 3 - 0.25 * 0.125 * (0.875 / std::log(2.0) + 0.25);
  for (int i = 0; 0.4 + i / 300.0 < begin; ++i) EXPECT_EQ(clock.shown(0.4 + i / 300.0), 0.4 + i / 300.0);
  EXPECT_LT(clock.shown(begin + 0.01), begin + 0.01);
  EXPECT_EQ(clock.shown(0.4), 0.4);
}

TEST(FilmClock, IsLongerByTheClosedForm) {
  for (int halvings = 1; halvings <= 6; ++halvings)
    for (const double speed : {0.125, 1.0, 4.0}) {
      const FilmClock clock(speed, 1, Slowdown{20, halvings});
      EXPECT_NEAR(clock.film(41), 40 / speed + delay_of(halvings), 1e-12);
    }
  EXPECT_NEAR(most_delay(), delay_of(6), 1e-15);
}

TEST(FilmClock, ThatBeginsAtTheCollisionHasHalfOfTheSlowdown) {
  const FilmClock clock(1, 3, Slowdown{3, 3});
  EXPECT_EQ(clock.film(3), 0);
  EXPECT_NEAR(clock.film(10), 7 + delay_of(3) / 2, 1e-12);
  EXPECT_NEAR(clock.pace(3), 0.125, 1e-15);
}

TEST(FilmClock, SaysHowSlowItIs) {
  EXPECT_EQ(FilmClock(1, 0, Slowdown{3, 3}).text(3), "1/8 speed");
  EXPECT_EQ(FilmClock(1, 0, Slowdown{3, 3}).text(1), "");
  EXPECT_EQ(FilmClock(0.125, 0, Slowdown{3, 2}).text(3), "1/32 speed");
  EXPECT_EQ(FilmClock(10, 0, Slowdown{30, 2}).text(30), "2.5 × speed");
  EXPECT_EQ(FilmClock(0.3, 0, Slowdown{3, 1}).text(3), "0.15 × speed");
}

TEST(Halvings, LetBodiesCloseByARadiusWhileAViewerReacts) {
  // At 4 m/s, 1 m in 0.25 s: of balls of 0.125 m an eighth of that.
  EXPECT_EQ(halvings_for(4, 0.125, 1), 3);
  EXPECT_EQ(halvings_for(4, 0.125, 0.5), 2);
  EXPECT_EQ(halvings_for(40, 1.25, 1), 3);
  for (double speed = 0.5; speed < 17; speed *= 1.1) {
    const double closed = speed * reaction * std::exp2(-halvings_for(speed, 0.05, 1)) / 0.05;  // radii
    EXPECT_NEAR(std::log2(closed), 0, 0.501) << speed;
  }
  EXPECT_EQ(halvings_for(0, 0.1, 1), 1);
  EXPECT_EQ(halvings_for(1e9, 0.1, 1), 6);
}

const string film_scene =
    "scene: 1\nsimulate: {duration: 2}\nplanes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n"
    "balls:\n  red: {mass: 3, radius: 0.1, position: [1, 1, 0]}\n"
    "groups: {gas: {count: 4, in: {min: [0, 3, 0], max: [1, 4, 1]}, ball: {mass: 1, radius: 0.1}}}\n";

optional<SlowSettings> slow_of(const string& value) {
  return load_text(film_scene + "output: {video: {slow: " + value + "}}\n").output.video->slow;
}

TEST(Slow, IsAroundTheFirstCollisionOrThatOfBodies) {
  EXPECT_EQ(slow_of("auto")->count, 0u);
  EXPECT_EQ(slow_of("{}")->count, 0u);
  EXPECT_EQ(slow_of("red")->first, 0u);
  EXPECT_EQ(slow_of("red")->count, 1u);
  EXPECT_EQ(slow_of("{around: gas}")->first, 1u);
  EXPECT_EQ(slow_of("{around: gas}")->count, 4u);
  EXPECT_EQ(slow_of("{around: gas.3}")->first, 4u);
  EXPECT_FALSE(slow_of("none"));
}

/// The errors of a scene with this film.
Marked film_errors(const string& video) {
  return marked_errors(film_scene + "output: {video: " + video + "}\n");
}

TEST(Slow, AroundWhatIsNoBodyIsAnErrorAtItsPlace) {
  EXPECT_EQ(film_errors("{slow: floor}"),
            (Marked{{"floor", "`floor` is a fixed thing: a film slows down around collisions of bodies"}}));
  EXPECT_EQ(film_errors("{slow: {around: rde}}"), (Marked{{"rde", "nothing is named `rde`"}}));
}

TEST(Sound, OfAFilmThatCanHaveNoneIsAnErrorAtItsPlace) {
  EXPECT_EQ(film_errors("{sound: true, file: a.gif}"), (Marked{{"true", "a GIF has no sound"}}));
  EXPECT_EQ(film_errors("{sound: true, file: a.webp}"), (Marked{{"true", "a WebP has no sound"}}));
  EXPECT_TRUE(film_errors("{sound: true, file: a.mp4}").empty());
  EXPECT_TRUE(film_errors("{sound: false, file: a.gif}").empty());
}

}  // namespace
}  // namespace carom
