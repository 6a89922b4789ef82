// The three errors of a comparison made by hand.
#include <gtest/gtest.h>

#include "compare/study/three_errors.h"

namespace rotorub {
namespace {

// One judged figure, in points: a share of time.
SceneComparison made_by_hand() {
  SceneComparison c;
  c.sides.resize(2);
  c.sides[0].metrics.contact_fraction = 0.9;
  SideDifference d;
  for (const Figure& f : figures()) {
    if (!f.is_judged() || !f.split || f.scale != Scale::kPoints) continue;
    FigureDifference difference;
    difference.figure = &f;
    difference.split.model_gap = -0.05;
    difference.split.step_error = 0.03;
    difference.split.native_step_error = 0.01;
    difference.split.valid = true;
    d.figures.push_back(difference);
  }
  c.differences.push_back(d);
  return c;
}

TEST(ThreeErrors, AreThoseOfTheFigureThatIsFurthestOff) {
  SceneComparison c = made_by_hand();
  ASSERT_FALSE(c.differences[0].figures.empty());
  FigureDifference further = c.differences[0].figures[0];
  further.split.model_gap = 0.2;
  further.split.step_error = 0.01;
  c.differences[0].figures.push_back(further);
  const ThreeErrors errors = three_errors(c, 1);
  EXPECT_DOUBLE_EQ(errors.contact.share, 0.2);
  EXPECT_NEAR(errors.step.share, 0.02, 1e-15) << "MuJoCo's less the native one's";
  EXPECT_FALSE(errors.modes.has_value());
  EXPECT_STREQ(errors.contact.figure->label, "lasting contact");
}

TEST(ThreeErrors, SayWhatCannotBeTold) {
  SceneComparison c = made_by_hand();
  c.differences[0].figures.push_back(c.differences[0].figures[0]);
  c.differences[0].figures[0].split.valid = false;
  EXPECT_EQ(three_errors(c, 1).contact.untold, 1);
  EXPECT_NE(three_errors(c, 1).contact.figure, nullptr);
  c.differences[0].figures[1].split.valid = false;
  EXPECT_EQ(three_errors(c, 1).contact.figure, nullptr);
}

TEST(ThreeErrors, HaveTheModesOfTheLadder) {
  SceneComparison c = made_by_hand();
  c.model_error.emplace();
  EXPECT_FALSE(three_errors(c, 1).modes.has_value())
      << "it has no figures: there is a reason why not";
  FigureLimit seen, unseen;
  seen.figure = unseen.figure = c.differences[0].figures[0].figure;
  seen.error = -0.12;
  c.model_error->figures = {unseen, seen};
  const ThreeErrors errors = three_errors(c, 1);
  ASSERT_TRUE(errors.modes.has_value());
  EXPECT_DOUBLE_EQ(errors.modes->share, -0.12);
  EXPECT_EQ(errors.modes->untold, 1);
}

}  // namespace
}  // namespace rotorub
