#include "compare/tune/choice.h"

#include <gtest/gtest.h>

#include <sstream>

#include "compare/tune/output.h"
#include "compare/tune/tune.h"

namespace rotorub::tune {
namespace {

// The choice among made-up settings, and the search on a made-up engine.

using scene::ContactModel;

constexpr double kPercent = 0.01;

JudgedSetting made(ContactModel contact, double step, double us, double mean, double peak) {
  JudgedSetting s;
  s.setting.contact = contact;
  s.setting.step = step;
  s.us_per_step = us;
  s.figures = {judged(figure("mean_force"), 100.0, 100.0 * (1.0 + mean), kPercent),
               judged(figure("window_impulse"), 100.0, 100.0 * (1.0 + peak), kPercent)};
  s.trust = trust(s.figures);
  return s;
}

TEST(Choice, TakesTheCheapestOfSimulatedTimeNotOfAStep) {
  // 0.1, 0.05, 0.02 and 0.04 s per second.
  const Choice choice = choose({made(ContactModel::kRigid, 1e-5, 1.0, 0.0, 0.0),
                                made(ContactModel::kRigid, 1e-4, 5.0, 0.0, 0.0),
                                made(ContactModel::kCoulomb, 1e-4, 2.0, 0.0, -0.89),
                                made(ContactModel::kCone, 1e-4, 4.0, 0.3, 9.0)});
  EXPECT_EQ(choice.trusted, 1U);
  EXPECT_EQ(choice.next_cheaper, 3U);
  EXPECT_EQ(choice.best_by_contact, (std::vector<std::size_t>{1, 2, 3}));
  EXPECT_FALSE(choice.nearest);
}

TEST(Choice, APeakThatIsOffIsNotTrustedHoweverGoodTheMean) {
  const auto off = made(ContactModel::kCoulomb, 1e-4, 1.0, 0.0, -0.89);
  EXPECT_FALSE(off.is_trusted());
  EXPECT_EQ(off.wrong(), std::vector<std::string>{"window_impulse"});
  const Choice choice = choose({off, made(ContactModel::kCone, 1e-4, 1.0, 0.5, 3.0)});
  EXPECT_FALSE(choice.trusted);
  EXPECT_FALSE(choice.next_cheaper);
  EXPECT_EQ(choice.nearest, 0U);
}

TEST(Choice, TheNearestIsThatOfTheAverages) {
  const Choice choice = choose({made(ContactModel::kCone, 1e-3, 1.0, -0.99, 1.3),
                                made(ContactModel::kCone, 5e-4, 1.0, 0.066, 4.0),
                                made(ContactModel::kCone, 2e-4, 1.0, 0.35, 0.0)});
  EXPECT_EQ(choice.nearest, 1U);
  EXPECT_EQ(choice.best_by_contact, std::vector<std::size_t>{1});
}

TEST(Choice, LuckAndFailuresAreNotTrusted) {
  auto lucky = made(ContactModel::kCone, 1e-4, 1.0, 0.0, 0.0);
  lucky.luck = "at half the step: peak force -50 %";
  JudgedSetting failed;
  failed.setting.step = 1e-3;
  failed.us_per_step = 1.0;
  failed.failure = "diverged";
  const Choice choice = choose({lucky, failed, made(ContactModel::kRigid, 1e-4, 2.0, 0.0, 0.0)});
  EXPECT_EQ(choice.trusted, 2U);
  EXPECT_EQ(choice.next_cheaper, 0U) << "a run that failed is no cheaper setting";
  EXPECT_EQ(lucky.wrong(), std::vector<std::string>{"half_step"});
  EXPECT_EQ(failed.wrong(), std::vector<std::string>{"run"});
}

TEST(Choice, IsEmptyWithoutCandidates) {
  const Choice choice = choose({});
  EXPECT_FALSE(choice.trusted || choice.next_cheaper || choice.nearest);
}

// The error of the mean force is step / 10 ms for `rigid` and a tenth at any step for others; the
// cone happens to be right at 50 us.
Outcome made_run(const Setting& s, double) {
  Outcome outcome;
  outcome.metrics.us_per_step = 1.0;
  double off = s.contact == ContactModel::kRigid ? s.step / 1e-2 : 0.1;
  if (s.contact == ContactModel::kCone && s.step == 5e-5) off = 0.0;
  outcome.metrics.mean_force = 100.0 * (1.0 + off);
  return outcome;
}

TEST(Search, StopsWhereASmallerStepCannotBeCheaper) {
  SearchParameters parameters;
  parameters.steps = {2e-4, 1e-4, 5e-5, 2e-5, 1e-5};
  parameters.variants = {{ContactModel::kRigid}, {ContactModel::kCone}};
  const Judge judge = [](const Metrics& m, double) {
    return std::vector{judged(figure("mean_force"), 100.0, m.mean_force, 0.006)};
  };
  const auto all = search(parameters, made_run, judge, 0.006);
  const Choice choice = choose(all);
  ASSERT_TRUE(choice.trusted);
  EXPECT_EQ(all[*choice.trusted].setting.contact, ContactModel::kRigid);
  EXPECT_EQ(all[*choice.trusted].setting.step, 5e-5);
  for (const JudgedSetting& s : all) EXPECT_GE(s.setting.step, 5e-5) << "not worth a look";
  const JudgedSetting& cone = all.back();
  EXPECT_EQ(cone.setting.contact, ContactModel::kCone);
  EXPECT_EQ(cone.trust, Trust::kYes);
  EXPECT_FALSE(cone.is_trusted()) << "right at one step alone";
}

// The table of rotorub tune, from a made-up result.

// The line of a figure has its own causes, whatever causes the other figures have.
TEST(TuneTable, EachCauseStandsAtItsFigure) {
  TuneResult r;
  r.tolerance = 0.01;
  JudgedSetting s;
  s.setting.contact = scene::ContactModel::kRigid;
  s.setting.step = 1e-5;
  s.us_per_step = 1.0;
  for (const char* key : {"mean_force", "whirl_frequency", "gap_rate_rms"}) {
    s.figures.push_back(judged(figure(key), 100.0, 100.1, r.tolerance));
  }
  s.trust = trust(s.figures);
  r.settings = {s};
  r.choice = choose(r.settings);
  r.errors.figures = {{&figure("gap_rate_rms"), {0.02, {}}}};
  FigureLimit modes;
  modes.figure = &figure("gap_rate_rms");
  modes.values = {1.0, 1.0};
  modes.error = -0.0238;
  r.model_error.modes = {8, 11};
  r.model_error.figures = {modes};
  std::istringstream table(text_of(result_of(r)));
  std::string text;
  bool seen = false;
  while (std::getline(table, text)) {
    if (text.starts_with("  mean normal force")) {
      EXPECT_EQ(text.find("-2.38 %"), std::string::npos) << text;
    }
    if (text.starts_with("  rms gap rate") && !seen) {
      seen = true;
      EXPECT_NE(text.find("-2.38 %"), std::string::npos) << text;
      EXPECT_NE(text.find("+2.00 %"), std::string::npos) << text;
    }
  }
  EXPECT_TRUE(seen);
}

}  // namespace
}  // namespace rotorub::tune
