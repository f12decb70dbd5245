// Plots, by the real gnuplot.
#include "export/gnuplot.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "export/export_testing.h"
#include "std.h"

namespace carom {
namespace {

using testing_export::error_of;

Plot small_plot() {
  Plot plot;
  plot.title = "Orders 1 and 2";
  plot.subtitle = "made up";
  plot.x_label = "time (s)";
  plot.y_label = "error (m)";
  plot.series = {{"first", 1, {{1e-3, 1e-1, "1/16 s"}, {2e-3, 5e-2}, {4e-3, 2.5e-2, "1/64 s"}}},
                 {"second", 2, {{1e-3, 1e-2}, {2e-3, 2.5e-3}, {4e-3, 0}}}};
  plot.levels = {{"rounding", 1e-6}};
  plot.floor = 1e-8;
  return plot;
}

PlotPictures draw(const Plot& plot, const string& gnuplot = find_gnuplot()) {
  return draw_plots({&plot, 1}, gnuplot).front();
}

uint32_t big_endian(const string& bytes, size_t at) {
  uint32_t value = 0;
  for (size_t k = at; k < at + 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes[k]);
  return value;
}

TEST(Plot, IsAPngAndAnSvgWithTheSameBytesEachTime) {
  const PlotPictures once = draw(small_plot()), again = draw(small_plot());
  EXPECT_EQ(once.png, again.png);
  EXPECT_EQ(once.svg, again.svg);
  ASSERT_TRUE(once.png.starts_with("\x89PNG\r\n\x1a\n"));
  EXPECT_EQ(big_endian(once.png, 16), 1600u);
  EXPECT_EQ(big_endian(once.png, 20), 1000u);
  ASSERT_TRUE(once.svg.starts_with("<?xml"));
  EXPECT_TRUE(once.svg.ends_with("</svg>\n\n") || once.svg.ends_with("</svg>\n"));
  for (const char* text : {"Orders 1 and 2", "made up", "time (s)", "error (m)", ">first<", ">second<", ">rounding<",
                           ">1/16 s<", ">1/64 s<"})
    EXPECT_NE(once.svg.find(text), string::npos) << text;
}

TEST(Plot, TakesAnyTextToTheLetter) {
  Plot plot = small_plot();
  plot.title = "it's `x` $HOME \"q\" {/Symbol a} x^2_3 <b> \\n %d\n!touch";
  const string svg = draw(plot).svg;
  EXPECT_NE(svg.find("it's `x` $HOME \"q\" {/Symbol a} x^2_3 &lt;b> \\n %d !touch"), string::npos) << svg;
}

TEST(Plot, OfNothingAndOfOnePointIsDrawn) {
  Plot plot;
  plot.title = "empty";
  EXPECT_FALSE(draw(plot).png.empty());
  plot.series = {{"one", 0, {{1, 1}}}, {"none", 1, {}}};
  EXPECT_FALSE(draw(plot).png.empty());
}

TEST(Plot, WithoutGnuplotNamesTheRemedy) {
  const string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  EXPECT_EQ(error_of([] { find_gnuplot(); }),
            "the plots need gnuplot, which is not on the PATH\n  install it (on Debian: apt install gnuplot-nox)");
  setenv("PATH", path.c_str(), 1);
}

TEST(Plot, ThatGnuplotDoesNotDrawIsAnError) {
  EXPECT_EQ(error_of([] { draw(small_plot(), "/bin/false"); }).substr(0, 47),
            "cannot draw the plot: gnuplot failed with code ");
  EXPECT_EQ(error_of([] { draw(small_plot(), "/bin/true"); }).substr(0, 43),
            "cannot draw the plot: gnuplot wrote nothing");
}

}  // namespace
}  // namespace carom
