#include "renders/panel.h"

#include <gtest/gtest.h>

#include "renders/palette.h"
#include "tests/renders/samples.h"

namespace rotorub::renders {
namespace {

// Pixels of a label, which stands to the right of the curve, in a band of the picture's height.
int label_pixels(const Picture& picture, int top, int bottom) {
  return find(picture, 322, top, 400, bottom, [](int r, int g, int) { return r < 190 && g < 190; })
      .count;
}

// The scale of a gap follows a soft contact that is 892 um deep, rather than name the 5 um above.
TEST(Chart, NamesTheSideThatTheCurveIsOn) {
  Picture picture(400, 200);
  Sheet sheet(picture, {0, 0, 400, 200});
  Chart::Options options;
  options.scale = {-892.0, 5.0, false};
  options.unit = "µm";
  options.mark_clipped = false;
  const Chart chart({0.0, 0.5, 1.0}, {0.0, -892.0, -892.0}, options);
  chart.draw(sheet, 14, 1.0, "gap", {});
  EXPECT_GT(label_pixels(picture, 150, 200), 0) << "-800 um";
  EXPECT_EQ(label_pixels(picture, 20, 150), 0) << "5 um, on the line of 0";
}

TEST(Panel, SaysOfAWhirlHowFastItIs) {
  EXPECT_EQ(strobe_text({-11285.0, 2e-4}),
            "whirl -1,796 Hz: one position every 0.2 ms, 0.36 turns apart");
}

}  // namespace
}  // namespace rotorub::renders
