// The chart beside a film: its numbers against the motion's closed form, and what of the film it takes.
#include "run/film_chart.h"

#include <gtest/gtest.h>

#include "engine/engine.h"
#include "overlay/history.h"
#include "run/picture_series.h"
#include "run/run_scene.h"
#include "run/survey.h"
#include "scene/scenes_in_text.h"
#include "std.h"

namespace carom {
namespace {

constexpr double g = 9.80665;

/// A ball that falls from 2 m and bounces at sqrt(2 x 1.9 / g) = 0.6225 s.
string falling(const string& beside, const string& more = "") {
  return "scene: 1\ntitle: A ball\nsimulate: {duration: 1}\nrestitution: 0.5\n"
         "balls: {red: {mass: 2, radius: 0.1, position: [0, 2, 0], color: crimson}}\n"
         "planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}\n"
         "camera: {eye: [0, 1, 5], target: [0, 1, 0]}\n"
         "output: {video: {size: [480, 270], samples: 1, fps: 10, beside: " +
         beside + more + "}}\n";
}

ChartCurves curves_of(const Scene& scene, int instants) {
  ChartCurves curves(scene);
  const auto simulator = make_simulator(scene);
  for (int i = 0; i <= instants; ++i) {
    const double time = scene.simulate.duration * i / instants;
    while (simulator->time() < time) simulator->advance_to(time);
    curves.take(simulator->state());
  }
  curves.settle();
  return curves;
}

TEST(ChartCurves, OfEnergyAreKineticPotentialAndTotal) {
  const Scene scene = load_text(falling("energy"));
  const ChartCurves curves = curves_of(scene, 10);
  ASSERT_EQ(curves.curves().size(), 3u);
  EXPECT_EQ(curves.title(), "energy");
  EXPECT_EQ(curves.unit(), "J");
  for (size_t i = 0; i <= 6; ++i) {
    const double t = curves.times()[i], kinetic = 0.5 * 2 * g * t * g * t;
    EXPECT_NEAR(curves.taken()[i][0], kinetic, 1e-12);
    EXPECT_NEAR(curves.taken()[i][1], 2 * g * 2 - kinetic, 1e-12);
    EXPECT_NEAR(curves.taken()[i][2], 2 * g * 2, 1e-12);
  }
  // A bounce with e = 1/2 leaves a quarter of the kinetic energy, 2 g 1.9.
  EXPECT_NEAR(curves.taken()[10][2], 2 * g * 0.1 + 2 * g * 1.9 / 4, 1e-12);
}

TEST(ChartCurves, OfABodyAreItsQuantity) {
  const Scene scene = load_text(falling("vy(red)"));
  const ChartCurves curves = curves_of(scene, 4);
  EXPECT_EQ(curves.title(), "vy of red");
  EXPECT_NEAR(curves.taken()[2][0], -g * 0.5, 1e-12);
  EXPECT_EQ(curves.values(scene.initial), vector<double>{0});
}

TEST(ChartCurves, OfMomentumHaveTheAxisOnWhichTheyAreGreatest) {
  const Scene scene = load_text(
      "scene: 1\nsimulate: {duration: 2}\ngravity: [0, 0, 0]\ndefaults: {ball: {radius: 0.1}}\nballs:\n"
      "  red: {mass: 1, position: [0, 0.01, -1], velocity: [0, 0, 3]}\n  blue: {mass: 2, position: [0, 0, 1]}\n"
      "output: {video: {beside: momentum}}\n");

  const ChartCurves curves = curves_of(scene, 10);
  EXPECT_EQ(curves.title(), "momentum along z");
  ASSERT_EQ(curves.curves().size(), 3u);
  EXPECT_EQ(curves.curves().back().name, "sum");

  EXPECT_NEAR(curves.taken()[0][0], 3, 1e-12);
  EXPECT_NEAR(curves.taken()[0][1], 0, 1e-12);
  EXPECT_LT(curves.taken()[10][0], 0);
  for (const vector<double>& values : curves.taken()) {
    EXPECT_NEAR(values[2], 3, 1e-12);
    EXPECT_NEAR(values[0] + values[1], values[2], 1e-12);
  }
}

TEST(ChartCurves, OfTheMomentumOfManyBodiesAreThoseOfTheirSum) {
  string balls;
  for (int i = 0; i < 6; ++i)
    balls += "  b" + to_string(i) + ": {mass: 1, radius: 0.1, position: [" + to_string(i) +
             ", 0, 0], velocity: [1, 2, 3]}\n";
  const Scene scene = load_text("scene: 1\nsimulate: {duration: 1}\ngravity: [0, 0, 0]\nballs:\n" + balls +
                                "output: {video: {beside: momentum}}\n");
  const ChartCurves curves = curves_of(scene, 1);
  ASSERT_EQ(curves.curves().size(), 3u);
  for (size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(curves.taken()[1][axis], 6.0 * double(axis + 1), 1e-12);
}

/// The pictures of the film, and how many simulators were made for them.
struct Filmed {
  vector<Image> pictures;
  vector<Image> bare;  // without the chart
};
Filmed filmed(const Scene& scene, const vector<double>& times) {
  const History history(scene, picture_needs(scene));
  const PictureStreams plan = plan_pictures(scene);
  EXPECT_TRUE(plan.streams.front().charted);
  PictureStream plain = plan.streams.front();
  plain.charted = false;
  PictureSeries series(scene, plan.streams.front(), history, "here"), bare(scene, plain, history, "here");
  FilmChart* const charts[] = {series.chart()};
  survey(
      {}, *make_simulator(scene), [] {}, charts);

  Filmed film;
  const auto simulator = make_simulator(scene);
  for (const double time : times) {
    while (simulator->time() < time) simulator->advance_to(time);
    film.pictures.push_back(series.picture(simulator->state(), simulator->tally()));
    film.bare.push_back(bare.picture(simulator->state(), simulator->tally()));
  }
  return film;
}

TEST(FilmChart, StandsBesideThePictureAndGrowsWithTheFilm) {
  const Scene scene = load_text(falling("y(red)"));
  const Filmed film = filmed(scene, {0, 0.5, 1});
  const FilmLayout layout = layout_of(*scene.output.video);

  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(film.pictures[i].width, 480);
    EXPECT_EQ(film.bare[i].width, 320);
    for (int y = 0; y < 270; ++y)
      ASSERT_TRUE(
          std::equal(film.bare[i].row(y), film.bare[i].row(y) + film.bare[i].row_size(), film.pictures[i].row(y)));
  }

  // Red pixels: the rightmost one goes from the start of the axis to its end, at half of the time to its middle.
  const auto farthest = [&](const Image& image) {
    int most = 0;
    for (int y = 0; y < 270; ++y)
      for (int x = layout.left; x < image.width; ++x) {
        const uint8_t* rgb = image.row(y) + size_t(3 * x);
        if (rgb[0] > rgb[1] + 60) most = max(most, x);
      }
    return most;
  };
  const int first = farthest(film.pictures[0]), middle = farthest(film.pictures[1]), last = farthest(film.pictures[2]);
  EXPECT_NEAR(middle - first, last - middle, 2);
  EXPECT_GT(last - first, 80);

  // Axes and their numbers stand still: what changes is between the title and the time axis, right of the numbers.
  for (int y = 0; y < 270; ++y)
    for (int x = layout.left; x < first - 6; ++x)
      ASSERT_EQ(film.pictures[0].row(y)[3 * x], film.pictures[2].row(y)[3 * x]) << x << ", " << y;
}

TEST(FilmChart, BelowTheValueTheCurveHasItsHeight) {
  // The lowest and the highest row of the curve are those of 2 m and of 0.1 m, and the peak between them is at
  // 0.1 + 1.9 / 4 m.
  const Scene scene = load_text(falling("y(red)"));
  const Image whole = filmed(scene, {1}).pictures[0];
  int top = 270, bottom = -1;
  for (int y = 60; y < 270; ++y)
    for (int x = 320; x < 480; ++x) {
      const uint8_t* rgb = whole.row(y) + size_t(3 * x);
      if (rgb[0] > rgb[1] + 60) top = min(top, y), bottom = max(bottom, y);
    }
  // The plot is at most 1.15 times as high as wide, and 1.9 m are 1/1.1 of it.
  EXPECT_GT(bottom - top, 90);
  EXPECT_LT(bottom - top, 170);
}

TEST(FilmChart, NeedsNoSecondSimulation) {
  const string folder = test_folder() + "/run";
  Scene scene = load_scene(write_file(falling("energy")));

  int made = 0;
  RunSettings settings;
  settings.durability = Durability::deferred;
  settings.simulator = [&](const Scene& its, Recording recording, const StepChoice& steps) {
    ++made;
    return make_simulator(its, std::move(recording), steps);
  };
  const RunWatch watch{[] {}, [](const RunProgress&) {}};
  const RunResult result = run_scene({&scene, folder}, choose_engine(scene), settings, watch);

  EXPECT_EQ(made, 1);
  EXPECT_EQ(result.summary.frames, 11u);
  std::filesystem::remove_all(test_folder());
}

TEST(FilmChart, OfARunThatStopsEndsWithIt) {
  const Scene whole = load_text(falling("energy"));
  Scene stopped = load_text(falling("energy", ", from: 0.25, until: 0.75"));
  EXPECT_EQ(FilmChart(whole).instants().at(FilmChart(whole).instants().last()), 1);
  EXPECT_EQ(FilmChart(stopped).instants().at(0), 0.25);
  stopped.known.ends_at = 0.5;
  EXPECT_EQ(FilmChart(stopped).instants().at(FilmChart(stopped).instants().last()), 0.5);
}

}  // namespace
}  // namespace carom
