// What pages share, and the page of a run.
#include "export/page.h"

#include <gtest/gtest.h>

#include "export/gnuplot.h"
#include "export/plot_axis.h"
#include "export/plot_script.h"
#include "std.h"

namespace carom {
namespace {

TEST(HtmlText, EscapesMarksAndShowsWhatIsInvisible) {
  EXPECT_EQ(html_text("<a href=\"x\">it's</a> & \n more"),
            "&lt;a href=&quot;x&quot;&gt;it&#39;s&lt;/a&gt; &amp; \n more");
  EXPECT_EQ(html_text("\x1b[31m\xff"), "\\x1b[31m\\xff");
  EXPECT_EQ(html_text("é 30°"), "é 30°");
}

TEST(HtmlAddress, HasNoCharacterWithAMeaning) {
  EXPECT_EQ(html_address("runs/r0001/a b#1?.mp4"), "runs/r0001/a%20b%231%3F.mp4");
  EXPECT_EQ(html_address("../é:\"<.png"), "../%C3%A9%3A%22%3C.png");
  EXPECT_EQ(html_link("a&b", "a&b"), "<a href=\"a%26b\">a&amp;b</a>");
}

Plot small_plot(PlotForm form) {
  Plot plot;
  plot.title = "speed < 3";
  plot.scale = PlotScale::linear;
  plot.x_label = "<x>";
  plot.series = {{"a & b", 3, {{0, 1}, {1, 3}, {2, 2}}, form}};
  return plot;
}

TEST(PageFigures, AreOneDrawingEachWithTitleAndLegendAsText) {
  const PageFigures page = draw_figures({small_plot(PlotForm::marks), small_plot(PlotForm::points)}, find_gnuplot());
  ASSERT_EQ(page.figures.size(), 2u);
  EXPECT_TRUE(page.marks.starts_with("<svg class=\"marks\""));
  for (const string& figure : page.figures) {
    EXPECT_TRUE(figure.starts_with("<figure><figcaption>speed &lt; 3</figcaption>\n<svg class=\"chart\""));
    EXPECT_TRUE(figure.ends_with("a &amp; b</span></p></figure>\n"));
    EXPECT_NE(figure.find("&lt;x>"), string::npos);
    for (const char* left : {"<defs>", " id=", "xlink", "font-family", "<?xml", "Gnuplot"})
      EXPECT_EQ(figure.find(left), string::npos) << left;
  }
  // A line joins the points of the first one alone.
  EXPECT_NE(page.figures[0].find("stroke='rgb(  0, 114, 178)'"), string::npos);
  EXPECT_EQ(page.figures[1].find("stroke='rgb(  0, 114, 178)'"), string::npos);
}

TEST(PlotScript, OfALinearPlotHasBarsThatTheMarkDoesNotCover) {
  Plot plot = small_plot(PlotForm::points);
  for (PlotPoint& point : plot.series[0].points) {
    const double half = point.x == 1 ? 0.001 : 0.4;
    point.low = point.y - half;
    point.high = point.y + half;
  }
  // x, y, and the ends.
  EXPECT_NE(plot_script(plot).find("$bars0 << END\n0 1 0.59999999999999998 1.3999999999999999\n"
                                   "2 2 1.6000000000000001 2.3999999999999999\nEND\n"),
            string::npos);
  // The axis has room for them.
  EXPECT_LT(axes_of(plot).y.from, 0.6);
}

TEST(PageFigures, OfNoPlotsNeedNoGnuplot) {
  EXPECT_TRUE(draw_figures({}, "/nowhere/gnuplot").figures.empty());
}

}  // namespace
}  // namespace carom
