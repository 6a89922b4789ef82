#include "renders/chart.h"

#include <gtest/gtest.h>

#include "renders/palette.h"
#include "tests/renders/samples.h"

namespace rotorub::renders {
namespace {

Chart::Options small_chart() {
  Chart::Options options;
  options.width = 400;
  options.height = 200;
  return options;
}

// Pixels of a label, which stands to the right of the curve, in a band of the picture's height.
int label_pixels(const Picture& picture, int top, int bottom) {
  return find(picture, 322, top, 400, bottom, [](int r, int g, int) { return r < 190 && g < 190; })
      .count;
}

// The scale of a gap names the depth of a soft contact, 892 um, rather than the 5 um above.
TEST(Chart, NamesTheSideThatTheCurveIsOn) {
  Picture picture(400, 200);
  Sheet sheet(picture, {0, 0, 400, 200});
  Chart::Options options = small_chart();
  options.scale = {-892.0, 5.0, false};
  options.unit = "µm";
  options.mark_clipped = false;
  const Chart chart(options, {{{0.0, 0.5, 1.0}, {0.0, -892.0, -892.0}}});
  chart.draw(sheet, 1.0, {});
  EXPECT_GT(label_pixels(picture, 150, 200), 0) << "-800 um";
  EXPECT_EQ(label_pixels(picture, 20, 150), 0) << "5 um, on the line of 0";
}

// A picture of a curve at t = `now`, 400 x 200 pixels with times from 0 to 1 s.
Picture chart_at(double now, const std::vector<Chart::Curve>& curves) {
  Picture picture(400, 200);
  Sheet sheet(picture, {0, 0, 400, 200});
  Chart(small_chart(), curves).draw(sheet, now, {});
  return picture;
}

bool is_blue(int r, int g, int b) { return b > 120 && r < 90 && g < 120; }

TEST(Chart, ColoursEachCurveUpToNow) {
  const Chart::Curve low{{0.0, 1.0}, {0.2, 0.2}, palette::kTrail};
  const Chart::Curve high{{0.0, 1.0}, {0.8, 0.8}, palette::kNormal};
  const Picture half = chart_at(0.5, {low, high}), all = chart_at(1.0, {low, high});
  for (const renders::Test& color : {renders::Test(is_blue), renders::Test(is_red)}) {
    EXPECT_GT(find(half, color).count, 100);
    EXPECT_NEAR(find(all, color).count, 2.0 * find(half, color).count, 12.0);
  }
  EXPECT_GT(find(all, is_blue).row, find(all, is_red).row) << "the lower value is drawn lower";
}

// Every row counts: the peak of a single row among many is drawn, and a curve has no gaps.
TEST(Chart, KeepsAPeakOfOneRowAmongMany) {
  Chart::Curve curve{{}, {}, palette::kNormal};
  for (int k = 0; k <= 50000; ++k) {
    curve.t.push_back(k / 50000.0);
    curve.values.push_back(k == 25017 ? 0.9 : 0.1);
  }
  const Picture picture = chart_at(1.0, {curve});
  const auto red_from = [&](int left, int right, int top, int bottom) {
    return find(picture, left, top, right, bottom, is_red).count;
  };
  EXPECT_GT(red_from(100, 250, 45, 100), 20);
  for (int x = 2; x < 290; x += 8) EXPECT_GT(red_from(x, x + 8, 27, 200), 4) << x;
}

TEST(Chart, WritesTheTimesBelowTheCurves) {
  const auto ink = [](int r, int g, int b) { return r < 190 && g < 190 && b < 200; };
  EXPECT_GT(find(chart_at(1.0, {}), 0, 182, 300, 200, ink).count, 40);
}

}  // namespace
}  // namespace rotorub::renders
